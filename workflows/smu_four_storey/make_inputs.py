"""Turns the measured modes of a four-storey laboratory frame into a matrix model and features.

    python3 make_inputs.py DATA OUT

DATA holds four_story_f_hz.csv (four frequencies) and four_story_shapes.csv (floors x modes) of Structural-Model-Updating (GitHub). What
the authors publish of the frame: four floors of 12.060 lb each, accurately weighed, on a shake table; four storeys of nominally
10 lbf/in. SI units here.

K = sum theta_i K_i, each theta 1 as the authors start from. Two models that differ in their bounds:

  model            0.70 to 1.30. 10 lbf/in is a round number, but of a frame that was made to it: the stiffness of a storey goes with the
                   third power of the columns' thickness and of their clear length, so that 5 % in each (sheet and clamping of a laboratory
                   frame) makes 20 %, and 30 % is as far as workmanship goes. What lies beyond has another cause, which is to be found.
  published_model  0.01 to 2.00, the authors' own range (a change of -1 to +1). In it step 9 fits what they fitted.

Channels: floors 1 to 3. There, says the authors' readme, and on the base the accelerometers stood, and these they fit; the file of shapes has
a fourth floor of which it tells no more. all_floors/ holds the features with it: make s9 STUDY=smu_four_storey FEATURES=results/…/all_floors.

Scatter. None is published. Frequencies 0.5 %: what identifications of one record differ by, and a clamped frame from one mounting
of its sensors to the next. Shapes 3 % of the largest value: gain and alignment of an accelerometer, noise of a short record; as for the bridge of
gt_pedestrian_bridge.

Modes 1 and 2 are fitted, modes 3 and 4 held out: the authors' own choice of what to fit.
"""
import csv
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "common"))
from shear_building import write_shear_building  # noqa: E402

POUND_KG = 0.45359237
POUND_FORCE_PER_INCH = POUND_KG * 9.80665 / 0.0254  # N/m
FLOOR_KG = 12.060 * POUND_KG
STOREY_N_M = 10.0 * POUND_FORCE_PER_INCH
FREQUENCY, SHAPE = 0.005, 0.03
FLOORS, MEASURED, FITTED = 4, 3, 2


def numbers(path):
    if not path.exists():
        sys.exit(f"smu_four_storey: {path} is not there; give DATA=the folder with the frame's measured modes")
    with open(path, newline="", encoding="utf-8") as stream:
        return [[float(cell) for cell in row] for row in csv.reader(stream) if row]


def write_features(folder, frequencies, shapes, floors, modes, held_out):
    folder.mkdir(parents=True, exist_ok=True)
    rows = ["type,mode,channel,condition,value,std,held_out"]
    for m in modes:
        out = int(m in held_out)
        rows.append(f"frequency_Hz,{m + 1},,shaken,{frequencies[m]:.12g},{FREQUENCY * frequencies[m]:.6g},{out}")
        largest = max(abs(shapes[i][m]) for i in floors)
        rows += [f"shape,{m + 1},a{i + 1},shaken,{shapes[i][m]:.12g},{SHAPE * largest:.6g},{out}" for i in floors]
    (folder / "rows.csv").write_text("\n".join(rows) + "\n")
    (folder / "conditions.toml").write_text("[shaken]\n")
    (folder / "channels.csv").write_text(
        "channel,point,x_m,y_m,z_m,dx,dy,dz\n" + "".join(f"a{i + 1},floor{i + 1},0,0,{i + 1},1,0,0\n" for i in floors)
    )


def main(data, out):
    data, out = pathlib.Path(data), pathlib.Path(out)
    frequencies = [row[0] for row in numbers(data / "four_story_f_hz.csv")]
    shapes = numbers(data / "four_story_shapes.csv")
    every, held_out = list(range(FLOORS)), set(range(FITTED, FLOORS))
    for name, title, lower, upper in (
        ("model", "Four-storey laboratory frame", 0.7, 1.3),
        ("published_model", "Four-storey laboratory frame, the authors' bounds", 0.01, 2.0),
    ):
        write_shear_building(out / name, title, FLOORS * [FLOOR_KG], FLOORS * [STOREY_N_M], lower, upper)
    write_features(out / "features", frequencies, shapes, every[:MEASURED], every, held_out)
    write_features(out / "all_floors", frequencies, shapes, every, every, held_out)


if __name__ == "__main__":
    if len(sys.argv) != 3 or not sys.argv[1]:
        sys.exit("smu_four_storey: give the folder with the frame's measured modes, make all STUDY=smu_four_storey DATA=dir")
    main(*sys.argv[1:3])
