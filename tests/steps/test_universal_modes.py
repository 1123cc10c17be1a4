"""Modes as universal files: what s1_model --export-unv writes, what step 3 writes and reads, and what steps make of it.

Oracle: the model's own modes in modes.csv and shapes.csv, against which those that went through the file have a MAC of 1.
"""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
TEMPLATE = ROOT / "data" / "template"


def rows(file):
    with open(file, newline="") as table:
        return list(csv.DictReader(table))


class Universal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))

    def run_step(self, step, *arguments):
        return subprocess.run([BIN / step, *arguments, "--threads", "1"], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def done(self, step, *arguments):
        done = self.run_step(step, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def test_a_model_as_if_it_were_measured(self):
        self.done("s1_model", "--model", TEMPLATE / "model", "--out", "s1", "--set", "n_modes=5", "--export-unv")
        text = (self.folder / "s1/model.unv").read_text()
        for number in ("2411", "2412", "82", "55"):
            self.assertIn(f"    -1\n{number:>6}\n", text)
        self.done("s3_identification", "--modes", "s1/model.unv", "--out", "s3", "--set", "imported_std_pct=0.5")
        computed, read = rows(self.folder / "s1/modes.csv"), rows(self.folder / "s3/modes.csv")
        self.assertEqual([m["mode"] for m in read], [m["mode"] for m in computed])
        for a, b in zip(read, computed):
            self.assertAlmostEqual(float(a["frequency_Hz"]) / float(b["frequency_Hz"]), 1.0, delta=1e-5)
            self.assertAlmostEqual(float(a["frequency_std_Hz"]), 0.005 * float(a["frequency_Hz"]), delta=1e-9)
        # The frame moves in its plane alone: no channel along y.
        self.assertEqual({c["dy"] for c in rows(self.folder / "s3/channels.csv")}, {"0"})
        self.done("s4_refinement", "--model", TEMPLATE / "model", "--modes", "s3", "--out", "s4", "--set", "n_modes=5")
        pairs = rows(self.folder / "s4/pairs.csv")
        self.assertEqual(len(pairs), 5)
        self.assertTrue(all(float(p["mac"]) > 0.9999 for p in pairs), pairs)

    def test_identified_modes_come_back(self):
        self.done("s3_identification", "--campaign", TEMPLATE / "campaign", "--out", "own")
        said = self.done("s3_identification", "--modes", "own/modes.unv", "--out", "back")
        self.assertIn("warning: own/modes.unv: has no standard deviations", said)
        self.assertIn("imported_std_pct=0.5", said)
        own, back = rows(self.folder / "own/modes.csv"), rows(self.folder / "back/modes.csv")
        self.assertEqual(len(own), len(back))
        for a, b in zip(back, own):
            self.assertAlmostEqual(float(a["frequency_Hz"]) / float(b["frequency_Hz"]), 1.0, delta=1e-5)
            self.assertAlmostEqual(float(a["damping_ratio_pct"]) / float(b["damping_ratio_pct"]), 1.0, delta=1e-3)
        listed = json.loads((self.folder / "back/manifest.json").read_text())
        self.assertEqual(list(listed["inputs"]), ["own/modes.unv"])
        self.assertTrue(any("no standard deviations" in w for w in listed["warnings"]))
        # Without one the next step refuses; the remedy of the warning, followed literally, works.
        refused = self.run_step("s4_refinement", "--model", TEMPLATE / "model", "--modes", "back", "--out", "s4_back")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("has no standard deviation", refused.stderr)
        self.done("s3_identification", "--modes", "own/modes.unv", "--out", "back", "--set", "imported_std_pct=0.5")
        self.done("s4_refinement", "--model", TEMPLATE / "model", "--modes", "back", "--out", "s4_back")

    def test_a_folder_of_modes_goes_to_the_steps_that_compare(self):
        self.done("s1_model", "--model", TEMPLATE / "model", "--out", "s1_folder")
        refused = self.run_step("s3_identification", "--modes", "s1_folder", "--out", "s3_folder")
        self.assertEqual((refused.returncode, refused.stderr.count("\n")), (2, 1), refused.stderr)
        self.assertIn("s1_folder: is a folder, expected a universal file with modes", refused.stderr)
        self.done("s1_model", "--model", TEMPLATE / "model", "--out", "s1_file", "--export-unv")
        refused = self.run_step("s4_refinement", "--model", TEMPLATE / "model", "--modes", "s1_file/model.unv", "--out", "s4_file")
        self.assertEqual((refused.returncode, refused.stderr.count("\n")), (2, 1), refused.stderr)
        self.assertIn("s3_identification --modes FILE --out DIR --set imported_std_pct=0.5", refused.stderr)
        self.done("s3_identification", "--modes", "s1_file/model.unv", "--out", "made", "--set", "imported_std_pct=0.5")
        self.done("s4_refinement", "--model", TEMPLATE / "model", "--modes", "made", "--out", "s4_made")


if __name__ == "__main__":
    unittest.main()
