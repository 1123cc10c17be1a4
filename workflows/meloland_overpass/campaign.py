"""Writes a campaign folder (channels.csv, campaign.toml, conditions.toml) for the earthquakes that the Meloland Road Overpass recorded.

    campaign.py DATA OUT

DATA holds an array EVENT.npy (samples x channels, cm/s^2) for each earthquake and channels.csv (event, column, station_channel, dt_s, …).
Transverse motion: at the footing of the column and on both embankments it goes in, on the deck it comes out. The records are copied,
these channels alone, all at 50 Hz.
"""
import csv
import pathlib
import sys

import numpy as np
from scipy.signal import decimate

# The station's channels across the bridge: where they stand along it [m from its middle; two spans of 104 ft], and what they are.
SPAN = 104 * 0.3048
INPUTS = {2: 0.0, 11: -1.1 * SPAN, 26: 1.1 * SPAN}
OUTPUTS = {3: -0.96 * SPAN, 5: -0.5 * SPAN, 7: 0.0, 9: 0.5 * SPAN, 13: 0.96 * SPAN}
DECK_HEIGHT = 17 * 0.3048
RATE_HZ = 50.0
# Weakest first. The names say when; the last three digits the largest acceleration of the deck [cm/s^2].
EVENTS = [
    ("calexico_20nov2008", "nov2008_017"),
    ("borregosprings_10jun2016", "jun2016_030"),
    ("calexicoaftershock_30dec2009", "aftershock2009_038"),
    ("borregosprings_07jul2010", "jul2010_053"),
    ("superstitionhills87", "nov1987_237"),
    ("imperialvalley79", "oct1979_484"),
    ("calexico_30dec2009", "dec2009_498"),
]


def fail(message):
    sys.exit(f"meloland_overpass: {message}")


def write_record(out, condition, samples, rate, channels):
    """Writes <condition>/record.npy. Returns its table for campaign.toml."""
    (out / condition).mkdir(exist_ok=True)
    np.save(out / condition / "record.npy", samples)
    names = ", ".join(f'"{channel}"' for channel in channels)
    return (
        f'[[record]]\nsetup = "transverse"\nkind = "earthquake"\nfile = "{condition}/record.npy"\n'
        f'sampling_rate_Hz = {rate:.6g}\nchannels = [{names}]\ncondition = "{condition}"\n\n'
    )


def main(data, out):
    table = data / "channels.csv"
    if not table.is_file():
        fail(f"{table} is not there; DATA is the folder with channels.csv and an array .npy for each earthquake")
    with open(table, newline="", encoding="utf-8") as f:
        rows = list(csv.DictReader(f))
    out.mkdir(parents=True, exist_ok=True)
    with open(out / "channels.csv", "w", newline="") as f:
        writer = csv.writer(f, lineterminator="\n")
        writer.writerow(
            ["channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role"]
        )
        for places, role, height in ((INPUTS, "input", 0.0), (OUTPUTS, "response", DECK_HEIGHT)):
            for number, x in places.items():
                writer.writerow(
                    [
                        f"c{number:02d}",
                        f"P{number:02d}",
                        f"{x:.6g}",
                        0,
                        f"{height:.6g}",
                        0,
                        1,
                        0,
                        "acceleration",
                        "m/s^2",
                        1,
                        0,
                        role,
                    ]
                )
    (out / "lines.csv").write_text("point,other_point\nP03,P05\nP05,P07\nP07,P09\nP09,P13\n")
    records, conditions = "", ""
    for event, condition in EVENTS:
        here = {int(r["station_channel"]): r for r in rows if r["event"].startswith(event + "_")}
        wanted = [n for n in (*INPUTS, *OUTPUTS) if n in here]
        if not wanted:
            fail(f"{table} names no channel of {event}")
        file = data / f"{here[wanted[0]]['event']}.npy"
        samples = np.load(file)[:, [int(here[n]["column"]) for n in wanted]] * 0.01
        rate = 1 / float(here[wanted[0]]["dt_s"])
        if rate > RATE_HZ:  # the two oldest records are at 50 Hz, the others at 100 Hz
            samples, rate = decimate(samples, round(rate / RATE_HZ), ftype="fir", axis=0), RATE_HZ
        records += write_record(out, condition, samples.astype(np.float64), rate, [f"c{n:02d}" for n in wanted])
        conditions += f"[{condition}]\n"
    (out / "campaign.toml").write_text(records)
    (out / "conditions.toml").write_text(conditions)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        fail("usage: campaign.py DATA OUT")
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
