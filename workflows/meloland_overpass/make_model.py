"""Writes a matrix model of the overpass's transverse motion, and one mode of each earthquake as features of it.

    make_model.py CAMPAIGN S3_FEATURES OUT

CAMPAIGN is what campaign.py wrote (records of the ground and the deck), S3_FEATURES what step 3 identified in them; OUT gets model/ and
features/. Everything below was laid down before a diagnosis was run.

Model: the deck as a beam that bends sideways, condensed to the five places where its motion was measured (rotations free), on springs: the two
abutments alike at its ends, the column in the middle. The motion of the ground is the input, so the springs stand on what moves with it.
No drawing is public. What is assumed [sizes of a three-cell box girder of two 104 ft spans, 34 ft wide] only sets where the search starts,
and the bounds are as wide as that is uncertain; the mass scales every stiffness and has no part in the result:
  deck       0.5 to 1.5  of 28 GPa x 33 m4: sizes assumed, concrete's modulus and cracks on top
  abutments  0.1 to 10   of 100 MN/m each: soil, known by its order of magnitude
  column     0.2 to 5    of a cracked cantilever of 5 ft, 20 ft high: how far the deck holds its top (3 EI/h^3 to 12 EI/h^3) and cracks

Rows: one mode an earthquake, of those that step 3 found between 2.0 and 3.6 Hz, known to 0.35 Hz or better (the second is the limit of the
test of this study too) and like the first mode of the model as it is drawn (MAC of 0.8): the one whose frequency is known best. Its frequency,
and its shape at the five places, with the deviations of step 3. Damping is left out: twenty seconds tell it to half its value.

Amplitude: RMS displacement of the middle of the deck against the mean of both embankments (the two that every earthquake has), within
step 3's band, over the strong part of the record (5 to 95 % of the squared acceleration of that channel).

Held out: the earthquake of the largest amplitude, which is the diagnosis's own rule for three and more amplitudes. What is said of it is then
said beyond anything that was fitted.
"""
import csv
import pathlib
import sys
import tomllib

import numpy as np
from scipy.linalg import eigh

SPAN = 104 * 0.3048
PLACES = {"c03": -0.96 * SPAN, "c05": -0.5 * SPAN, "c07": 0.0, "c09": 0.5 * SPAN, "c13": 0.96 * SPAN}
BENDING = 28e9 * 33.0  # N m^2, sideways
MASS_PER_M = 4.0 * 2500.0
ABUTMENT = 1e8
COLUMN = 3.0 * 25e9 * np.pi * 1.524**4 / 64.0 / 6.1**3
BAND_HZ = (1.2, 4.8)
MODE_HZ, KNOWN_HZ, LEAST_MAC = (2.0, 3.6), 0.35, 0.8
MIDDLE, GROUND = "c07", ("c11", "c26")
PARAMETERS = {"deck": (0.5, 1.5), "abutments": (0.1, 10.0), "column": (0.2, 5.0)}


def fail(message):
    sys.exit(f"meloland_overpass: {message}")


def deck_stiffness(x):
    """Beam of equal bending stiffness over the points x, sideways displacements, rotations condensed."""
    n = len(x)
    k = np.zeros((2 * n, 2 * n))
    for i in range(n - 1):
        l = x[i + 1] - x[i]
        e = BENDING / l**3 * np.array(
            [[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l], [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]]
        )
        at = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3]
        k[np.ix_(at, at)] += e
    moves, turns = np.arange(0, 2 * n, 2), np.arange(1, 2 * n, 2)
    return k[np.ix_(moves, moves)] - k[np.ix_(moves, turns)] @ np.linalg.solve(k[np.ix_(turns, turns)], k[np.ix_(turns, moves)])


def write_matrix(path, matrix):
    entries = [(i, j, matrix[i, j]) for i in range(len(matrix)) for j in range(i + 1) if matrix[i, j] != 0.0]
    path.write_text(
        f"%%MatrixMarket matrix coordinate real symmetric\n{len(matrix)} {len(matrix)} {len(entries)}\n"
        + "".join(f"{i + 1} {j + 1} {value:.17g}\n" for i, j, value in entries)
    )


def matrices():
    """Stiffness by part, and mass, of the bridge as drawn."""
    x = np.array(list(PLACES.values()))
    ends = np.concatenate(([-SPAN], 0.5 * (x[1:] + x[:-1]), [SPAN]))
    parts = {
        "deck": deck_stiffness(x),
        "abutments": np.diag([ABUTMENT, 0.0, 0.0, 0.0, ABUTMENT]),
        "column": np.diag([0.0, 0.0, COLUMN, 0.0, 0.0]),
    }
    return parts, np.diag(MASS_PER_M * np.diff(ends))


def write_model(folder):
    folder.mkdir(parents=True, exist_ok=True)
    parts, mass = matrices()
    write_matrix(folder / "K0.mtx", np.zeros((5, 5)))
    write_matrix(folder / "M0.mtx", mass)
    text = 'title = "Meloland Road Overpass, transverse"\n[matrices]\nK = "K0.mtx"\nM = "M0.mtx"\n'
    for name, (lower, upper) in PARAMETERS.items():
        write_matrix(folder / f"K_{name}.mtx", parts[name])
        text += (
            f'\n[[parameter]]\nname = "{name}"\nmatrix = "K_{name}.mtx"\ntarget = "stiffness"\ninitial = 1.0\n'
            f"lower = {lower}\nupper = {upper}\n"
        )
    (folder / "model.toml").write_text(text)
    (folder / "dofs.csv").write_text(
        "dof,node,direction,x_m,y_m,z_m\n" + "".join(f"{i + 1},P{c[1:]},y,{v:.6g},0,0\n" for i, (c, v) in enumerate(PLACES.items()))
    )


def amplitude(record, names, rate):
    """RMS displacement [m] of the middle of the deck against the embankments, in the band, over the strong part."""
    middle = record[:, names.index(MIDDLE)]
    relative = middle - np.mean([record[:, names.index(c)] for c in GROUND], axis=0)
    frequency = np.fft.rfftfreq(2 * len(relative), 1.0 / rate)  # padded with as much again: no wrapping round
    spectrum = np.fft.rfft(relative, 2 * len(relative))
    inside = (frequency >= BAND_HZ[0]) & (frequency <= BAND_HZ[1])
    spectrum[~inside] = 0.0
    spectrum[inside] /= -((2.0 * np.pi * frequency[inside]) ** 2)
    moved = np.fft.irfft(spectrum)[: len(relative)]
    grown = np.cumsum((middle - middle.mean()) ** 2)
    first, last = np.searchsorted(grown, (0.05 * grown[-1], 0.95 * grown[-1]))
    return float(np.sqrt(np.mean(moved[first:last] ** 2)))


def likeness(a, b):
    return (a @ b) ** 2 / (a @ a) / (b @ b)


def read_modes(file):
    """condition -> mode -> its rows"""
    modes = {}
    with open(file, newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            if row["type"] in ("frequency_Hz", "shape"):
                modes.setdefault(row["condition"], {}).setdefault(row["mode"], []).append(row)
    return modes


def transverse(modes):
    """The rows of the transverse mode among an earthquake's modes, or none."""
    parts, mass = matrices()
    first = eigh(sum(parts.values()), mass)[1][:, 0]
    known = []
    for rows in modes.values():
        frequency = next(r for r in rows if r["type"] == "frequency_Hz")
        shape = {r["channel"]: float(r["value"]) for r in rows if r["type"] == "shape"}
        if not MODE_HZ[0] <= float(frequency["value"]) <= MODE_HZ[1] or float(frequency["std"]) > KNOWN_HZ:
            continue
        if any(c not in shape for c in PLACES) or likeness(np.array([shape[c] for c in PLACES]), first) < LEAST_MAC:
            continue
        known.append((float(frequency["std"]) / float(frequency["value"]), rows))
    return min(known, key=lambda k: k[0])[1] if known else []


def main(campaign, features, out):
    write_model(out / "model")
    with open(campaign / "campaign.toml", "rb") as stream:
        records = tomllib.load(stream)["record"]
    found = read_modes(features / "rows.csv")
    (out / "features").mkdir(parents=True, exist_ok=True)
    rows, conditions = ["type,mode,channel,condition,value,std"], ""
    for record in records:
        event = record["condition"]
        mode = transverse(found.get(event, {}))
        if not mode:
            print(f"meloland_overpass: no transverse mode was found in {event}", file=sys.stderr)
            continue
        size = amplitude(np.load(campaign / record["file"]), record["channels"], record["sampling_rate_Hz"])
        conditions += f'[{event}]\namplitude_m = {size:.6g}\namplitude_channel = "{MIDDLE}"\n'
        rows += [f"{r['type']},1,{r['channel']},{event},{r['value']},{r['std']}" for r in mode if r["channel"] in ("", *PLACES)]
    if len(rows) == 1:
        fail(f"{features / 'rows.csv'} holds no transverse mode")
    (out / "features" / "conditions.toml").write_text(conditions)
    (out / "features" / "channels.csv").write_text(
        "channel,point,x_m,y_m,z_m,dx,dy,dz\n" + "".join(f"{c},P{c[1:]},{x:.6g},0,0,0,1,0\n" for c, x in PLACES.items())
    )
    (out / "features" / "rows.csv").write_text("\n".join(rows) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        fail("usage: make_model.py CAMPAIGN S3_FEATURES OUT")
    main(*(pathlib.Path(a) for a in sys.argv[1:4]))
