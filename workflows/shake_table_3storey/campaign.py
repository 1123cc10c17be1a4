"""Writes a campaign folder (channels.csv, campaign.toml, conditions.toml) for a three-storey frame on a small shake table, in two states.

    campaign.py DATA OUT

DATA holds STATE_northridge_floorK.npy (t_s, Acc_X, Acc_Y, Acc_Z in m/s^2, gravity in Z) for the states flexible and stiff and the floors 0 (the
table) to 3. Motion along X, the way the table moves: floor 0 goes in, floors 1 to 3 come out.

One record a state: the earthquake of Northridge, 100 s. It is the one record of a day that shakes all frequencies; the three sines of each
state shake at a frequency and its harmonics. bonus_event is left out: of another day, with other sensors on the floors (names of devices in
its index; its first mode moves floor 1 more than floor 2).

Clocks. Each floor has a sensor of its own, which starts with the others and runs by itself. Far below the first mode all floors move with the table, so
that their phase against it, between 0.3 and 2.2 Hz, is delay: up to 2.5 ms in these records. Each floor is shifted by its own, as a whole.
"""
import pathlib
import sys

import numpy as np
from scipy.signal import csd

STATES, EVENT, FLOORS = ("flexible", "stiff"), "northridge", 4
RATE_HZ = 120.0
TOGETHER_HZ = (0.3, 2.2)  # lowest mode at 3.7 Hz
SEGMENT = 1024            # samples: lines of 0.12 Hz


def fail(message):
    sys.exit(f"shake_table_3storey: {message}")


def delay(table, floor):
    """By how many seconds the floor is late, from the slope of its phase against the table."""
    hertz, cross = csd(table, floor, RATE_HZ, nperseg=SEGMENT)
    within = (hertz > TOGETHER_HZ[0]) & (hertz < TOGETHER_HZ[1])
    hertz, weight, phase = hertz[within], np.abs(cross[within]), np.angle(cross[within])
    return -np.sum(weight * hertz * phase) / np.sum(weight * hertz**2) / (2.0 * np.pi)


def shifted(samples, seconds):
    """The samples earlier by some seconds; padded by as much again, so that the end does not come round to the start."""
    lines = np.fft.rfft(samples, 2 * len(samples))
    hertz = np.fft.rfftfreq(2 * len(samples), 1.0 / RATE_HZ)
    return np.fft.irfft(lines * np.exp(2j * np.pi * hertz * seconds), 2 * len(samples))[: len(samples)]


def motion(data, state):
    """(samples x floors) acceleration along the table, clocks put right."""
    columns = []
    for floor in range(FLOORS):
        file = data / f"{state}_{EVENT}_floor{floor}.npy"
        if not file.is_file():
            fail(f"{file} is not there; DATA is the folder with {state}_{EVENT}_floor0.npy to floor{FLOORS - 1}.npy")
        columns.append(np.load(file)[:, 1].astype(float))
    length = min(map(len, columns))
    columns = [column[:length] - column[:length].mean() for column in columns]
    late = [0.0] + [delay(columns[0], column) for column in columns[1:]]
    print(f"{state}: floors are late by", ", ".join(f"{1e3 * seconds:.2f}" for seconds in late[1:]), "ms")
    return np.array([shifted(column, seconds) for column, seconds in zip(columns, late)]).T


def main(data, out):
    out.mkdir(parents=True, exist_ok=True)
    (out / "channels.csv").write_text(
        "channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role\n"
        + "".join(f"a{k},floor{k},0,0,{k},1,0,0,acceleration,m/s^2,1,0,{'response' if k else 'input'}\n" for k in range(FLOORS))
    )
    (out / "lines.csv").write_text("point,other_point\n" + "".join(f"floor{k},floor{k + 1}\n" for k in range(1, FLOORS - 1)))
    records, conditions = "", ""
    names = ", ".join(f'"a{k}"' for k in range(FLOORS))
    for state in STATES:
        (out / state).mkdir(exist_ok=True)
        np.save(out / state / "record.npy", motion(data, state))
        records += (
            f'[[record]]\nsetup = "floors"\nkind = "earthquake"\nfile = "{state}/record.npy"\nsampling_rate_Hz = {RATE_HZ:.6g}\n'
            f'channels = [{names}]\ncondition = "{state}"\n\n'
        )
        conditions += f'[{state}]\nstate = "{state}"\n\n'
    (out / "campaign.toml").write_text(records)
    (out / "conditions.toml").write_text(conditions)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        fail("usage: campaign.py DATA OUT")
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
