"""What s3_identification does with records whose clock contradicts campaign.toml, is broken, or is that of other rows.

Oracle: three random channels at 100 Hz with the clock written here; the words of each refusal (docs/my_records.md), exit code 2, nothing written. A
right record is read with the same samples whatever stands beside it, by the byte-equal psd.csv.
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import scipy.io

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
N = 6000
T = np.arange(N) / 100
DATA = np.zeros((N, 3))
for row, push in enumerate(np.random.default_rng(5).standard_normal((N, 2)) @ [[0.3, 0.7, 0.6], [0.6, 0.3, -0.7]]):  # a mode at 10 Hz
    DATA[row] = push + 1.6 * DATA[row - 1] - 0.98 * DATA[row - 2] if row > 1 else push
DATA = np.round(DATA, 4)
CHANNELS = "channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role\n" + "".join(
    f"P{c},P{c},{c},0,0,0,0,1,acceleration,m/s^2,1.0,1,response\n" for c in (1, 2, 3))


def table(stamps, header="time,P1,P2,P3", tails=None):
    rows = [",".join([stamp, *(f"{v:.4f}" for v in row)]) + (tails[i] if tails else "") for i, (stamp, row) in enumerate(zip(stamps, DATA))]
    return "\n".join([header, *rows]) + "\n"


class Clocks(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_step(self, content, rate=100.0, more="", file="record.csv"):
        campaign = self.folder / "campaign"
        (campaign / "records").mkdir(parents=True, exist_ok=True)
        path = campaign / "records" / file
        if isinstance(content, str):
            path.write_text(content)
        elif file.endswith(".mat"):
            scipy.io.savemat(path, {"data": content})
        else:
            np.save(path, content)
        (campaign / "campaign.toml").write_text(f'[[record]]\nsetup = "A"\nfile = "records/{file}"\nsampling_rate_Hz = {rate}\n'
                                                f'channels = ["P1", "P2", "P3"]\n{more}')
        (campaign / "channels.csv").write_text(CHANNELS)
        return subprocess.run([BIN / "s3_identification", "--campaign", campaign, "--out", self.folder / "out", "--threads", "1", "--accept-unconverged", "--set", "decimation=1",
                               "--set", "block_rows=12", "--set", "maximum_order=8"], capture_output=True, text=True, timeout=120)

    def refused(self, words, *args, **keys):
        done = self.run_step(*args, **keys)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(words, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_a_broken_clock_of_a_matrix_is_no_channel(self):
        back, nan, late = T.copy(), T.copy(), T + 0.015 * np.random.default_rng(1).random(N)
        back[3000:] -= 2
        nan[777] = np.nan
        rates = np.r_[T[:3000], 30 + np.arange(N - 3000) / 50]
        columns = 'columns = ["column 2", "column 3", "column 4"]\n'
        for name, stamps, words in (("step back", back, "the time runs backwards"), ("restart", T % 30, "the time runs backwards"),
                                    ("two rates", rates, "different rates"), ("lost stamp", nan, "runs at 100 Hz"), ("unsorted", late, "which runs like time")):
            for file in ("record.npy", "record.mat"):
                with self.subTest(name, file=file):
                    self.refused(words, np.column_stack([stamps, DATA]), rate=99.0, more=columns, file=file)

    def test_packets_under_any_name(self):
        late = np.repeat(np.arange(N // 25) * 250 + np.random.default_rng(2).integers(0, 40, N // 25), 25)
        for name in ("received_ms", "Clock", "unix_ms", "Temps (ms)", "Horodatage", "nanos"):
            with self.subTest(name):
                self.refused("write sampling_rate_Hz = 1", table([str(1700000000000 + ms) for ms in late], f"{name},P1,P2,P3"), rate=99.0)

    def test_late_stamps_out_of_order(self):
        late = [f"{t:.3f}" for t in T + 0.015 * np.random.default_rng(1).random(N)]
        self.refused("(time column 'time')", table(late), rate=99.0)
        saw = [f"{0.011 * i - 0.025 * (i // 25):.3f}" for i in range(N)]
        self.refused("it is set back at 239 places", table(saw), rate=99.0)

    def test_times_in_the_wrong_unit_give_no_gap_to_bridge(self):
        stamps = [f"{145900 + t if t < 30 else 150000 - 30 + t:.2f}" for t in T]
        self.refused("more is missing than the 6000 samples that are there", table(stamps, "UTC,P1,P2,P3"))

    def test_channels_of_a_universal_file_that_begin_apart(self):
        text = ""
        for c in range(3):
            text += "    -1\n    58\n" + f"P{c + 1}\nNONE\n01-Jan-26 10:00:00\nNONE\nNONE\n"
            text += f"{1:5d}{1:10d}{1:5d}{1:10d} {'NONE':<10}{c + 1:10d}{3:4d} {'NONE':<10}{0:10d}{0:4d}\n"
            text += f"{2:10d}{N:10d}{1:10d}{0.25 * (c == 2):13.5E}{0.01:13.5E}{0.0:13.5E}\n{17:10d}{0:5d}{0:5d}{0:5d} {'Time':<20} {'s':<20}\n"
            text += f"{12:10d}{0:5d}{0:5d}{0:5d} {'Acceleration':<20} {'m/s^2':<20}\n" + 2 * f"{0:10d}{0:5d}{0:5d}{0:5d} {'NONE':<20} {'NONE':<20}\n"
            text += "".join("".join(f"{v:13.5E}" for v in DATA[i:i + 6, c]) + "\n" for i in range(0, N, 6)) + "    -1\n"
        self.refused("P3 begins 25 samples after P1", text, file="record.uff")

    def test_a_slow_channel_in_a_faster_table_is_warned_of(self):
        words = "channel P1 holds each value for 4 samples, as one of 25 Hz in a faster table does: above 12.5 Hz"
        slow = np.repeat(DATA[::4], 4, axis=0)
        more = 'columns = ["column 1", "column 2", "column 3"]\n'
        self.assertIn(words, self.run_step(slow, more=more, file="record.npy").stderr)
        self.assertNotIn("holds each value", self.run_step(DATA, more=more, file="record.npy").stderr)

    def test_rows_of_another_clock_beside(self):
        self.assertIn(self.run_step(table([f"{t:.3f}" for t in T])).returncode, (0, 1))
        right = (self.folder / "out/psd.csv").read_bytes()
        tails = [",\n" + f"{t + 0.004:.3f},,,,12.5" if i % 100 == 37 else "," for i, t in enumerate(T)]
        done = self.run_step(table([f"{t:.3f}" for t in T], "time,P1,P2,P3,Temp", tails))
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertEqual((self.folder / "out/psd.csv").read_bytes(), right)
        self.assertIn("60 rows have no value of the channels asked for and are left out", "".join(json.loads((self.folder / "out/manifest.json").read_text())["notes"]))
        apart = "time,P1,P2,P3\n" + "".join(f"{t:.3f},{a},{b},\n{t + 0.004:.3f},,,{c}\n" for t, (a, b, c) in zip(T, DATA))
        self.refused("P3: has values in no row in which P1 has: they stand on rows of their own", apart)


if __name__ == "__main__":
    unittest.main()
