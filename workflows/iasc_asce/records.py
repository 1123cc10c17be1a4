"""Records of the frame as a logger would give them: a campaign folder of one record a state.

    records.py OUT --case 1 --patterns 0 3 --seed 1

Loads: white noise, independent from load to load, drawn at the logger's rate, held and smoothed by a low-pass filter of sixth order (Butterworth, 100 Hz).
Response: each mode by its exact recursion for a load that is linear between samples (first-order hold), with 1 % damping, after 10 s in which
the start dies out. Accelerations of 16 sensors at 1,000 Hz for 40 s, with white noise of 10 % of the RMS of the strongest channel of the roof.
Conditions are `before` and `after`, each a state of the structure of its own.
"""
import argparse
import pathlib

import numpy as np
from scipy.signal import butter, cont2discrete, lfilter

import frame

RATE_HZ, LENGTH_S, SETTLE_S = 1000.0, 40.0, 10.0
LOAD_HZ, LOAD_ORDER, LOAD_N = 100.0, 6, 1000.0  # linear structure: the size of the load scales everything, noise included
NOISE = 0.10
STATES = ("before", "after")


def load_shapes(case):
    """(12 x loads): the force on the floors' centres of a load of 1 N."""
    out = np.zeros((3 * frame.FLOORS, frame.FLOORS if frame.CASES[case].load == "floors" else 1))
    if frame.CASES[case].load == "floors":
        for floor in range(frame.FLOORS):
            out[3 * floor + 1, floor] = 1.0
    else:
        out[-3, 0] = out[-2, 0] = 0.5**0.5
    return out


def accelerations(case, pattern, random):
    """(samples x 16) [m/s^2], noise included."""
    found = frame.modes(case, frame.PATTERNS[pattern])
    shapes = load_shapes(case)
    samples = int(RATE_HZ * (LENGTH_S + SETTLE_S))
    numerator, denominator = butter(LOAD_ORDER, LOAD_HZ, fs=RATE_HZ)
    forces = LOAD_N * lfilter(numerator, denominator, random.standard_normal((samples, shapes.shape[1])), axis=0)
    motion = np.zeros((samples, 16))
    for hertz, shape, at in zip(found.frequencies_Hz, found.floors.T, frame.at_sensors(found.floors).T):
        omega = 2.0 * np.pi * hertz
        law = ([1.0, 0.0, 0.0], [1.0, 2.0 * frame.DAMPING * omega, omega**2])  # acceleration over force of a mode of unit mass
        top, bottom, _ = cont2discrete(law, 1.0 / RATE_HZ, method="foh")
        motion += np.outer(lfilter(top.ravel(), bottom, forces @ (shapes.T @ shape)), at)
    motion = motion[int(RATE_HZ * SETTLE_S) :]
    strongest = np.sqrt(np.mean(motion[:, -4:] ** 2, axis=0)).max()
    return motion + NOISE * strongest * random.standard_normal(motion.shape)


def write_campaign(out, case, patterns, seed, draw=0):
    """@param patterns  damage pattern of each state. The same seed, draw, case and patterns give the same records."""
    out.mkdir(parents=True, exist_ok=True)
    places = {number: frame.position(number) for _, _, number, _ in frame.sensors()}
    names = [name for name, *_ in frame.sensors()]
    (out / "channels.csv").write_text(
        "channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role\n"
        + "".join(
            "{},n{},{:g},{:g},{:g},{},acceleration,m/s^2,1,0,response\n".format(name, number, *places[number], "0,1,0" if along else "1,0,0")
            for name, _, number, along in frame.sensors()
        )
    )
    listed = ", ".join(f'"{name}"' for name in names)
    records = conditions = ""
    for place, (state, pattern) in enumerate(zip(STATES, patterns)):
        random = np.random.default_rng([seed, draw, case, *patterns, place])
        np.save(out / f"{state}.npy", accelerations(case, pattern, random))
        records += (
            f'[[record]]\nsetup = "frame"\nkind = "ambient"\nfile = "{state}.npy"\nsampling_rate_Hz = {RATE_HZ:g}\n'
            f'channels = [{listed}]\ncondition = "{state}"\n\n'
        )
        conditions += f'[{state}]\nstate = "{state}"\n\n'
    (out / "campaign.toml").write_text(records)
    (out / "conditions.toml").write_text(conditions)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--case", type=int, choices=sorted(frame.CASES), default=1)
    parser.add_argument("--patterns", type=int, nargs=2, choices=sorted(frame.PATTERNS), default=(0, 1), metavar=STATES)
    parser.add_argument("--seed", type=int, default=1)
    told = parser.parse_args()
    write_campaign(told.out, told.case, told.patterns, told.seed)


if __name__ == "__main__":
    main()
