"""Two frames on shake tables, from their published modes to a diagnosis; skipped where these are not at hand.

Oracles. Four storeys: the changes of storey stiffness that the authors publish, -0.260 -0.216 -0.128 +0.533 (MAC form) and -0.248 -0.269 -0.119 +0.578
(shape form): their two forms differ by up to 0.053, so that 0.06 is allowed to ours. The measured modes 3 and 4, which neither they nor we
fit: the published changes give their frequencies to 0.8 %. Eighteen storeys: the authors' updating of a shear building puts most storeys on a bound;
the measured mode 3, which no shear building near the nominal one has (frequencies of a uniform one are as 1 to 3 to 5, measured 1 to 3.11 to 5.60), while a column
that bends and shears with one factor for each, fitted to modes 1 and 2 by hand, has it to 1.3 % (4.787 Hz of 4.849 Hz).
"""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
DATA = pathlib.Path(os.environ.get("TWINDECK_DATA", ROOT.parent / "shared" / "data")) / "smu_lab_frames"


def table(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


@unittest.skipUnless((DATA / "four_story_f_hz.csv").is_file(), f"the frames' modes are not at hand ({DATA}); name their parent by TWINDECK_DATA")
class Frame(unittest.TestCase):
    STUDY, TARGET = "", ""

    @classmethod
    def setUpClass(cls):
        if not cls.STUDY:
            raise unittest.SkipTest("what the frames share")
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        for part in ("workflows", "paper", "data/template"):
            shutil.copytree(ROOT / part, cls.root / part, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "Makefile", cls.root / "Makefile")
        cls.results = cls.root / "results" / cls.STUDY
        refused = cls.make("steps", f"STUDY={cls.STUDY}")
        if refused.returncode != 2 or "DATA" not in refused.stderr:
            raise AssertionError(f"without DATA: {refused.returncode} {refused.stderr}")
        done = cls.make(cls.TARGET, f"STUDY={cls.STUDY}", f"DATA={DATA}")
        if done.returncode != 0:
            raise AssertionError(done.stderr)

    @classmethod
    def make(cls, *arguments):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
        return subprocess.run(
            ["make", "NO_BUILD=1", f"BIN={BIN}", "THREADS=1", *arguments],
            cwd=cls.root, env=environment, capture_output=True, text=True, timeout=300,
        )

    def told(self, folder):
        return json.loads((self.results / folder / "diagnosis.json").read_text(encoding="utf-8"))


class FourStoreyFrame(Frame):
    STUDY, TARGET = "smu_four_storey", "all"

    def test_the_published_updating_is_found_again(self):
        ours = [float(row["change"]) for row in table(self.results / "inputs/changes_as_published.csv")]
        for found, published in zip(ours, (-0.260, -0.216, -0.128, 0.533), strict=True):
            self.assertAlmostEqual(found, published, delta=0.06)
        print("changes of storey stiffness:", " ".join(f"{c:+.3f}" for c in ours))

    def test_it_says_the_modes_that_it_did_not_see(self):
        for row in table(self.results / "as_published/pairs.csv"):
            # 0.8 % of the published changes, and the 1 % of form error that a fit allows
            self.assertLess(abs(float(row["after_Hz"]) / float(row["measured_Hz"]) - 1.0), 0.018, row["mode"])
            self.assertGreater(float(row["mac_after"]), 0.99, row["mode"])

    def test_within_what_building_varies_the_fourth_storey_is_on_its_bound_and_those_modes_are_missed(self):
        diagnosis, published = self.told("s9_diagnosis"), self.told("as_published")
        self.assertIn("storey4", diagnosis["parameters_on_bounds"])
        self.assertGreater(diagnosis["gain"]["before"], 2.0 * published["gain"]["before"])
        self.assertEqual(published["verdict"], "none", "with the storeys free there is nothing left to name")
        print(f"held out: {diagnosis['gain']['before']:.2f} deviations within 30 %, {published['gain']['before']:.2f} with the storeys free; "
              f"verdict {diagnosis['verdict']}")

    def test_the_report_tells_source_and_published_figures(self):
        page = (self.results / "report/report.html").read_text(encoding="utf-8")
        for part in ("Where the data come from", "Licence:", "github.com/", "0.533", "verdict of the diagnosis"):
            self.assertIn(part, page)


class EighteenStoreyFrame(Frame):
    STUDY, TARGET = "smu_eighteen_storey", "steps"

    def third(self, folder):
        row = next(r for r in table(self.results / folder / "pairs.csv") if r["mode"] == "3")
        return float(row["after_Hz"]) / float(row["measured_Hz"]) - 1.0

    def test_a_shear_building_does_not_say_the_mode_that_it_did_not_see(self):
        for folder in ("s9_diagnosis", "as_published"):
            self.assertLess(self.third(folder), -0.10, folder)
        told = self.told("s9_diagnosis")
        self.assertEqual(told["verdict"], "none", "an oscillator that predicts nothing is not named")
        self.assertGreater(told["form"][0]["scale"], 2.0, "and its form is known to be off")

    def test_with_bending_it_is_met_better(self):
        # Two fitted modes leave the form error open to some 4 %, so that the fit follows them only in part.
        shear, bending = self.told("as_published"), self.told("with_bending")
        self.assertLess(abs(self.third("with_bending")), 0.8 * abs(self.third("as_published")))
        self.assertLess(bending["gain"]["before"], shear["gain"]["before"])
        self.assertLessEqual(len(bending["parameters_on_bounds"]), 2)
        print(f"mode 3 held out: {shear['gain']['before']:.1f} deviations in shear alone, {bending['gain']['before']:.1f} with bending")


if __name__ == "__main__":
    unittest.main()
