"""Turns the measured modes of an 18-storey steel frame on a shake table into a matrix model and features.

    python3 make_inputs.py DATA OUT

DATA holds eighteen_story_modes.csv (frequency, damping), eighteen_story_shapes.csv (channels x modes) and eighteen_story_meas_dofs.csv of
Structural-Model-Updating (GitHub). What the authors publish of the frame, a third of a building, shaken at E-Defense (NIED): weights of the
floors, which were weighed, and nominal stiffness of the storeys. SI units here.

K = sum theta_i K_i, each theta 1 as nominal: a building that bends in shear alone.

  model            0.80 to 1.20. Storeys of rolled steel: modulus and sizes within a few per cent; joints, panel zones and the length of columns that
                   really bends make 10 to 20 % of a storey's stiffness.
  published_model  0.70 to 1.30, the authors' own range.
  bending_model    Written after the first two had been diagnosed. A tall frame bends as a whole too: its columns lengthen on one side and shorten on
                   the other, so that floors turn. A floor gets a rotation (times the storey's height, without inertia); a storey shears by
                   u_i - u_{i-1} less the mean of the two rotations, and a rotational spring of 1155 MN/m ties each floor to the one below.
                   Parameters: `storeys`, all of them by one factor, 0.7 to 2; each storey beside that, -0.2 to 0.2; `bending`, 10 to 1000 times that
                   spring (nothing of the columns' sections is public: two orders of magnitude about what makes bending as soft as shear
                   over the height of 18 storeys, 18^2/3 = 108).

Scatter. None is published. Frequencies 0.5 % and shapes 3 % of the largest value, as for the frame of smu_four_storey. Floors 1 %: they were weighed.

Modes 1 and 2 are fitted, the authors' choice; mode 3 is held out.
"""
import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "common"))
from shear_building import parameter_table, write_lower_triangle, write_shear_building  # noqa: E402

STOREY_N_M = [1e5 * k for k in (1155, 1092, 1073, 1028, 1028, 990, 963, 938, 876, 840, 824, 788, 712, 660, 619, 562, 491, 363)]
FLOOR_KG = [1e3 * w / 9.8 for w in [208] * 11 + [206] * 6 + [202]]
FREQUENCY, SHAPE = 0.005, 0.03
FITTED = 2


def table(path):
    if not path.exists():
        sys.exit(f"smu_eighteen_storey: {path} is not there; give DATA=the folder with the frame's measured modes")
    with open(path, newline="", encoding="utf-8") as stream:
        return [row for row in csv.reader(stream) if row]


def add_spring(entries, stiffness, coefficients):
    """Adds a spring over sum c_i u_i. @param coefficients  1-based dof -> c"""
    for i, a in coefficients.items():
        for j, b in coefficients.items():
            if j <= i:
                entries[i, j] = entries.get((i, j), 0.0) + stiffness * a * b


def write_bending_model(folder):
    folder.mkdir(parents=True, exist_ok=True)
    floors = len(FLOOR_KG)
    size = 2 * floors
    write_lower_triangle(folder / "K0.mtx", size, {})
    write_lower_triangle(folder / "M0.mtx", size, {(i, i): mass for i, mass in enumerate(FLOOR_KG, 1)})
    every, bending = {}, {}
    text = 'title = "Eighteen-storey steel frame that bends as a whole too"\n[matrices]\nK = "K0.mtx"\nM = "M0.mtx"\n'

    def parameter(name, entries, initial, lower, upper):
        write_lower_triangle(folder / f"K_{name}.mtx", size, entries)
        return parameter_table(name, initial, lower, upper)

    for i, stiffness in enumerate(STOREY_N_M, 1):
        storey, sheared, turned = {}, {i: 1.0, floors + i: -0.5}, {floors + i: 1.0}
        if i > 1:
            sheared |= {i - 1: -1.0, floors + i - 1: -0.5}
            turned |= {floors + i - 1: -1.0}
        for entries in (storey, every):
            add_spring(entries, stiffness, sheared)
        add_spring(bending, STOREY_N_M[0], turned)
        text += parameter(f"storey{i:02d}", storey, 0.0, -0.2, 0.2)
    text += parameter("storeys", every, 1.0, 0.7, 2.0) + parameter("bending", bending, 108.0, 10.0, 1000.0)
    (folder / "model.toml").write_text(text)
    (folder / "dofs.csv").write_text(
        "dof,node,direction,x_m,y_m,z_m\n"
        + "".join(f"{i},floor{i:02d},x,0,0,{i}\n" for i in range(1, floors + 1))
        + "".join(f"{floors + i},floor{i:02d},ry,0,0,{i}\n" for i in range(1, floors + 1))
    )


def main(data, out):
    data, out = pathlib.Path(data), pathlib.Path(out)
    frequencies = [float(row[0]) for row in table(data / "eighteen_story_modes.csv")[1:]]
    shapes = [[float(v) for v in row] for row in table(data / "eighteen_story_shapes.csv")]
    floors = [int(float(row[0])) for row in table(data / "eighteen_story_meas_dofs.csv")]
    for name, lower, upper in (("model", 0.8, 1.2), ("published_model", 0.7, 1.3)):
        write_shear_building(out / name, "Eighteen-storey steel frame", FLOOR_KG, STOREY_N_M, lower, upper)
    write_bending_model(out / "bending_model")
    features = out / "features"
    features.mkdir(parents=True, exist_ok=True)
    rows = ["type,mode,channel,condition,value,std,held_out"]
    for m, frequency in enumerate(frequencies):
        held_out = int(m >= FITTED)
        rows.append(f"frequency_Hz,{m + 1},,shaken,{frequency:.12g},{FREQUENCY * frequency:.6g},{held_out}")
        largest = max(abs(row[m]) for row in shapes)
        rows += [
            f"shape,{m + 1},a{floor:02d},shaken,{row[m]:.12g},{SHAPE * largest:.6g},{held_out}"
            for floor, row in zip(floors, shapes, strict=True)
        ]
    (features / "rows.csv").write_text("\n".join(rows) + "\n")
    (features / "conditions.toml").write_text("[shaken]\n")
    (features / "channels.csv").write_text(
        "channel,point,x_m,y_m,z_m,dx,dy,dz\n" + "".join(f"a{i:02d},floor{i:02d},0,0,{i},1,0,0\n" for i in floors)
    )


if __name__ == "__main__":
    if len(sys.argv) != 3 or not sys.argv[1]:
        sys.exit("smu_eighteen_storey: give the folder with the frame's measured modes, make all STUDY=smu_eighteen_storey DATA=dir")
    main(*sys.argv[1:3])
