"""Writes two element models of the steel frame of Weimar from its measured geometry and what is written about it.

    python3 make_inputs.py DATA OUT

DATA holds grid.txt (node, x, y, z in cm: the corners of the floors, numbered upwards). Written: a frame 1 m high, four threaded rods M8 as
columns, five floors of 36 x 36 cm plate 5 mm thick clamped to them, a fixed base, cross bracing in the lowest storey only and only in y.

OUT/model takes all of that at its word. What is not written is assumed, each with its reason; what may be wrong is a parameter, with
bounds that say how far it is believed (prior deviation: a quarter of the range). What is known in orders of magnitude only starts in their
middle.
  EI_rod        modulus of the rods. Second moment from the stress area (36.6 mm2, d = 6.83 mm). From the core of the thread (6.47 mm,
                0.80) to its pitch diameter (7.19 mm, 1.23): where between them a thread bends is not known better.
  k_clamp       rotation of a rod in floors 1 to 4, which it runs through between two nuts. A rod of the storey resists with
                4 EI/L = 450 N m/rad: from 10 (nuts that hardly hold) to 2000 (as good as rigid), as drawn 140.
  k_clamp_top   the same at floor 5, where the rods end: a detail of its own.
  k_base        the same at the fixed base, 100 to 4000 N m/rad, as drawn 630.
  A_brace       diagonals of the lowest storey. Neither section nor prestress is written: from slack (nothing) to 20 mm2, as drawn 10 mm2.
  t_floor       plates, 4.7 to 5.5 mm: rolling tolerances of 5 mm plate (EN 10029), mass and stiffness together.
  m_sensor      three accelerometers on corner 24, 0.1 kg each as drawn; their make is not written: 0.05 to 0.3 kg each.
No parameter, but assumed: rods 20 mm inside the edges of the plates (two and a half diameters; nut and washer need 12 mm).

OUT/model_open is the same frame after steps 4 and 6 have shown that no value within these bounds comes near the measured frequencies. Two
statements are no longer taken at their word: the thread is anything from M4 (core) to M8 (pitch), starting at M6; and the diagonals, which
hold next to nothing, start in the middle of their orders of magnitude.
"""
import csv
import math
import pathlib
import sys

HALF_PLATE, INSET = 0.180, 0.020  # [m]
ROD_AREA, ROD_DIAMETER = 36.6e-6, 6.827e-3  # stress area and its diameter, ISO 898-1
PIECES = 4  # beams a storey
SEAT = 5e7  # [N/m] between rod and plate, along all three axes: a thousand times the sway stiffness of a rod
CLAMP, CLAMP_TOP, BASE = 140.0, 140.0, 630.0  # [N m/rad]: the middle of the orders of magnitude that they may have
SENSORS = 0.3  # [kg]
SENSOR_POINT = 24
# What the two models differ in: modulus of the rods and its bounds [Pa], area of the diagonals [m2].
AS_WRITTEN = {"rod": 210e9, "rod_low": 168e9, "rod_high": 258e9, "brace": 10e-6}
OPEN = {"rod": 63e9, "rod_low": 9.5e9, "rod_high": 258e9, "brace": 1.4e-7}


def levels(file):
    """Heights of base and floors, and the corner points by number, from grid.txt."""
    points = {}
    for line in file.read_text().splitlines()[1:]:
        cells = line.split()
        if len(cells) == 4:
            points[int(cells[0])] = [float(cell) / 100 for cell in cells[1:]]
    return sorted({round(z, 6) for _, _, z in points.values()}), points


class Model:
    def __init__(self):
        self.nodes, self.elements, self.springs, self.supports, self.masses, self.points = [], [], [], [], [], []

    def node(self, x, y, z):
        self.nodes.append([len(self.nodes) + 1, f"{x:.6g}", f"{y:.6g}", f"{z:.6g}"])
        return len(self.nodes)

    def element(self, kind, group, material, section, nodes):
        self.elements.append([len(self.elements) + 1, kind, group, material, section, *nodes, *[""] * (4 - len(nodes))])

    def spring(self, group, quantity, stiffness, node, other=""):
        for axis in range(3):
            direction = [int(axis == k) for k in range(3)]
            self.springs.append([f"{group}_{len(self.springs) + 1}", group, node, other, *direction, quantity, stiffness])

    def write(self, folder, belief):
        folder.mkdir(parents=True, exist_ok=True)
        tables = {
            "nodes.csv": ("node,x_m,y_m,z_m", self.nodes),
            "elements.csv": ("element,type,group,material,section,node1,node2,node3,node4", self.elements),
            "springs.csv": ("spring,group,node,node2,direction_x,direction_y,direction_z,quantity,stiffness_N_m", self.springs),
            "supports.csv": ("support,node,x,y,z,rx,ry,rz", self.supports),
            "masses.csv": ("group,node,mass_kg", self.masses),
            "points.csv": ("point,node", self.points),
            "materials.csv": ("material,youngs_modulus_Pa,poisson_ratio,density_kg_m3",
                              [["rod_steel", belief["rod"], 0.3, 7850], ["plate_steel", 210e9, 0.3, 7850], ["brace_steel", 210e9, 0.3, 7850]]),
        }
        inertia = math.pi * ROD_DIAMETER**4 / 64
        tables["sections.csv"] = ("section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4,thickness_m", [
            ["rod", ROD_AREA, f"{inertia:.6g}", f"{inertia:.6g}", f"{2 * inertia:.6g}", ""],
            ["plate", "", "", "", "", 0.005],
            ["brace", belief["brace"], "", "", "", ""]])
        for name, (header, rows) in tables.items():
            with open(folder / name, "w", newline="") as stream:
                csv.writer(stream, lineterminator="\n").writerows([header.split(","), *rows])
        text = ('title = "Steel frame, Bauhaus-Universitaet Weimar"\n'
                "# The weight of the floors presses on the rods and takes part of their sway stiffness.\n"
                "[prestress]\ngeometric_stiffness = true\n")
        for name, target, of, unit, initial, lower, upper in [
                ("EI_rod", "youngs_modulus", "rod_steel", "Pa", belief["rod"], belief["rod_low"], belief["rod_high"]),
                ("k_clamp", "spring_stiffness", "clamp", "-", 1.0, 10 / CLAMP, 2000 / CLAMP),
                ("k_clamp_top", "spring_stiffness", "clamp_top", "-", 1.0, 10 / CLAMP_TOP, 2000 / CLAMP_TOP),
                ("k_base", "spring_stiffness", "base", "-", 1.0, 100 / BASE, 4000 / BASE),
                ("A_brace", "area", "brace", "m2", belief["brace"], 1e-9, 20e-6),
                ("t_floor", "thickness", "plate", "m", 0.005, 0.0047, 0.0055),
                ("m_sensor", "point_mass", "sensors", "-", 1.0, 0.5, 3.0)]:
            text += (f'\n[[parameter]]\nname = "{name}"\ntarget = "{target}"\nof = ["{of}"]\nunit = "{unit}"\n'
                     f"initial = {initial:.6g}\nlower = {lower:.6g}\nupper = {upper:.6g}\n")
        (folder / "model.toml").write_text(text)


def main(data, out):
    data, out = pathlib.Path(data), pathlib.Path(out)
    if not (data / "grid.txt").is_file():
        sys.exit(f"weimar_frame: {data}/grid.txt is not there; DATA is the folder with setup_NN.npy, setup_NN_channel_dofs.txt and grid.txt")
    heights, corners = levels(data / "grid.txt")
    model, rod_at = Model(), HALF_PLATE - INSET
    feet = {(sx, sy): model.node(sx * rod_at, sy * rod_at, heights[0]) for sx in (1, -1) for sy in (1, -1)}
    for node in feet.values():
        model.supports.append(["base", node, 1, 1, 1, 0, 0, 0])
        model.spring("base", "rotation", BASE, node)
    below, lines = dict(feet), [-HALF_PLATE, -rod_at, -rod_at / 2, 0.0, rod_at / 2, rod_at, HALF_PLATE]
    for floor, (low, high) in enumerate(zip(heights, heights[1:]), 1):
        plate = {(i, j): model.node(x, y, high) for i, x in enumerate(lines) for j, y in enumerate(lines)}
        for i in range(6):
            for j in range(6):
                model.element("shell", f"floor_{floor}", "plate_steel", "plate",
                              [plate[i, j], plate[i + 1, j], plate[i + 1, j + 1], plate[i, j + 1]])
        for (sx, sy), node in below.items():
            for piece in range(1, PIECES + 1):
                upper = model.node(sx * rod_at, sy * rod_at, low + (high - low) * piece / PIECES)
                model.element("beam", f"rods_{floor}", "rod_steel", "rod", [node, upper])
                node = upper
            below[sx, sy] = node
            hole = plate[5 if sx > 0 else 1, 5 if sy > 0 else 1]
            model.spring("seat", "translation", SEAT, node, hole)
            top = high == heights[-1]
            model.spring("clamp_top" if top else "clamp", "rotation", CLAMP_TOP if top else CLAMP, node, hole)
            if floor == 1:  # two diagonals in each of the planes x = const
                model.element("bar", "brace", "brace_steel", "brace", [feet[sx, -sy], hole])
        for number, (x, y, z) in corners.items():
            if abs(z - high) < 1e-6:
                model.points.append([number, plate[6 if x > 0 else 0, 6 if y > 0 else 0]])
                if number == SENSOR_POINT:
                    model.masses.append(["sensors", model.points[-1][1], SENSORS])
    model.write(out / "model_open", OPEN)
    model.write(out / "model", AS_WRITTEN)


if __name__ == "__main__":
    main(*sys.argv[1:3])
