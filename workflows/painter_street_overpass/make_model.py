"""Writes a matrix model of the overpass's transverse motion, and one mode of each part of a record as features of it.

    make_model.py CAMPAIGN S3_FEATURES OUT

CAMPAIGN is what campaign.py wrote (records of the ground and the deck), S3_FEATURES what step 3 identified in them; OUT gets model/ and
features/. Everything below was laid down before a diagnosis was run, but for the bounds of the bent.

Model: the deck as a beam that bends sideways (rotations condensed), on springs: the two abutments alike at its ends, the bent of two columns under it. The motion
of the ground is the input, so the springs stand on what moves with it. The skew of 39 degrees is not in it. Deck and columns are as the authors' model
has them (fe_model_Painter.json, in inches and pounds): 28.1 GPa, 31.2 m^4 sideways, 9700 kg/m, columns of 0.265 m^4. Its
abutments do not give way across, which cannot be: springs take their place. Bounds:
  deck       0.7 to 1.3  concrete's modulus and cracks
  abutments  0.1 to 10   of 100 MN/m each, as for the Meloland overpass: soil, known by its order of magnitude
  bent       0.2 to 8    of two cracked columns (half of their stiffness), 3 EI/h^3 each, h their clear height of 7.32 m: how far the deck holds their
                         heads (up to 12 EI/h^3), how far they are cracked (up to all of EI)
The last line stood at "up to 4, h up to the deck's axis" at first, which leaves out columns that are not cracked; the weak earthquakes then ended on that bound and
were 13 % off.

Rows: one mode a part, of those that step 3 found between 2.0 and 5.0 Hz, known to 0.35 Hz or better and like the first mode of the model as it is drawn
(MAC of 0.8): the one whose frequency is known best. Its frequency, and its shape at the three places, with the deviations of step 3.
Damping is left out.

Amplitude: RMS displacement of the middle of the deck against the mean of the ground at both abutments, within step 3's band, over the
samples from 5 to 95 % of the squared acceleration of that channel.
"""
import csv
import pathlib
import sys
import tomllib

import numpy as np
from scipy.linalg import eigh

INCH, POUND_FORCE = 0.0254, 4.4482216
LENGTH, BENT, CLEAR = 3180 * INCH, 1752 * INCH, (324.453 - 36.4528) * INCH
PLACES = {"c04": 1.0, "c07": BENT, "c09": LENGTH - 1.0}
BENDING = 4.074e6 * POUND_FORCE / INCH**2 * 7.498e7 * INCH**4  # N m^2, sideways
MASS_PER_M = 1.40742 * POUND_FORCE / INCH**2
ABUTMENT = 1e8
COLUMN = 2.0 * 3.0 * 0.5 * 4.074e6 * POUND_FORCE / INCH**2 * 636200 * INCH**4 / CLEAR**3
PARAMETERS = {"deck": (0.7, 1.3), "abutments": (0.1, 10.0), "bent": (0.2, 8.0)}
BAND_HZ = (1.5, 6.0)
MODE_HZ, KNOWN_HZ, LEAST_MAC = (2.0, 5.0), 0.35, 0.8
MIDDLE, GROUND = "c07", ("c20", "c17")


def fail(message):
    sys.exit(f"painter_street_overpass: {message}")


def points():
    """Places of the masses [m]: the sensors, and the deck between them cut into tenths of its length."""
    between = [x for x in np.arange(0.1, 0.95, 0.1) * LENGTH if min(abs(x - p) for p in PLACES.values()) > 0.03 * LENGTH]
    return np.array(sorted([*PLACES.values(), *between]))


def deck_stiffness(x):
    """Beam of equal bending stiffness over the points x, sideways displacements, rotations condensed."""
    n = len(x)
    k = np.zeros((2 * n, 2 * n))
    for i, l in enumerate(np.diff(x)):
        at = slice(2 * i, 2 * i + 4)
        k[at, at] += BENDING / l**3 * np.array(
            [[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l], [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]]
        )
    moves, turns = np.arange(0, 2 * n, 2), np.arange(1, 2 * n, 2)
    return k[np.ix_(moves, moves)] - k[np.ix_(moves, turns)] @ np.linalg.solve(k[np.ix_(turns, turns)], k[np.ix_(turns, moves)])


def write_matrix(path, matrix):
    entries = [(i, j, matrix[i, j]) for i in range(len(matrix)) for j in range(i + 1) if matrix[i, j] != 0.0]
    path.write_text(
        f"%%MatrixMarket matrix coordinate real symmetric\n{len(matrix)} {len(matrix)} {len(entries)}\n"
        + "".join(f"{i + 1} {j + 1} {value:.17g}\n" for i, j, value in entries)
    )


def matrices():
    """Places, stiffness by part, and mass, of the bridge as drawn."""
    x = points()
    ends = np.concatenate(([0.0], 0.5 * (x[1:] + x[:-1]), [LENGTH]))
    at_ends, at_bent = np.zeros(len(x)), np.zeros(len(x))
    at_ends[[0, -1]], at_bent[np.argmin(abs(x - BENT))] = ABUTMENT, COLUMN
    return x, {"deck": deck_stiffness(x), "abutments": np.diag(at_ends), "bent": np.diag(at_bent)}, np.diag(MASS_PER_M * np.diff(ends))


def names_of(x):
    """Node of each place: the sensor's point where there is one."""
    at = {round(place, 6): f"P{channel[1:]}" for channel, place in PLACES.items()}
    return [at.get(round(value, 6), f"D{value:.0f}") for value in x]


def write_model(folder):
    folder.mkdir(parents=True, exist_ok=True)
    x, parts, mass = matrices()
    write_matrix(folder / "K0.mtx", np.zeros(mass.shape))
    write_matrix(folder / "M0.mtx", mass)
    text = 'title = "Painter Street Overpass, transverse"\n[matrices]\nK = "K0.mtx"\nM = "M0.mtx"\n'
    for name, (lower, upper) in PARAMETERS.items():
        write_matrix(folder / f"K_{name}.mtx", parts[name])
        text += (
            f'\n[[parameter]]\nname = "{name}"\nmatrix = "K_{name}.mtx"\ntarget = "stiffness"\ninitial = 1.0\n'
            f"lower = {lower}\nupper = {upper}\n"
        )
    (folder / "model.toml").write_text(text)
    (folder / "dofs.csv").write_text(
        "dof,node,direction,x_m,y_m,z_m\n" + "".join(f"{i},{name},y,{v:.6g},0,0\n" for i, (name, v) in enumerate(zip(names_of(x), x), 1))
    )


def amplitude(record, names, rate):
    """RMS displacement [m] of the middle of the deck against the ground, in the band, over the strong part."""
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
    """The rows of the transverse mode among the modes of a part, or none."""
    x, parts, mass = matrices()
    first = eigh(sum(parts.values()), mass)[1][[int(np.argmin(abs(x - p))) for p in PLACES.values()], 0]
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
        part = record["condition"]
        mode = transverse(found.get(part, {}))
        if not mode:
            print(f"painter_street_overpass: no transverse mode was found in {part}", file=sys.stderr)
            continue
        size = amplitude(np.load(campaign / record["file"]), record["channels"], record["sampling_rate_Hz"])
        conditions += f'[{part}]\namplitude_m = {size:.6g}\namplitude_channel = "{MIDDLE}"\n'
        rows += [f"{r['type']},1,{r['channel']},{part},{r['value']},{r['std']}" for r in mode if r["channel"] in ("", *PLACES)]
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
