"""make bench-places: processor seconds (one thread) and peak memory of a diagnosis against the number of candidate places, without and with a form error of the model.

    python3 tests/bench/places.py BIN OUT [PLACES ...]

BIN: folder of the executables; OUT: where places.csv goes; PLACES: how many nodes and zones are candidates (25 50 100 200 500 1000). The girder of
tests/steps/three_span_girder.py with a soft pier, six modes measured at nine sensors; its model has as many nodes as there are places.
The exponent is that of the last doubling: 1 is linear.
"""
import csv
import json
import math
import pathlib
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/steps"))
import table as bench  # noqa: E402
import three_span_girder as girder  # noqa: E402

PLACES = (25, 50, 100, 200, 500, 1000)
MODES = 6
FREQUENCY_ERROR, SHAPE_ERROR = 0.002, 0.01
SOFTER = {"W": 0.7}
SEED = 5


def write_features(folder):
    """Six modes of the girder with a soft west pier, as a beam with shear: another class than the model."""
    random = np.random.default_rng(SEED)
    frequency, shapes = girder.modes(SOFTER, shear=True)
    folder.mkdir()
    rows = []
    for m in range(MODES):
        f = frequency[m] * (1 + FREQUENCY_ERROR * random.normal())
        rows.append(["frequency_Hz", m + 1, "", "as_found", f"{f:.6g}", f"{FREQUENCY_ERROR * f:.3g}"])
        at = [round(x / girder.LENGTH * (len(shapes) - 1)) for x in girder.SENSORS.values()]
        shape = shapes[at, m] / np.abs(shapes[at, m]).max()
        rows += [["shape", m + 1, name, "as_found", f"{v + SHAPE_ERROR * random.normal():.6g}", SHAPE_ERROR]
                 for name, v in zip(girder.SENSORS, shape)]
    girder.table(folder / "rows.csv", "type,mode,channel,condition,value,std", rows)
    girder.table(folder / "channels.csv", "channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role",
                 [[name, name, x, 0, 0, 0, 0, 1, "acceleration", "m/s2", 1, 1, "response"] for name, x in girder.SENSORS.items()])
    (folder / "conditions.toml").write_text("[as_found]\ntemperature_C = 14.0\n")


def main():
    binaries, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    sizes = [int(n) for n in sys.argv[3:]] or PLACES
    out.mkdir(parents=True, exist_ok=True)
    table = []
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        write_features(work / "features")
        for size in sizes:
            girder.write_model(work / f"model_{size}", beams=28 * math.ceil(size / 28))
            row = {"places": size}
            for form in ("off", "on"):
                result = work / f"s9_{size}_{form}"
                _, row[f"form_{form}_s"], row[f"form_{form}_MB"] = bench.run_child(
                    [binaries / "s9_diagnosis", "--model", work / f"model_{size}", "--features", work / "features", "--out", result, "--set", f"form={form}",
                     "--set", f"nodes={size}", "--set", f"zones={size}", "--quiet"])
                told = json.loads((result / "diagnosis.json").read_text())
                row[f"form_{form}_verdict"] = told["verdict"]
                row[f"form_{form}_leader"] = f"{told['effects'][0]['cause']}@{told['effects'][0]['location']}" if told["effects"] else ""
            table.append(row)
            growth = [math.log(row[f"form_{form}_s"] / table[-2][f"form_{form}_s"]) / math.log(size / table[-2]["places"]) if len(table) > 1 else math.nan
                      for form in ("off", "on")]
            print(f"{size} places: {row['form_off_s']:.1f} s, {row['form_off_MB']:.0f} MB without, {row['form_on_s']:.1f} s, {row['form_on_MB']:.0f} MB with a form error; exponents {growth[0]:.2f} and "
                  f"{growth[1]:.2f}; {row['form_off_verdict']} {row['form_off_leader']}, {row['form_on_verdict']} {row['form_on_leader']}", flush=True)
    with open(out / "places.csv", "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, table[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)


if __name__ == "__main__":
    main()
