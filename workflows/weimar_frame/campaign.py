"""Writes a campaign folder (channels.csv, campaign.toml, conditions.toml) for the measured steel frame of Weimar.

    campaign.py DATA OUT

DATA holds, for each setup NN, setup_NN.npy (samples x 6 at 256 Hz) and setup_NN_channel_dofs.txt (channel, node, azimuth, elevation,
name), and grid.txt (node, x, y, z in cm). Columns 0-2 are velocities along three oblique laser beams at the roving node, 3-5
accelerations at a node that stays. The records are read where they lie.
"""
import csv
import math
import pathlib
import sys

RATE_HZ = 256
HEADER = ["channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role"]


def fail(message):
    sys.exit(f"weimar_frame: {message}")


def read_grid(file):
    points = {}
    for line in file.read_text().splitlines()[1:]:
        cells = line.split()
        if len(cells) == 4:
            points[cells[0]] = [float(cell) / 100 for cell in cells[1:]]
    return points


def read_dofs(file):
    with open(file, newline="", encoding="latin-1") as f:
        rows = [row for row in csv.reader(f, delimiter="\t") if len(row) >= 5]
    if not rows or not rows[0][0].startswith("Channel"):
        fail(f"{file}: expected a header 'Channel-Nr. Node Azimuth Elevation Channel Name'")
    return [(row[1].strip(), math.radians(float(row[2])), math.radians(float(row[3])), row[4].strip()) for row in rows[1:]]


def main(data, out):
    if not (data / "grid.txt").is_file():
        fail(f"{data}/grid.txt is not there; DATA is the folder with setup_NN.npy, setup_NN_channel_dofs.txt and grid.txt")
    points = read_grid(data / "grid.txt")
    channels, records = {}, []
    for file in sorted(data.glob("setup_*.npy")):
        setup = file.stem
        names = []
        for column, (node, azimuth, elevation, label) in enumerate(read_dofs(data / f"{setup}_channel_dofs.txt")):
            stays = column >= 3
            name = label if stays else f"{setup.removeprefix('setup_')}_{label}"
            cosines = [math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)]
            row = [name, node, *(f"{c:.12g}" for c in points[node] + cosines), "acceleration" if stays else "velocity",
                   "m/s^2" if stays else "m/s", 1, int(stays), "response"]
            if channels.setdefault(name, row) != row:
                fail(f"{setup}: channel {name} stands elsewhere than in an earlier setup")
            names.append(name)
        records.append((setup, file.resolve(), names))
    if not records:
        fail(f"{data} holds no setup_NN.npy")
    out.mkdir(parents=True, exist_ok=True)
    with open(out / "channels.csv", "w", newline="") as f:
        writer = csv.writer(f, lineterminator="\n")
        writer.writerow(HEADER)
        writer.writerows(channels.values())
    (out / "conditions.toml").write_text("[fans]\n")
    if (data / "lines.txt").is_file():  # which points the authors join when they draw the frame
        pairs = [line.split() for line in (data / "lines.txt").read_text().splitlines()[1:] if len(line.split()) == 2]
        with open(out / "lines.csv", "w", newline="") as f:
            csv.writer(f, lineterminator="\n").writerows([["point", "other_point"], *pairs])
    text = "".join(f'[[record]]\nsetup = "{setup}"\nkind = "ambient"\nfile = "{file}"\nsampling_rate_Hz = {RATE_HZ}\n'
                   f"channels = [{', '.join(chr(34) + n + chr(34) for n in names)}]\ncondition = \"fans\"\n\n" for setup, file, names in records)
    (out / "campaign.toml").write_text(text)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        fail("usage: campaign.py DATA OUT")
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
