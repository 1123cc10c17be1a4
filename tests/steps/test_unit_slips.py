"""All measured frequencies off by one known factor: a unit or a weight for a mass, which steps 5, 6 and 9 name before they update or name anything.

Oracle: the frequencies of the template's features divided by sqrt(9.80665); the words of each refusal, and its remedy followed.
"""
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
TEMPLATE = ROOT / "data" / "template"


class UnitSlips(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        for part in ("model", "features"):
            shutil.copytree(TEMPLATE / part, cls.folder / part)
        with open(cls.folder / "features/rows.csv", newline="") as table:
            rows = list(csv.DictReader(table))
        for row in rows:
            if row["type"] == "frequency_Hz":
                row["value"], row["std"] = (float(row[key]) / math.sqrt(9.80665) for key in ("value", "std"))
        with open(cls.folder / "features/rows.csv", "w", newline="") as table:
            writer = csv.DictWriter(table, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)
        # The same model whose bounds reach the factor of ten in stiffness over mass.
        shutil.copytree(cls.folder / "model", cls.folder / "wide")
        file = cls.folder / "wide/model.toml"
        text = re.sub(r"lower = 204e9\nupper = 216e9", "lower = 5e9\nupper = 2e12", file.read_text())
        file.write_text(text.replace("lower = 0.2\nupper = 5.0", "lower = 0.01\nupper = 100.0"))

    def run_step(self, step, model, out, *more):
        return subprocess.run([BIN / step, "--model", model, "--features", "features", "--out", out, "--threads", "1", *more], cwd=self.folder,
                              capture_output=True, text=True, timeout=300)

    def refused(self, done):
        self.assertEqual(done.returncode, 2, done.stderr)
        said = done.stderr.splitlines()[-1]
        self.assertIn("measured frequencies are 0.305 times the computed ones", said)
        self.assertIn("is a mass divided by g once too often?", said)
        return said

    def test_steps_5_6_and_9_name_the_unit(self):
        for step in ("s5_sensitivity", "s6_updating", "s9_diagnosis"):
            self.refused(self.run_step(step, "model", f"out/{step}", "--quiet"))

    def test_step_9_names_no_material_though_bounds_reach_the_factor(self):
        said = self.refused(self.run_step("s9_diagnosis", "wide", "out/wide", "--quiet"))
        self.assertIn("a parameter that is meant to be so far off gets that value in the model and as its `initial`", said)
        file = self.folder / "wide/model.toml"
        file.write_text(file.read_text().replace("initial = 210e9", "initial = 21e9").replace("initial = 1.0\nlower = 0.01", "initial = 0.1\nlower = 0.01"))
        materials = self.folder / "wide/materials.csv"
        materials.write_text(materials.read_text().replace("2.1e11", "2.1e10").replace("210e9", "21e9").replace("210000000000", "21000000000"))
        done = self.run_step("s9_diagnosis", "wide", "out/meant", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(json.loads((self.folder / "out/meant/diagnosis.json").read_text())["verdict"], ("none", "named", "ambiguous", "unknown"))


if __name__ == "__main__":
    unittest.main()
