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


def square_tube(side, wall):
    """A, I, J (Bredt) of a square tube; shear area its two webs."""
    inner = side - 2 * wall
    inertia = (side**4 - inner**4) / 12
    return [side**2 - inner**2, inertia, inertia, 0, (side - wall)**3 * wall, 2 * inner * wall, 2 * inner * wall, 0, 1]


def i_section(height, width, flange, web):
    """A, I, J of an I, upright in local z; shear over the flanges (y) and the web (z)."""
    clear = height - 2 * flange
    return [2 * width * flange + clear * web, (width * height**3 - (width - web) * clear**3) / 12, (2 * flange * width**3 + clear * web**3) / 12,
            0, (2 * width * flange**3 + clear * web**3) / 3, 2 * width * flange * 5 / 6, clear * web, 0, 1]


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


def space_frame(folder, pieces=24):
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


def stocky_frame(folder, bays=8):
    """A cantilever of rectangular frames: tubes and I beams five sections long, one element each, so that all of their stiffness is
    bending, shear and torsion beside joints."""
    nodes, elements = {}, []
    corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.2), (0.0, 1.2)]
    for i in range(bays + 1):
        for j, (y, z) in enumerate(corners):
            nodes[4 * i + j + 1] = (1.1 * i, y, z)
    for i in range(bays + 1):
        for j in range(4):
            here = 4 * i + j + 1
            if i < bays:
                elements.append(("beam", "chord", "chord", [here, here + 4]))
            across = "beam" if j in (0, 2) else "post"
            elements.append(("beam", across, across, [here, 4 * i + (j + 1) % 4 + 1]))
    write_model(folder, "stocky frame", nodes, elements,
                {"chord": square_tube(0.2, 0.01), "post": pipe(0.09, 0.008), "beam": i_section(0.2, 0.1, 0.01, 0.006)},
                {j: [1] * 6 for j in (1, 2, 3, 4)})


def read_csv(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


class SolidOrShellModel:
    """Nodes found by place, shells and solids; written as a model folder."""

    def __init__(self):
        self.nodes, self.ids, self.elements, self.supports = {}, {}, [], {}

    def node(self, x):
        key = tuple(round(c, 6) for c in x)
        if key not in self.ids:
            self.ids[key] = len(self.ids) + 1
            self.nodes[self.ids[key]] = tuple(x)
        return self.ids[key]

    def shell(self, corners, group, pieces):
        """A quadrilateral cut by its bilinear map into pieces[0] along its first edge and pieces[1] along its second."""
        def at(i, j):
            s, t = i / pieces[0], j / pieces[1]
            weights = [(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t]
            return self.node([sum(w * c[k] for w, c in zip(weights, corners)) for k in range(3)])

        for i in range(pieces[0]):
            for j in range(pieces[1]):
                self.elements.append(("shell", group, [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]))

    def block(self, front, along, down, pieces):
        """Solids behind a line of nodes `front`: pieces[0] along and pieces[1] down."""
        def at(p, i, j):
            return self.node([p[k] + along[k] * i / pieces[0] + down[k] * j / pieces[1] for k in range(3)])

        def cross(a, b):
            return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]

        across = [b - a for a, b in zip(front[0], front[1])]
        if sum(a * b for a, b in zip(cross(across, along), down)) < 0:  # numbering of a solid turns with the sides' handedness
            front = front[::-1]
        for p, q in zip(front, front[1:]):
            for i in range(pieces[0]):
                for j in range(pieces[1]):
                    lower = [at(p, i, j + 1), at(q, i, j + 1), at(q, i + 1, j + 1), at(p, i + 1, j + 1)]
                    upper = [at(p, i, j), at(q, i, j), at(q, i + 1, j), at(p, i + 1, j)]
                    self.elements.append(("solid", "end_block", upper + lower))

    def write(self, folder, title, material, thickness):
        folder.mkdir(parents=True)
        (folder / "model.toml").write_text(f'title = "{title}"\n')
        write_csv(folder / "nodes.csv", ["node", "x_m", "y_m", "z_m"], [[i, *x] for i, x in self.nodes.items()])
        write_csv(folder / "materials.csv", ["material", "youngs_modulus_Pa", "poisson_ratio", "density_kg_m3"], [["concrete", *material]])
        write_csv(folder / "sections.csv", ["section", "thickness_m"], [["slab", thickness]])
        write_csv(folder / "elements.csv", ["element", "type", "group", "material", "section", *[f"node{i}" for i in range(1, 9)]],
                  [[n, kind, group, "concrete", "slab" if kind == "shell" else "", *ids, *[""] * (8 - len(ids))]
                   for n, (kind, group, ids) in enumerate(self.elements, 1)])
        write_csv(folder / "supports.csv", ["support", "node", "x", "y", "z", "rx", "ry", "rz"],
                  [[f"point_{i}", i, *flags] for i, flags in sorted(self.supports.items())])


def bridge_part(folder, bridge, size_m=0.115, length_m=8.0):
    """The foot deck's slab beside the crown, held at the chords' nodes as the truss holds it, with an end block in solids that
    carries the slab's end: shells and solids of the bridge, from its own model folder."""
    nodes = {int(r["node"]): tuple(float(r[c]) for c in ("x_m", "y_m", "z_m")) for r in read_csv(bridge / "nodes.csv")}
    thickness = {r["section"]: float(r["thickness_m"] or 0) for r in read_csv(bridge / "sections.csv")}
    materials = {r["material"]: (float(r["youngs_modulus_Pa"]), float(r["poisson_ratio"]), float(r["density_kg_m3"]))
                 for r in read_csv(bridge / "materials.csv")}
    slab = [r for r in read_csv(bridge / "elements.csv") if r["type"] == "shell" and r["group"].startswith("slab_foot")]
    slab = [(r, [nodes[int(r[f"node{i}"])] for i in range(1, 5)]) for r in slab]
    slab = [(r, q) for r, q in slab if all(-1e-6 <= p[0] for p in q) and sum(p[0] for p in q) / 4 <= length_m]
    # The same number of pieces in every quadrilateral, whatever the bridge's own mesh, so that neighbours meet.
    pieces = [math.ceil(sum(math.dist(q[a], q[b]) for _, q in slab) / len(slab) / size_m) for a, b in ((0, 1), (1, 2))]
    part = SolidOrShellModel()
    edges = {}
    for _, q in slab:
        part.shell(q, "slab", pieces)
        for a, b in zip(q, q[1:] + q[:1]):
            key = tuple(sorted((part.node(a), part.node(b))))
            edges[key] = edges.get(key, 0) + 1
    start = min(p[0] for _, q in slab for p in q)
    for (a, b), count in edges.items():
        across = all(abs(part.nodes[i][0] - start) < 1e-6 for i in (a, b))
        if count == 1 and not across:
            for i in (a, b):
                part.supports[i] = [1, 1, 1, 0, 0, 0]
    front = sorted((x for x in part.nodes.values() if abs(x[0] - start) < 1e-6), key=lambda x: x[1])
    down = (0.0, 0.0, -0.4)
    part.block(front, (-0.8, 0.0, 0.0), down, (2, 2))
    for x in (front[0], front[-1]):
        for back in (0.0, -0.8):
            part.supports[part.node([x[0] + back, x[1], x[2] - 0.4])] = [1, 1, 1, 0, 0, 0]
    first = slab[0][0]
    part.write(folder, "slab and end block of the foot deck", materials[first["material"]], thickness[first["section"]])


def block_alone(folder):
    """A slender end block of concrete, held at one face: bending, torsion and stretching within ten modes."""
    part = SolidOrShellModel()
    front = [(0.0, 0.5 * i / 7, 0.0) for i in range(8)]
    part.block(front, (4.0, 0.0, 0.0), (0.0, 0.0, -0.8), (48, 10))
    for i, x in part.nodes.items():
        if abs(x[0]) < 1e-9:
            part.supports[i] = [1, 1, 1, 0, 0, 0]
    part.write(folder, "block of solids", (35e9, 0.2, 2500), 0.1)
