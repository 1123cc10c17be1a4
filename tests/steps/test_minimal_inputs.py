"""Every step with its defaults alone on the least that somebody may have: one channel, two channels, one mode, one minute, one reference.

Oracle: exit code 0 of each step, and no line that blames the command line, on which nothing stands but the inputs. The records are those of the
template's frame (data/template), the first frequency theirs in its features.
"""
import csv
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from test_identification_defaults import vibrating  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
TEMPLATE = ROOT / "data" / "template"
CHANNELS = ["A_x", "B_x", "C_z", "D_z"]
FIRST_HZ = 2.2159


def rows(file):
    with open(file, newline="") as table:
        return list(csv.DictReader(table))


class Minimal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.record = np.load(TEMPLATE / "campaign/records/wind.npy")

    def done(self, step, *arguments):
        done = subprocess.run([BIN / step, *arguments, "--threads", "1"], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, f"{step}: {done.stderr}")
        self.assertNotIn("command line", done.stderr)
        return done.stderr

    def campaign(self, name, channels, samples, references):
        folder = self.folder / name / "campaign"
        folder.mkdir(parents=True)
        kept = [row for row in rows(TEMPLATE / "campaign/channels.csv") if row["channel"] in channels]
        with open(folder / "channels.csv", "w", newline="") as table:
            writer = csv.DictWriter(table, kept[0].keys())
            writer.writeheader()
            writer.writerows({**row, "reference": int(row["channel"] in references)} for row in kept)
        np.save(folder / "record.npy", samples)
        (folder / "campaign.toml").write_text('[[record]]\nsetup = "ST1"\nfile = "record.npy"\nsampling_rate_Hz = 50.0\n'
                                              f"channels = {channels}\n".replace("'", '"'))
        return folder

    def test_from_records_to_a_diagnosis(self):
        all_of_it = {name: self.record[:, [CHANNELS.index(name)]] for name in CHANNELS}
        cases = {"one_channel": (["A_x"], all_of_it["A_x"], ["A_x"]),
                 "two_channels": (["A_x", "B_x"], self.record[:, :2], ["A_x", "B_x"]),
                 "one_mode": (["B_x"], vibrating([FIRST_HZ], 300, 50.0, 3, 0.01), ["B_x"]),
                 "one_minute": (CHANNELS, self.record[:3000], CHANNELS),
                 "one_reference": (CHANNELS, self.record, ["B_x"])}
        for name, (channels, samples, references) in cases.items():
            with self.subTest(name):
                campaign, out = self.campaign(name, channels, samples, references), self.folder / name
                self.done("s3_identification", "--campaign", campaign, "--out", out / "s3")
                modes = rows(out / "s3/modes.csv")
                self.assertTrue(any(abs(float(m["frequency_Hz"]) / FIRST_HZ - 1) < 0.02 for m in modes), modes)
                measured = ["--features", out / "s3/features"]
                self.done("s1_model", "--model", TEMPLATE / "model", "--out", out / "s1")
                self.done("s4_refinement", "--model", TEMPLATE / "model", *measured, "--out", out / "s4")
                self.done("s5_sensitivity", "--model", out / "s4/model", "--out", out / "s5")
                self.done("s6_updating", "--model", out / "s4/model", *measured, "--out", out / "s6")
                self.done("s9_diagnosis", "--model", out / "s4/model", *measured, "--out", out / "s9")

    def test_one_measured_mode_in_wind(self):
        """The template's footbridge, of whose modes one was measured: steps 7, 8 and 10 too, all on their defaults."""
        for part in ("workflows", "data/template"):
            shutil.copytree(ROOT / part, self.folder / part, ignore=shutil.ignore_patterns("__pycache__"))
        study, results = self.folder / "workflows/template/girder", self.folder / "results"
        shutil.copytree(TEMPLATE / "girder", self.folder / "data/girder")
        for file in study.glob("*.toml"):
            file.write_text(file.read_text().replace("data/template", "data/girder"))
        features = self.folder / "data/girder/features/rows.csv"
        lines = features.read_text().splitlines(keepends=True)
        features.write_text(lines[0] + lines[1])
        for step in ("s1_model", "s4_refinement", "s5_sensitivity", "s6_updating", "s7_aerodynamics", "s8_validation", "s10_reliability"):
            self.done(step, "--study", study, "--results", results, "--out", results / step)


if __name__ == "__main__":
    unittest.main()
