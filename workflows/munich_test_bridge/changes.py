"""What the records of the Munich test bridge show when a support was lowered in three steps: changes.py DATA [OUT.csv]

There is no study of this bridge, because no model can be built from what is published with its records: no span, no section, no material, no place of
a sensor or of a support, no size of a lowering. What can be done is done: the rows are read and their changes printed.

DATA holds index.csv (file, first_stamp, samples, fs_hz, columns, ...) and the arrays .npy: strain DMS_CN in um/m, forces FRC-01 and FRC-02 in kN, air
temperature in degrees. Days and months are exchanged in the stamps of the strain and force files (2022-11-04 is 11 April 2022).

A load test of 12 minutes stands before the first step and after each; it begins and ends with the bridge unloaded. The level of a test is the median of its first
30 s, its drift the median of its last 30 s less that; what the load does is read in the same file, as the largest difference from the level
of medians over 30 s. A step of the lowering itself is the difference between the last 30 s and the first 30 s of its file or files. What the strain does between the end of a load
test and the start of the next lowering, hours later, no support has done.
"""
import csv
import pathlib
import sys

import numpy as np

WINDOW_S = 30.0
TESTS = ("ref_support_load_01", "support_load_01", "support_load_02", "support_load_03")
LOWERINGS = {
    "step 1": ("support_01_lowering_01", "support_01_lowering_02"),
    "step 2": ("support_02_lowering",),
    "step 3": ("support_03_lowering",),
}
AIR = {
    "ref_support_load_01": "temperature_ref_load_01",
    **{f"support_load_0{i}": f"temperature_support_load_0{i}" for i in (1, 2, 3)},
}
STRAIN, FORCE = "DMS_CNAt100Hz", "ForceAt100Hz"
QUANTITIES = ("DMS_CN [um/m]", "FRC-01 [kN]", "FRC-02 [kN]")


def fail(message):
    sys.exit(f"munich_test_bridge: {message}")


class Records:
    """The arrays of a folder, each cut into means over WINDOW_S."""

    def __init__(self, data):
        self.data = data
        if not (data / "index.csv").is_file():
            fail(f"{data / 'index.csv'} is not there; DATA is the folder with index.csv and the arrays .npy")
        with open(data / "index.csv", newline="", encoding="latin-1") as stream:
            self.rate = {row["file"]: float(row["fs_hz"]) for row in csv.DictReader(stream)}

    def medians(self, name):
        """(windows x columns) medians of consecutive windows; the last one ends with the record."""
        if name not in self.rate or not (self.data / f"{name}.npy").is_file():
            fail(f"{self.data / name}.npy is not there")
        samples = np.load(self.data / f"{name}.npy").astype(float)
        samples = samples.reshape(len(samples), -1)
        length = int(WINDOW_S * self.rate[name])
        starts = [*range(0, len(samples) - length, length), len(samples) - length]
        return np.array([np.median(samples[s : s + length], axis=0) for s in starts])


def load_tests(records):
    """test -> (level, drift within the test, what the load does at most), each of the strain and both forces; and the air's temperature"""
    out = {}
    for test in TESTS:
        levels, drifts, loads = [], [], []
        for windows in (records.medians(test + STRAIN), records.medians(test + FORCE)):
            away = windows - windows[0]
            levels += list(windows[0])
            drifts += list(away[-1])
            loads += list(away[np.abs(away).argmax(axis=0), range(away.shape[1])])
        out[test] = (levels, drifts, loads, float(np.median(records.medians(AIR[test]))))
    return out


def lowerings(records):
    """step -> strain at its start and its end [um/m]"""
    out = {}
    for step, files in LOWERINGS.items():
        windows = [records.medians(file + STRAIN) for file in files]
        out[step] = (float(windows[0][0, 0]), float(windows[-1][-1, 0]))
    return out


def table(data):
    """Rows of what changed: quantity, its level before any step and its change after each step since then, its drift in a test, what a load does."""
    records = Records(data)
    tests = load_tests(records)
    first = tests[TESTS[0]]
    rows = []
    for i, quantity in enumerate(QUANTITIES):
        row = {"quantity": quantity, "before": first[0][i]}
        row |= {f"after_step_{k}": tests[test][0][i] - first[0][i] for k, test in enumerate(TESTS[1:], 1)}
        row["drift_in_a_test"] = max((tests[test][1][i] for test in TESTS), key=abs)
        row |= {f"load_{k}": tests[test][2][i] for k, test in enumerate(TESTS)}
        rows.append(row)
    air = {"quantity": "air [degrees C]", "before": first[3]}
    air |= {f"after_step_{k}": tests[test][3] - first[3] for k, test in enumerate(TESTS[1:], 1)}
    return [*rows, air], lowerings(records)


def main(data, out=None):
    rows, steps = table(data)
    for row in rows:
        print(f"{row['quantity']:16s} {row['before']:8.2f}   changed by " + "  ".join(f"{row[f'after_step_{k}']:+8.2f}" for k in (1, 2, 3)))
        if "drift_in_a_test" in row:
            loads = "  ".join(f"{row[f'load_{k}']:+.2f}" for k in range(len(TESTS)))
            print(f"{'':16s} drift in a test at most {row['drift_in_a_test']:+.2f}; the load does {loads}")
    for step, (start, end) in steps.items():
        print(f"{step}: strain from {start:.2f} to {end:.2f} um/m while the support went down")
    down = sum(end - start for start, end in steps.values())
    print(f"of {rows[0]['after_step_3']:.1f} um/m in all {down:.1f} came while a support went down, the rest in the hours between, as the air grew warmer")
    if out:
        with open(out, "w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, rows[0].keys(), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        fail("usage: changes.py DATA [OUT.csv]")
    main(*(pathlib.Path(a) for a in sys.argv[1:]))
