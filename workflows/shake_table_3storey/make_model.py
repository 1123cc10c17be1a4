"""Writes a model of the three storeys, and three modes of each state as features of it.

    make_model.py CAMPAIGN S3_FEATURES OUT

CAMPAIGN is what campaign.py wrote, S3_FEATURES what step 3 identified in it; OUT gets model/, features/ and, for the fit to the
first state alone, reference_features/.

Model: three equal floors on three storeys that shear, which is all that is known of the frame ("3-storey, flexible and stiff"). The mass of a floor
is set to 1 kg: with the motion of the table as input, frequencies and shapes know stiffness over mass only, and ratios of the two states know no
mass at all. Each storey starts at the stiffness that puts the first mode of three equal storeys at the first frequency of the flexible state, and may have
0.3 to 3 of it: in a frame whose storeys look alike one may have a third of the others' columns, not a thirtieth.

Rows: frequency and shape at the floors of three modes a state. Step 3 also finds multiples of the first frequency (joints that knock at
2, 3, 4 times 3.7 Hz). A mode of the frame is one that the table drives: it stands in the transfer function from the table to the floors. The
three highest peaks of its size are taken (sum over the floors), and of the poles within 3 % of each the one whose frequency is known best.
Damping is left out: the model has none.
"""
import csv
import pathlib
import sys
import tomllib

import numpy as np
from scipy.signal import csd, find_peaks, welch

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "common"))
from shear_building import write_shear_building  # noqa: E402

FLOORS, FLOOR_KG, LOWER, UPPER = 3, 1.0, 0.3, 3.0
FIRST = 2.0 * np.sin(np.pi / 14.0)  # omega_1 of three equal storeys and floors, in units of sqrt(k/m)
SEGMENT, NEAR, BAND_HZ = 1024, 0.03, (2.0, 48.0)


def fail(message):
    sys.exit(f"shake_table_3storey: {message}")


def driven(record, rate):
    """Frequencies [Hz] of the highest peaks of the transfer function from the table, as many as there are floors."""
    hertz, table = welch(record[:, 0], rate, nperseg=SEGMENT)
    size = sum(np.abs(csd(record[:, 0], floor, rate, nperseg=SEGMENT)[1]) / table for floor in record[:, 1:].T)
    within = (hertz > BAND_HZ[0]) & (hertz < BAND_HZ[1])
    hertz, size = hertz[within], size[within]
    peaks, _ = find_peaks(size, distance=int(2.0 / (hertz[1] - hertz[0])))
    return np.sort(hertz[peaks[np.argsort(-size[peaks])][:FLOORS]])


def read_modes(file):
    """state -> list of (frequency, its deviation, rows)"""
    modes = {}
    with open(file, newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            modes.setdefault(row["condition"], {}).setdefault(row["mode"], []).append(row)
    out = {}
    for state, found in modes.items():
        for rows in found.values():
            told = next(r for r in rows if r["type"] == "frequency_Hz")
            out.setdefault(state, []).append((float(told["value"]), float(told["std"]), rows))
    return out


def write_features(folder, table, conditions):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "rows.csv").write_text("\n".join(table) + "\n")
    (folder / "conditions.toml").write_text(conditions)
    (folder / "channels.csv").write_text(
        "channel,point,x_m,y_m,z_m,dx,dy,dz\n" + "".join(f"a{k},floor{k},0,0,{k},1,0,0\n" for k in range(1, FLOORS + 1))
    )


def main(campaign, features, out):
    with open(campaign / "campaign.toml", "rb") as stream:
        records = tomllib.load(stream)["record"]
    found = read_modes(features / "rows.csv")
    table, conditions, first = ["type,mode,channel,condition,value,std"], "", None
    for record in records:
        state = record["condition"]
        conditions += f'[{state}]\nstate = "{state}"\n\n'
        for number, peak in enumerate(driven(np.load(campaign / record["file"]), record["sampling_rate_Hz"]), 1):
            near = [m for m in found.get(state, []) if abs(m[0] / peak - 1.0) < NEAR]
            if not near:
                fail(f"{features / 'rows.csv'} has no mode of {state} near the peak at {peak:.2f} Hz")
            frequency, _, rows = min(near, key=lambda m: m[1] / m[0])
            first = first or frequency
            table += [f"{r['type']},{number},{r['channel']},{state},{r['value']},{r['std']}" for r in rows if r["type"] in ("frequency_Hz", "shape")]
    storey = FLOOR_KG * (2.0 * np.pi * first / FIRST) ** 2
    write_shear_building(out / "model", "Three-storey frame on a shake table", FLOORS * [FLOOR_KG], FLOORS * [storey], LOWER, UPPER)
    reference = records[0]["condition"]
    alone = [table[0]] + [row for row in table[1:] if row.split(",")[3] == reference]
    write_features(out / "features", table, conditions)
    write_features(out / "reference_features", alone, conditions.split("\n\n")[0] + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        fail("usage: make_model.py CAMPAIGN S3_FEATURES OUT")
    main(*(pathlib.Path(a) for a in sys.argv[1:4]))
