"""Writes a campaign folder (channels.csv, campaign.toml, conditions.toml) for the earthquakes that the Painter Street Overpass recorded.

    campaign.py DATA OUT

DATA holds an array EVENT.npy (samples x channels, cm/s^2) for each earthquake and channels.csv (event, column, station_channel, dt_s, ...).
Transverse motion: on the ground at the middle bent and near both abutments it goes in, on the deck it comes out.

The two strong records are cut into their strong part (5 to 95 % of the squared acceleration of the deck's middle, and the second before) and what
follows, each to be identified by itself, as the study of the Meloland Road Overpass ended up doing: one linear model of a whole record is a
mean over strong and weak motion. A part counts that holds 9 s and more (35 periods); the strong part of 2015 does not.
"""
import csv
import pathlib
import sys

import numpy as np
from scipy.signal import decimate

# Where the station's channels stand along the bridge [m from its west end], by the authors' model (265 ft, bent at 146 ft; which end is west is
# assumed); "near" an abutment: a metre from it on the deck, ten behind it on the ground.
LENGTH, BENT = 3180 * 0.0254, 1752 * 0.0254
INPUTS = {20: -10.0, 3: BENT, 17: LENGTH + 10.0}
OUTPUTS = {4: 1.0, 7: BENT, 9: LENGTH - 1.0}
DECK_HEIGHT = 324.453 * 0.0254
MIDDLE = 7
RATE_HZ = 50.0
LEAD_S, LEAST_S = 1.0, 9.0
# Weakest first. The names say when; the last digits the largest acceleration of the deck's middle across [cm/s^2].
EVENTS = [("nc73666231", "dec2021_026", False), ("ferndale_28jan2015", "jan2015_251", True), ("nc73821036", "dec2022_603", True)]


def fail(message):
    sys.exit(f"painter_street_overpass: {message}")


def parts_of(samples, middle, rate, name, is_strong):
    """Parts of a record by the name of their condition."""
    if not is_strong:
        return {name: samples}
    grown = np.cumsum((middle - middle.mean()) ** 2)
    first, last = np.searchsorted(grown, (0.05 * grown[-1], 0.95 * grown[-1]))
    parts = {f"{name}_strong": samples[max(0, first - round(LEAD_S * rate)) : last], f"{name}_after": samples[last:]}
    return {part: cut for part, cut in parts.items() if len(cut) >= LEAST_S * rate}


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
    (out / "channels.csv").write_text(
        "channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role\n"
        + "".join(
            f"c{number:02d},P{number:02d},{x:.6g},0,{height:.6g},0,1,0,acceleration,m/s^2,1,0,{role}\n"
            for places, role, height in ((INPUTS, "input", 0.0), (OUTPUTS, "response", DECK_HEIGHT))
            for number, x in places.items()
        )
    )
    (out / "lines.csv").write_text("point,other_point\nP04,P07\nP07,P09\n")
    records, conditions = "", ""
    for event, name, is_strong in EVENTS:
        here = {int(r["station_channel"]): r for r in rows if r["event"].startswith(event)}
        wanted = [n for n in (*INPUTS, *OUTPUTS) if n in here]
        if len(wanted) < len(INPUTS) + len(OUTPUTS):
            fail(f"{table} lacks channels of {event}")
        samples = np.load(data / f"{here[wanted[0]]['event']}.npy")[:, [int(here[n]["column"]) for n in wanted]] * 0.01
        rate = 1 / float(here[wanted[0]]["dt_s"])
        samples = decimate(samples.astype(float), round(rate / RATE_HZ), ftype="fir", axis=0)
        for part, cut in parts_of(samples, samples[:, wanted.index(MIDDLE)], RATE_HZ, name, is_strong).items():
            records += write_record(out, part, cut, RATE_HZ, [f"c{n:02d}" for n in wanted])
            conditions += f"[{part}]\n"
    (out / "campaign.toml").write_text(records)
    (out / "conditions.toml").write_text(conditions)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        fail("usage: campaign.py DATA OUT")
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
