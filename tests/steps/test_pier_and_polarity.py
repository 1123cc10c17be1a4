"""A three-span girder with one pier 40 % softer than drawn and one accelerometer upside down, from the logger's CSV through steps 3, 4, 6
and 9 as its owner would go, who knows of neither.

Oracles: what was hidden (three_span_girder.py), nothing else. Seeds were written down before anything was run with them.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import three_span_girder as girder  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))
SOFT, REVERSED = 0.6, "A5"


def table(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


class Girder(unittest.TestCase):
    """One record and what its owner makes of it."""
    SEED, SHEAR = 20, False

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        girder.write_campaign(cls.folder / "campaign", cls.SEED, softer={"W": SOFT}, shear=cls.SHEAR, reversed_channels=(REVERSED,))
        girder.write_model(cls.folder / "drawn", bounds=None)                        # the piers are no parameters
        girder.write_model(cls.folder / "narrow", bounds=(0.75, 1.3))                # their maker's word
        girder.write_model(cls.folder / "wide", bounds=(0.3, 3.0))                   # nobody knows
        girder.write_model(cls.folder / "shared", bounds=None, shared_name=True)     # springs and supports of one name
        cls.features = cls.folder / "s3_identification" / "features"
        cls.said = {}
        cls.step("s3_identification", "--campaign", cls.folder / "campaign")

    @classmethod
    def step(cls, token, *arguments, out=None):
        out = cls.folder / (out or token)
        done = subprocess.run([BIN / token, *map(str, arguments), "--out", str(out)], cwd=ROOT, capture_output=True, text=True, timeout=600)
        assert done.returncode == 0, f"{token} {done.returncode}: {done.stderr}"
        cls.said[out.name] = done.stderr
        return out

    def on_model(self, token, model, *arguments, out):
        return self.step(token, "--model", self.folder / model, "--features", self.features, *arguments, out=out)

    def diagnosed(self, model):
        """diagnosis.json and folder of the features as step 3 wrote them."""
        out = self.folder / f"diagnosis_{model}"
        if not out.exists():
            self.on_model("s9_diagnosis", model, out=out.name)
        return json.loads((out / "diagnosis.json").read_text()), out

    def corrected(self, model):
        """The same with what that found put right."""
        _, found = self.diagnosed(model)
        out = self.folder / f"corrected_{model}"
        if not out.exists():
            self.on_model("s9_diagnosis", model, "--correct", found / "corrections.toml", out=out.name)
        return json.loads((out / "diagnosis.json").read_text()), out

    def warnings(self, out):
        return json.loads((out / "manifest.json").read_text())["warnings"]

    def assert_channel_found(self, model):
        result, out = self.diagnosed(model)
        self.assertEqual(result["measurement_corrections"], [{"channel": REVERSED, "action": "reverse", "with": "", "factor": 1.0}])
        self.assertIn(f"correct {REVERSED}, then update", self.said[out.name])

    def assert_pier_named(self, model):
        result, _ = self.corrected(model)
        self.assertEqual(result["verdict"], "named", result["message"])
        self.assertEqual(result["measurement_corrections"], [])
        effect = result["effects"][0]
        self.assertIn("pier_W", effect["location"])
        self.assertFalse(any("pier_E" in member for member in effect["cluster"]), effect["cluster"])
        size = effect["parameters"][0]
        self.assertLessEqual(size["low"], SOFT)
        self.assertGreaterEqual(size["high"], SOFT)


class PierAndPolarity(Girder):
    def test_the_modes_are_those_of_the_girder(self):
        true, _ = girder.modes({"W": SOFT})
        found = [float(row["frequency_Hz"]) for row in table(self.folder / "s3_identification" / "modes.csv")]
        for frequency in true[:6]:
            self.assertLess(min(abs(f / frequency - 1.0) for f in found), 0.01, (found, true))

    def test_comparison_warns_that_shapes_disagree(self):
        out = self.on_model("s4_refinement", "wide", out="comparison")
        self.assertTrue(any("shapes disagree" in warning for warning in self.warnings(out)), self.warnings(out))
        self.assertIn("unpaired, worst MAC", self.said["comparison"])

    def test_updating_warns_of_shapes_and_of_twins(self):
        out = self.on_model("s6_updating", "wide", "--set", "starts=4", out="updated")
        self.assertTrue(any("shapes disagree" in warning for warning in self.warnings(out)), self.warnings(out))
        self.assertTrue(any("k_pier_W, k_pier_E apart" in warning for warning in self.warnings(out)), self.warnings(out))
        self.assertIn("shapes disagree", json.loads((out / "manifest.json").read_text())["message"])
        self.assertIn("WARNING: shapes disagree", self.said["updated"])

    def test_the_reversed_channel_is_found_whatever_the_owner_believes_of_the_piers(self):
        for model in ("drawn", "narrow", "wide", "shared"):
            with self.subTest(model=model):
                self.assert_channel_found(model)

    def test_with_the_channel_turned_shapes_agree(self):
        _, found = self.diagnosed("wide")
        out = self.on_model("s4_refinement", "wide", "--correct", found / "corrections.toml", out="comparison_corrected")
        self.assertFalse(any("shapes disagree" in warning for warning in self.warnings(out)))
        self.assertIn(f"corrected first: {REVERSED} reversed", self.said["comparison_corrected"])

    def test_with_the_channel_turned_the_pier_is_named(self):
        self.assert_pier_named("drawn")

    def test_a_pier_that_may_be_that_soft_is_updated_not_named(self):
        """Where the bounds allow it nothing is missing: the diagnosis weighs shapes, and its model has the right pier soft."""
        result, out = self.corrected("wide")
        self.assertEqual(result["verdict"], "none", result["message"])
        stiffness = {row["spring"]: float(row["stiffness_N_m"]) for row in table(out / "extended_model" / "springs.csv")}
        self.assertAlmostEqual(stiffness["pier_W"] / girder.PIER, SOFT, delta=0.03)
        self.assertAlmostEqual(stiffness["pier_E"] / girder.PIER, 1.0, delta=0.03)

    def test_updating_to_frequencies_blames_the_right_pier_or_warns(self):
        _, found = self.diagnosed("wide")
        out = self.on_model("s6_updating", "wide", "--set", "starts=4", "--correct", found / "corrections.toml", out="updated_corrected")
        value = {row["parameter"]: float(row["final_value"]) for row in table(out / "parameters.csv")}
        disagree = any("shapes disagree" in warning for warning in self.warnings(out))
        self.assertAlmostEqual(min(value["k_pier_W"], value["k_pier_E"]), SOFT, delta=0.03)
        self.assertEqual(disagree, value["k_pier_E"] < value["k_pier_W"])

    def test_a_pier_softer_than_its_bounds_ends_on_them(self):
        """What holds today: the parameter's bound is told. That the pier is named is not asked here: at 2.9 prior deviations it is not."""
        result, _ = self.corrected("narrow")
        self.assertIn("k_pier_W", result["parameters_on_bounds"])
        self.assertNotIn("k_pier_E", result["parameters_on_bounds"])

    def test_a_spring_that_bears_the_name_of_a_support_is_named(self):
        self.assert_pier_named("shared")


class OfAnotherModelClass(Girder):
    """The same on a girder that shears, which its model does not: frequencies are 1 to 5 % off."""
    SEED, SHEAR = 21, True

    def test_both_are_found_where_the_form_may_be_wrong(self):
        self.assert_pier_named("drawn")


if __name__ == "__main__":
    unittest.main()
