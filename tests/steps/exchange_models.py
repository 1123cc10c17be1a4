"""Small models for the exchange tests, written as model folders from the closed forms of their sections."""

import csv
import math


def write_csv(file, header, rows):
    with open(file, "w", newline="") as stream:
        writer = csv.writer(stream)
        writer.writerow(header)
        writer.writerows(rows)


def pipe(outer, wall):
    """A, I, J of a circular tube; shear area of a thin one (half)."""
    inner = outer - wall
    area, inertia = math.pi * (outer**2 - inner**2), math.pi / 4 * (outer**4 - inner**4)
    return [area, inertia, inertia, 0, 2 * inertia, area / 2, area / 2, 0, 1]


def write_model(folder, title, nodes, elements, sections, supports, materials=None):
    """nodes {id: (x, y, z)}, elements (type, group, section, nodes), sections {name: row}, supports {node: six flags}."""
    folder.mkdir(parents=True)
    (folder / "model.toml").write_text(f'title = "{title}"\n')
    write_csv(folder / "nodes.csv", ["node", "x_m", "y_m", "z_m"], [[i, *x] for i, x in sorted(nodes.items())])
    write_csv(folder / "materials.csv", ["material", "youngs_modulus_Pa", "poisson_ratio", "density_kg_m3"],
              materials or [["steel", 210e9, 0.3, 7850]])
    write_csv(folder / "sections.csv", ["section", "area_m2", "inertia_y_m4", "inertia_z_m4", "inertia_yz_m4", "torsion_m4",
                                        "shear_area_y_m2", "shear_area_z_m2", "thickness_m", "bending_inertia_ratio"],
              [[name, *row] for name, row in sections.items()])
    rows = []
    for number, (kind, group, section, ids) in enumerate(elements, 1):
        rows.append([number, kind, group, "steel", section, *ids, *[""] * (4 - len(ids))])
    write_csv(folder / "elements.csv", ["element", "type", "group", "material", "section", "node1", "node2", "node3", "node4"], rows)
    write_csv(folder / "supports.csv", ["support", "node", "x", "y", "z", "rx", "ry", "rz"],
              [[f"base_{i}", i, *flags] for i, flags in supports.items()])


def space_frame(folder, pieces=8):
    """Two storeys, two bays by one, of slender tubes with a bracing of another size: no two directions alike."""
    nodes, elements, ids = {}, [], {}

    def node(x, y, z):
        key = (round(x, 9), round(y, 9), round(z, 9))
        if key not in ids:
            ids[key] = len(ids) + 1
            nodes[ids[key]] = key
        return ids[key]

    def member(a, b, group):
        points = [tuple(p + (q - p) * i / pieces for p, q in zip(a, b)) for i in range(pieces + 1)]
        for p, q in zip(points, points[1:]):
            elements.append(("beam", group, group, [node(*p), node(*q)]))

    xs, ys, zs = [0.0, 5.0, 9.0], [0.0, 4.0], [0.0, 3.5, 6.5]
    for x in xs:
        for y in ys:
            for low, high in zip(zs, zs[1:]):
                member((x, y, low), (x, y, high), "column")
    for z in zs[1:]:
        for y in ys:
            for left, right in zip(xs, xs[1:]):
                member((left, y, z), (right, y, z), "girder")
        for x in xs:
            member((x, ys[0], z), (x, ys[1], z), "girder")
    member((0.0, 0.0, 0.0), (5.0, 0.0, 3.5), "brace")
    base = {node(x, y, 0.0): [1] * 6 for x in xs for y in ys}
    write_model(folder, "space frame of tubes", nodes, elements,
                {"column": pipe(0.0445, 0.004), "girder": pipe(0.038, 0.0036), "brace": pipe(0.024, 0.003)}, base)
