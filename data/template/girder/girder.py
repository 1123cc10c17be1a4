"""Writes the model folder of a footbridge, a simply supported steel girder of 45 m: python3 girder.py FOLDER [Young's modulus Pa] [mass of the surfacing kg/m]"""
import csv
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
modulus = float(sys.argv[2]) if len(sys.argv) > 2 else 210e9
surfacing = float(sys.argv[3]) if len(sys.argv) > 3 else 500.0
folder.mkdir(parents=True, exist_ok=True)
LENGTH, PANELS, WIDTH, HEIGHT = 45.0, 18, 3.0, 8.0


def table(name, header, rows):
    with open(folder / name, "w", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([header.split(","), *rows])


# Two edge beams along X, cross beams between them; node 2 i + 1 is on the side of -Y, 2 i + 2 on the side of +Y.
nodes, elements, masses = [], [], []
for i in range(PANELS + 1):
    x = LENGTH * i / PANELS
    south, north = 2 * i + 1, 2 * i + 2
    nodes += [(south, x, -WIDTH / 2, HEIGHT), (north, x, WIDTH / 2, HEIGHT)]
    elements.append(("cross_beam", south, north))
    if i < PANELS:
        elements += [("edge_beam", south, south + 2), ("edge_beam", north, north + 2)]
    share = surfacing * LENGTH / PANELS / 2 * (0.5 if i in (0, PANELS) else 1.0)
    masses += [("surfacing", south, share), ("surfacing", north, share)]

last = 2 * PANELS
table("nodes.csv", "node,x_m,y_m,z_m", nodes)
table("materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3", [("steel", modulus, 0.3, 7850)])
# Box girders 1.2 m high and 0.5 m wide of plates of 12 mm; cross beams 0.4 m high.
table("sections.csv", "section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4",
      [("edge_beam", 0.0402, 7.7e-3, 2.0e-3, 4.9e-3), ("cross_beam", 0.012, 3.2e-4, 9e-5, 2.4e-4)])
table("elements.csv", "element,type,group,material,section,node1,node2",
      [(i, "beam", group, "steel", group, a, b) for i, (group, a, b) in enumerate(elements, 1)])
table("supports.csv", "support,node,x,y,z,rx,ry,rz",
      [(f"bearing_{n}", n, int(n <= 2), 1, 1, 0, 0, 0) for n in (1, 2, last + 1, last + 2)])
table("masses.csv", "group,node,mass_kg", masses)
# Names that begin with M are monitoring points: step 8 writes their accelerations.
table("points.csv", "point,node", [("M1", PANELS + 1), ("M2", PANELS + 2), ("M3", PANELS // 2 + 1)])
# What may be wrong, and between which bounds.
parameters = [("E_steel", "youngs_modulus", "steel", "Pa", f"{modulus:g}", "195e9", "216e9"), ("m_surfacing", "point_mass", "surfacing", "-", "1.0", "0.6", "1.5")]
(folder / "model.toml").write_text("\n".join(['title = "a footbridge, 45 m"\n\n# What may be wrong, and between which bounds; a point mass has a factor on the masses of its group.', *(
    f"""[[parameter]]
name = "{name}"
target = "{target}"
of = ["{of}"]
unit = "{unit}"
initial = {initial}
lower = {lower}
upper = {upper}
""" for name, target, of, unit, initial, lower, upper in parameters)]))
