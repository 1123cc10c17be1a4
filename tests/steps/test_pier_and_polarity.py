"""A three-span girder with one pier 40 % softer than drawn and one accelerometer upside down, from the logger's CSV through steps 3, 4, 6
and 9 as its owner would go, who knows of neither.

Oracles: what was hidden (three_span_girder.py), nothing else. The seed is one number, written before anything was run with it.
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
SEED = 20
SOFT, REVERSED = 0.6, "A5"


def table(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


class PierAndPolarity(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        girder.write_campaign(cls.folder / "campaign", SEED, softer={"W": SOFT}, reversed_channels=(REVERSED,))
        girder.write_model(cls.folder / "model")
        girder.write_model(cls.folder / "shared", bounds=None, shared_name=True)
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

    def on_model(self, token, *arguments, model="model", out=None):
        return self.step(token, "--model", self.folder / model, "--features", self.features, *arguments, out=out)

    def diagnosed(self, name, *arguments, model="model"):
        out = self.folder / name
        if not out.exists():
            self.on_model("s9_diagnosis", *arguments, model=model, out=name)
        return json.loads((out / "diagnosis.json").read_text()), out

    def first_diagnosis(self):
        return self.diagnosed("diagnosis")

    def corrected_diagnosis(self):
        _, out = self.first_diagnosis()
        return self.diagnosed("corrected", "--correct", out / "corrections.toml")

    def test_the_modes_are_those_of_the_girder(self):
        true, _ = girder.modes({"W": SOFT})
        found = [float(row["frequency_Hz"]) for row in table(self.folder / "s3_identification" / "modes.csv")]
        for frequency in true[:6]:
            self.assertLess(min(abs(f / frequency - 1.0) for f in found), 0.01, (found, true))

    def test_comparison_warns_that_shapes_disagree(self):
        out = self.on_model("s4_refinement", out="comparison")
        manifest = json.loads((out / "manifest.json").read_text())
        self.assertTrue(any("shapes disagree" in warning for warning in manifest["warnings"]), manifest["warnings"])
        self.assertIn("unpaired, worst MAC", self.said["comparison"])

    def test_updating_warns_of_shapes_and_of_twins(self):
        out = self.on_model("s6_updating", "--set", "starts=4", out="updated")
        manifest = json.loads((out / "manifest.json").read_text())
        self.assertTrue(any("shapes disagree" in warning for warning in manifest["warnings"]), manifest["warnings"])
        self.assertTrue(any("k_pier_W, k_pier_E apart" in warning for warning in manifest["warnings"]), manifest["warnings"])
        self.assertIn("shapes disagree", manifest["message"])
        self.assertIn("WARNING: shapes disagree", self.said["updated"])

    def test_diagnosis_finds_the_reversed_channel(self):
        result, out = self.first_diagnosis()
        self.assertEqual(result["measurement_corrections"], [{"channel": REVERSED, "action": "reverse", "with": "", "factor": 1.0}])
        self.assertIn(f"correct {REVERSED}, then update", self.said["diagnosis"])
        self.assertIn(f'channel = "{REVERSED}"', (out / "corrections.toml").read_text())

    def test_with_the_channel_turned_the_pier_is_found(self):
        result, out = self.corrected_diagnosis()
        self.assertEqual(json.loads((out / "manifest.json").read_text())["corrections"], [f"{REVERSED} reversed"])
        self.assertEqual(result["measurement_corrections"], [])
        effect = result["effects"][0]
        self.assertIn("pier_W", effect["location"])
        self.assertFalse(any("pier_E" in member for member in effect["cluster"]), effect["cluster"])
        size = effect["parameters"][0]
        self.assertLessEqual(size["low"], SOFT)
        self.assertGreaterEqual(size["high"], SOFT)

    def test_with_the_channel_turned_shapes_agree(self):
        _, found = self.first_diagnosis()
        out = self.on_model("s4_refinement", "--correct", found / "corrections.toml", out="comparison_corrected")
        self.assertFalse(any("shapes disagree" in w for w in json.loads((out / "manifest.json").read_text())["warnings"]))
        self.assertIn(f"corrected first: {REVERSED} reversed", self.said["comparison_corrected"])

    def test_piers_that_no_parameter_scales_and_whose_supports_bear_their_name(self):
        result, out = self.diagnosed("shared_names", model="shared")
        self.assertEqual([c["channel"] for c in result["measurement_corrections"]], [REVERSED])
        result, _ = self.diagnosed("shared_corrected", "--correct", out / "corrections.toml", model="shared")
        self.assertIn("pier_W", result["effects"][0]["location"])


if __name__ == "__main__":
    unittest.main()
