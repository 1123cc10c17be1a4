"""Turns the published records of the Georgia Tech steel pedestrian bridge into a matrix model and features.

    python3 make_inputs.py DATA OUT

DATA holds K_*.mtx, M0.mtx, meas_dofs.csv, measured_modes.csv, measured_shapes.csv, measured_shapes_std.csv (Otsuki, Li, Jangid and
Wang, Structural-Model-Updating, GitHub). Units are kip, inch and second throughout; frequencies in Hz don't depend on them.

K = sum theta_i K_i, each theta 1 as drawn. Bounds:
  frame, truss   0.90 to 1.10: steel; modulus and rolling tolerances together stay within a few per cent
  concrete       0.80 to 1.40: modulus of a concrete deck known by its strength class alone, and its bond to the steel
  springs        0.10 to 11:   supports whose stiffness is known in order of magnitude only (the range of the published update)
A deviation of zero (one entry is normalised by itself) counts as missing, and the entry is left out.
"""
import csv
import pathlib
import shutil
import sys


def table(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return [[cell for cell in row] for row in csv.reader(stream) if row]


def bounds(name):
    if name.startswith("Conc"):
        return 0.80, 1.40
    if name in ("Frame", "Truss"):
        return 0.90, 1.10
    return 0.10, 11.0


def main(data, out):
    data, out = pathlib.Path(data), pathlib.Path(out)
    if not (data / "M0.mtx").exists():
        sys.exit(f"{data}: M0.mtx is not there; give DATA=the folder with the bridge's matrices")
    model, features = out / "model", out / "features"
    for folder in (model, features):
        folder.mkdir(parents=True, exist_ok=True)
    size = int(next(line for line in (data / "M0.mtx").read_text().splitlines() if not line.startswith("%")).split()[0])
    shutil.copy(data / "M0.mtx", model / "M0.mtx")
    (model / "K0.mtx").write_text(f"%%MatrixMarket matrix coordinate real symmetric\n{size} {size} 0\n")
    text = 'title = "Georgia Tech steel pedestrian bridge"\n[matrices]\nK = "K0.mtx"\nM = "M0.mtx"\n'
    for file in sorted(data.glob("K_*.mtx")):
        name = file.stem[2:]
        shutil.copy(file, model / file.name)
        lower, upper = bounds(name)
        text += (f'\n[[parameter]]\nname = "{name}"\nmatrix = "{file.name}"\ntarget = "stiffness"\ninitial = 1.0\n'
                 f"lower = {lower}\nupper = {upper}\n")
    (model / "model.toml").write_text(text)
    (model / "dofs.csv").write_text("dof,node,direction,x_m,y_m,z_m\n" + "".join(f"{i},n{i},x,,,\n" for i in range(1, size + 1)))

    dofs = [int(float(row[0])) for row in table(data / "meas_dofs.csv")[1:]]
    modes = table(data / "measured_modes.csv")[1:]
    shapes, deviations = table(data / "measured_shapes.csv"), table(data / "measured_shapes_std.csv")
    rows = ["type,mode,channel,condition,value,std"]
    for m, mode in enumerate(modes):
        frequency = float(mode[0])
        rows.append(f"frequency_Hz,{m + 1},,tests,{frequency:.12g},{0.01 * float(mode[3]) * frequency:.6g}")
        for k, dof in enumerate(dofs):
            deviation = float(deviations[k][m])
            if deviation > 1e-9:
                rows.append(f"shape,{m + 1},c{dof},tests,{float(shapes[k][m]):.12g},{deviation:.6g}")
    (features / "rows.csv").write_text("\n".join(rows) + "\n")
    (features / "conditions.toml").write_text("[tests]\n")
    (features / "channels.csv").write_text("channel,point\n" + "".join(f"c{dof},n{dof}\n" for dof in dofs))


if __name__ == "__main__":
    main(*sys.argv[1:3])
