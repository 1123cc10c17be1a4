"""The study weimar_frame on the measured records of the steel frame, fifteen setups; skipped where they are not at hand.

Oracle: the eleven frequencies with standard deviations that the authors of the records publish (Marwitz and Zabel 2017, Experimental
Mechanics 57, 1311-1325; merged result shipped with the records): each within the larger of 0.2 % and three combined standard deviations.
PoSER and PreGER shapes of one structure agree: MAC above 0.98.
"""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEP = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve() / "s3_identification"
DATA = pathlib.Path(os.environ.get("TWINDECK_DATA", ROOT.parent / "shared" / "data")) / "weimar_steel_frame_15setups"
PUBLISHED_HZ = [1.2283, 1.4358, 2.1000, 4.0175, 4.7704, 6.6824, 7.6157, 9.6653, 12.1663, 12.5979, 13.8545]
PUBLISHED_STD_HZ = [0.0012, 0.0015, 0.0003, 0.0020, 0.0018, 0.0022, 0.0024, 0.0017, 0.0027, 0.0004, 0.0105]


def rows(file):
    with open(file, newline="") as f:
        return list(csv.DictReader(f))


@unittest.skipUnless(DATA.is_dir(), f"the measured records are not at hand ({DATA}); name their folder by TWINDECK_DATA")
class WeimarFrame(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        subprocess.run([sys.executable, ROOT / "workflows/weimar_frame/campaign.py", DATA, cls.folder / "campaign"], check=True)
        cls.out = cls.identified(cls.folder / "campaign", cls.folder / "s3_identification")

    @staticmethod
    def identified(campaign, out):
        done = subprocess.run([STEP, "--study", "workflows/weimar_frame", "--campaign", campaign, "--out", out, "--threads", "1"], cwd=ROOT,
                              capture_output=True, text=True, timeout=600)
        if done.returncode:
            raise AssertionError(done.stderr)
        return out

    def test_eleven_published_frequencies(self):
        modes = rows(self.out / "modes.csv")
        worst = 0.0
        for published, std in zip(PUBLISHED_HZ, PUBLISHED_STD_HZ):
            ours = min(modes, key=lambda m: abs(float(m["frequency_Hz"]) - published))
            allowed = max(0.002 * published, 3 * np.hypot(std, float(ours["frequency_std_Hz"])))
            off = abs(float(ours["frequency_Hz"]) - published)
            worst = max(worst, off / published)
            self.assertLessEqual(off, allowed, published)
        print(f"largest deviation of a frequency {100 * worst:.3f} %")
        complete = [m for m in modes if m["partial"] == "0"]
        self.assertEqual(len(complete), 11, [m["frequency_Hz"] for m in modes])

    def test_shapes_of_both_mergings_agree(self):
        checks = [c for c in rows(self.out / "merging.csv") if int(c["setups"]) >= 8]
        self.assertGreaterEqual(len(checks), 11)
        for check in checks:
            self.assertGreater(float(check["mac"] or 0), 0.98, check)

    def test_a_setup_three_times_as_large_changes_no_shape(self):
        folder = self.folder / "tripled"
        folder.mkdir()
        for name in ("channels.csv", "conditions.toml", "campaign.toml"):
            (folder / name).write_bytes((self.folder / "campaign" / name).read_bytes())
        np.save(folder / "setup_04.npy", 3.0 * np.load(DATA / "setup_04.npy").astype(float))
        text = (folder / "campaign.toml").read_text()
        (folder / "campaign.toml").write_text(text.replace(str((DATA / "setup_04.npy").resolve()), "setup_04.npy"))
        tripled = self.identified(folder, self.folder / "tripled_out")
        before, after = rows(self.out / "shapes.csv"), rows(tripled / "shapes.csv")
        self.assertEqual(len(before), len(after))
        for a, b in zip(before, after):
            self.assertEqual((a["mode"], a["direction"]), (b["mode"], b["direction"]))
            self.assertLess(abs(complex(float(a["value"]), float(a["value_imag"])) - complex(float(b["value"]), float(b["value_imag"]))), 1e-9)


if __name__ == "__main__":
    unittest.main()
