"""Writes a campaign folder (channels.csv, campaign.toml, conditions.toml) of a clamped steel beam whose roller was moved in steps.

    campaign.py DATA OUT

DATA holds slow10_test1.npy to slow10_test3.npy (samples x [accelerometer in V, second accelerometer, position of the roller, time]), 5000 Hz. Of these the
first column alone is read. The roller's position is what a test of the diagnosis is held against; nothing here opens it.

Windows. Five steps out and five back shake the beam by themselves: in the accelerometer alone there are ten bursts, with their middles at 0.75 1.95 3.1 4.3
5.5 6.65 7.85 9.0 10.25 11.35 s of each test (RMS over 0.1 s of 0.3 V and more), and between them free decay. A window begins 0.35 s after a burst's
middle, when the RMS has fallen under a third of it, and ends 0.15 s before the next rise. The five first windows are the five places on
the way out. The last, after the last step back, is the reference: the beam as it stood before the first step, when it lay too still to be read (2 mV).
"""
import pathlib
import sys

import numpy as np

RATE_HZ = 5000.0
TESTS = (1, 2, 3)
WINDOWS_S = {
    "reference": (11.9, 14.0),
    "step1": (1.1, 1.75),
    "step2": (2.3, 2.95),
    "step3": (3.45, 4.1),
    "step4": (4.65, 5.3),
    "step5": (5.85, 6.45),
}


def fail(message):
    sys.exit(f"dropbear_beam: {message}")


def main(data, out):
    out.mkdir(parents=True, exist_ok=True)
    (out / "channels.csv").write_text(
        "channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role\nacc,tip,0.501,0,0,0,0,1,acceleration,V,1,1,response\n"
    )
    records, conditions = "", ""
    for place, (first, last) in WINDOWS_S.items():
        conditions += f'[{place}]\nstate = "{place}"\n\n'
        for test in TESTS:
            file = data / f"slow10_test{test}.npy"
            if not file.is_file():
                fail(f"{file} is not there; DATA is the folder with slow10_test1.npy to slow10_test{TESTS[-1]}.npy")
            samples = np.load(file)[int(first * RATE_HZ) : int(last * RATE_HZ), 0].astype(float)
            (out / place).mkdir(exist_ok=True)
            np.save(out / place / f"test{test}.npy", (samples - samples.mean())[:, None])
            records += (
                f'[[record]]\nsetup = "test{test}"\nkind = "free_decay"\nfile = "{place}/test{test}.npy"\n'
                f'sampling_rate_Hz = {RATE_HZ:.6g}\nchannels = ["acc"]\ncondition = "{place}"\n\n'
            )
    (out / "campaign.toml").write_text(records)
    (out / "conditions.toml").write_text(conditions)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        fail("usage: campaign.py DATA OUT")
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
