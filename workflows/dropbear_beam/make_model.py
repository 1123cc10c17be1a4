"""Writes a beam model with a roller, and two frequencies of each place of the roller as features of it.

    make_model.py CAMPAIGN S3 OUT

CAMPAIGN is what campaign.py wrote, S3 the folder of step 3; OUT gets model/ and features/<place>/ for the five places. Each holds two states, the
reference and that place. Nothing of where the roller truly stood goes in.

Model: what is published of the beam: steel, 51 x 6.66 x 501 mm, clamped at one end. Assumed: 206 GPa (200 to 212 GPa, structural steels), 7850 kg/m^3, a
clamp and a roller that do not give way (100 MN/m: 20 times what the beam opposes there), no sensor's mass. Where the roller stands at the start is not
published: it is put where the model's first frequency is the reference's first frequency. So a place in metres means: by the first mode
of this beam.

Rows: two frequencies a state. In the spectrum of each test the highest line from 20 to 60 Hz and from 120 to 350 Hz says which modes the
window shows; ERA's mode nearest to it (within 2 %, one of at least two tests) gives the frequency. Mean of the tests; their
standard deviation, and no less than 0.1 % (the catalogue's own floor). With one accelerometer there is no shape, so that modes are paired by order.
"""
import csv
import pathlib
import sys
import tomllib

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

LENGTH, WIDTH, THICKNESS = 0.501, 0.051, 0.00666
YOUNG, YOUNG_BOUNDS, DENSITY = 206e9, (200e9, 212e9), 7850.0
ROLLER_N_M = 1e8
BEFORE, BEYOND = 3, 20  # elements between clamp and roller, between roller and free end: some 20 mm each
BANDS_HZ = ((20.0, 60.0), (120.0, 350.0))
NEAR, LEAST = 0.02, 0.001
REFERENCE = "reference"


def fail(message):
    sys.exit(f"dropbear_beam: {message}")


def frequencies(nodes, roller, young=YOUNG, roller_N_m=ROLLER_N_M, count=3):
    """The lowest frequencies [Hz] of the clamped beam. @param nodes  x of the nodes [m]; @param roller  the node on it"""
    size = 2 * len(nodes)
    stiffness, mass = np.zeros((size, size)), np.zeros((size, size))
    bending, per_m = young * WIDTH * THICKNESS**3 / 12.0, DENSITY * WIDTH * THICKNESS
    for i, l in enumerate(np.diff(nodes)):
        at = slice(2 * i, 2 * i + 4)
        stiffness[at, at] += bending / l**3 * np.array(
            [[12, 6 * l, -12, 6 * l], [6 * l, 4 * l * l, -6 * l, 2 * l * l], [-12, -6 * l, 12, -6 * l], [6 * l, 2 * l * l, -6 * l, 4 * l * l]]
        )
        mass[at, at] += per_m * l / 420.0 * np.array(
            [[156, 22 * l, 54, -13 * l], [22 * l, 4 * l * l, 13 * l, -3 * l * l], [54, 13 * l, 156, -22 * l], [-13 * l, -3 * l * l, -22 * l, 4 * l * l]]
        )
    stiffness[2 * roller, 2 * roller] += roller_N_m
    return np.sqrt(eigh(stiffness[2:, 2:], mass[2:, 2:], eigvals_only=True)[:count]) / (2.0 * np.pi)


def nodes_about(roller_m):
    return np.concatenate((np.linspace(0.0, roller_m, BEFORE + 1), np.linspace(roller_m, LENGTH, BEYOND + 1)[1:]))


def place_of(first_Hz):
    """Where the roller stands [m] if the beam's first frequency is this."""
    return brentq(lambda x: frequencies(nodes_about(x), BEFORE)[0] - first_Hz, 0.01, 0.3)


def write_model(folder, roller_m):
    folder.mkdir(parents=True, exist_ok=True)
    nodes = nodes_about(roller_m)
    (folder / "model.toml").write_text(
        'title = "Clamped steel beam on a roller"\n\n[[parameter]]\nname = "E_steel"\ntarget = "youngs_modulus"\nof = ["steel"]\nunit = "Pa"\n'
        f"initial = {YOUNG:.6g}\nlower = {YOUNG_BOUNDS[0]:.6g}\nupper = {YOUNG_BOUNDS[1]:.6g}\n"
    )
    (folder / "nodes.csv").write_text("node,x_m,y_m,z_m\n" + "".join(f"{i},{x:.12g},0,0\n" for i, x in enumerate(nodes, 1)))
    (folder / "elements.csv").write_text(
        "element,type,group,material,section,node1,node2,orientation_x,orientation_y,orientation_z\n"
        + "".join(f"{i},beam,beam,steel,bar,{i},{i + 1},0,0,1\n" for i in range(1, len(nodes)))
    )
    (folder / "materials.csv").write_text(f"material,youngs_modulus_Pa,poisson_ratio,density_kg_m3\nsteel,{YOUNG:.6g},0.3,{DENSITY:.6g}\n")
    area, flat, upright = WIDTH * THICKNESS, WIDTH * THICKNESS**3 / 12.0, THICKNESS * WIDTH**3 / 12.0
    (folder / "sections.csv").write_text(
        f"section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4\nbar,{area:.12g},{flat:.12g},{upright:.12g},{4.0 * flat:.12g}\n"
    )
    (folder / "supports.csv").write_text(
        "support,node,x,y,z,rx,ry,rz\nclamp,1,1,1,1,1,1,1\n" + "".join(f"plane,{i},0,1,0,1,0,1\n" for i in range(2, len(nodes) + 1))
    )
    (folder / "springs.csv").write_text(
        "spring,group,node,direction_x,direction_y,direction_z,quantity,stiffness_N_m\n"
        f"roller,roller,{BEFORE + 1},0,0,1,translation,{ROLLER_N_M:.6g}\n"
    )
    (folder / "points.csv").write_text(f"point,node\ntip,{len(nodes)}\n")


def spectral_line(samples, rate, band):
    """The highest line [Hz] of a window's spectrum within a band."""
    length = 1 << 17
    size = np.abs(np.fft.rfft(samples * np.hanning(len(samples)), length))
    hertz = np.fft.rfftfreq(length, 1.0 / rate)
    within = (hertz >= band[0]) & (hertz <= band[1])
    return hertz[within][np.argmax(size[within])]


def measured(campaign, decays):
    """place -> [(frequency, its deviation), ...] of the modes that are found"""
    with open(campaign / "campaign.toml", "rb") as stream:
        records = tomllib.load(stream)["record"]
    with open(decays, newline="", encoding="utf-8") as stream:
        rows = [(r["condition"], r["setup"], float(r["frequency_Hz"])) for r in csv.DictReader(stream)]
    out = {}
    for record in records:
        samples = np.load(campaign / record["file"])[:, 0]
        found = out.setdefault(record["condition"], [[] for _ in BANDS_HZ])
        for mode, band in enumerate(BANDS_HZ):
            line = spectral_line(samples, record["sampling_rate_Hz"], band)
            near = [f for place, test, f in rows if (place, test) == (record["condition"], record["setup"]) and abs(f / line - 1.0) < NEAR]
            if near:
                found[mode].append(min(near, key=lambda f: abs(f - line)))
    return {
        place: [(np.mean(f), max(np.std(f, ddof=1), LEAST * np.mean(f))) if len(f) > 1 else None for f in modes] for place, modes in out.items()
    }


def main(campaign, identified, out):
    found = measured(campaign, identified / "decays.csv")
    if not found[REFERENCE][0]:
        fail(f"{identified / 'decays.csv'} has no first mode of the reference")
    write_model(out / "model", place_of(found[REFERENCE][0][0]))
    for place in found:
        if place == REFERENCE:
            continue
        folder = out / "features" / place
        folder.mkdir(parents=True, exist_ok=True)
        rows = [
            f"frequency_Hz,{mode},,{state},{told[0]:.12g},{told[1]:.6g}"
            for state in (REFERENCE, place)
            for mode, told in enumerate(found[state], 1)
            if told
        ]
        (folder / "rows.csv").write_text("type,mode,channel,condition,value,std\n" + "\n".join(rows) + "\n")
        (folder / "conditions.toml").write_text("".join(f'[{state}]\nstate = "{state}"\n\n' for state in (REFERENCE, place)))
        (folder / "channels.csv").write_text(f"channel,point,x_m,y_m,z_m,dx,dy,dz\nacc,tip,{LENGTH},0,0,0,0,1\n")


if __name__ == "__main__":
    if len(sys.argv) != 4:
        fail("usage: make_model.py CAMPAIGN S3 OUT")
    main(*(pathlib.Path(a) for a in sys.argv[1:4]))
