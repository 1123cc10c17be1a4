"""Writes the model folder of a two-storey steel frame: python3 frame.py FOLDER [base spring N m/rad] [floor mass kg] [mass at D kg]"""
import csv
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
base_spring = float(sys.argv[2]) if len(sys.argv) > 2 else 12e6
floor_mass = float(sys.argv[3]) if len(sys.argv) > 3 else 1500.0
mass_at_D = float(sys.argv[4]) if len(sys.argv) > 4 else 0.0
folder.mkdir(parents=True, exist_ok=True)


def table(name, header, rows):
    with open(folder / name, "w", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([header.split(","), *rows])


# Two columns, 5 m apart, two storeys of 3 m; every member in four beams. The frame moves in its plane, x-z.
nodes, elements = {}, []


def node(x, z):
    return nodes.setdefault((round(x, 6), round(z, 6)), len(nodes) + 1)


def member(a, b, group, pieces=4):
    at = [(a[0] + (b[0] - a[0]) * i / pieces, a[1] + (b[1] - a[1]) * i / pieces) for i in range(pieces + 1)]
    elements.extend([(group, node(*p), node(*q)) for p, q in zip(at, at[1:])])


for x in (0, 5):
    member((x, 0), (x, 3), "column")
    member((x, 3), (x, 6), "column")
for z in (3, 6):
    member((0, z), (5, z), "beam")

table("nodes.csv", "node,x_m,y_m,z_m", [[n, x, 0, z] for (x, z), n in nodes.items()])
table("materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3", [["steel", 210e9, 0.3, 7850]])
table("sections.csv", "section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4",
      [["column", 5.38e-3, 3.69e-5, 1.34e-5, 2.1e-7], ["beam", 5.38e-3, 8.36e-5, 6.04e-6, 2.0e-7]])
table("elements.csv", "element,type,group,material,section,node1,node2,orientation_x,orientation_y,orientation_z",
      [[i, "beam", g, "steel", g, a, b, 0, 0, 0] if g == "beam" else [i, "beam", g, "steel", g, a, b, 1, 0, 0]
       for i, (g, a, b) in enumerate(elements, 1)])
feet = [node(0, 0), node(5, 0)]
table("supports.csv", "support,node,x,y,z,rx,ry,rz",
      [["foot" if n in feet else "plane", n, int(n in feet), 1, int(n in feet), 1, 0, 1] for n in nodes.values()])
table("springs.csv", "spring,group,node,direction_x,direction_y,direction_z,quantity,stiffness_N_m",
      [[f"base_{i}", "base", n, 0, 1, 0, "rotation", base_spring] for i, n in enumerate(feet, 1)])
floors = [["floor", node(x, z), floor_mass] for z in (3, 6) for x in (0, 2.5, 5)]
table("masses.csv", "group,node,mass_kg", floors + ([["D", node(2.5, 6), mass_at_D]] if mass_at_D else []))
table("points.csv", "point,node", [["A", node(0, 3)], ["B", node(0, 6)], ["C", node(2.5, 3)], ["D", node(2.5, 6)]])
(folder / "model.toml").write_text("""title = "two-storey frame"

[[parameter]]                # what may be wrong, and between which bounds
name = "k_base"
target = "spring_stiffness"  # a factor on the springs of group "base"
of = ["base"]
unit = "-"
initial = 1.0
lower = 0.2
upper = 5.0

[[parameter]]
name = "m_floor"
target = "point_mass"        # a factor on the masses of group "floor"
of = ["floor"]
unit = "-"
initial = 1.0
lower = 0.7
upper = 1.4

[[parameter]]
name = "E_steel"
target = "youngs_modulus"
of = ["steel"]
unit = "Pa"
initial = 210e9
lower = 204e9
upper = 216e9
""")
