"""Step 6 with residuals = ["frequency", "shape"], weighed by the covariance: a symmetric girder with one soft pier.

The girder is a beam of 140 elements in NumPy, the model has 28 (three_span_girder.py); features are its modes at nine sensors with drawn
noise. Oracles: the pier that was softened; the girder's mirror image, which has the same frequencies; scales that change nothing; the
contract of exit codes. Seeds 31 to 36 were written down before anything was run with them.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import three_span_girder as girder  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))
SOFT, MODES, FREQUENCY_STD, SHAPE_STD = 0.6, 6, 1e-3, 0.01
SHAPES = ("--set", "residuals=['frequency','shape']")
DENSITY = '[[parameter]]\nname = "rho"\ntarget = "density"\nof = ["concrete"]\nunit = "kg/m3"\ninitial = 2500\nlower = 1750\nupper = 3250\n'


def table(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def measured(pier, seed):
    """Frequencies and shapes (sensors x modes) of the girder with one soft pier, with noise."""
    random = np.random.default_rng(seed)
    frequency, shapes = girder.modes({pier: SOFT})
    nodes = len(shapes)
    seen = shapes[[round(x / girder.LENGTH * (nodes - 1)) for x in girder.SENSORS.values()], :MODES]
    seen = seen / np.abs(seen).max(axis=0)
    frequency = frequency[:MODES] * (1 + FREQUENCY_STD * random.normal(size=MODES))
    return frequency, seen + SHAPE_STD * random.normal(size=seen.shape)


def write_features(folder, frequency, shapes, missing=()):
    """shapes: real or complex; missing: (mode, channel) that were not measured. Returns the standard deviations of the rows."""
    folder.mkdir()
    rows, std = ["type,mode,channel,condition,value,std"], []
    for i, f in enumerate(frequency):
        lines = [("frequency_Hz", "", f, FREQUENCY_STD * f)]
        for name, value in zip(girder.SENSORS, shapes[:, i]):
            if (i + 1, name) in missing:
                continue
            size = SHAPE_STD * np.abs(shapes[:, i]).max()
            lines.append(("shape", name, value.real, size))
            if np.iscomplexobj(shapes):
                lines.append(("shape_imag", name, value.imag, size))
        rows += [f"{kind},{i + 1},{channel},calm,{value:.12g},{s:.12g}" for kind, channel, value, s in lines]
        std += [s for *_, s in lines]
    (folder / "rows.csv").write_text("\n".join(rows) + "\n")
    (folder / "conditions.toml").write_text("[calm]\n")
    (folder / "channels.csv").write_text("channel,x_m,y_m,z_m,dx,dy,dz\n" + "".join(f"{n},{x},0,0,0,0,1\n" for n, x in girder.SENSORS.items()))
    return np.array(std)


class OnAGirder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        girder.write_model(self.folder / "model", bounds=(0.3, 3.0))

    def run_step(self, *arguments, features="features", out="out"):
        given = ("--modes" if features == "modes" else "--features", self.folder / features)
        return subprocess.run([BIN / "s6_updating", "--model", self.folder / "model", *given, "--out", self.folder / out, "--set", "starts=4",
                               *map(str, arguments)], capture_output=True, text=True, check=False, cwd=ROOT, timeout=300)

    def updated(self, *arguments, features="features", out="out"):
        done = self.run_step(*arguments, features=features, out=out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.said = done.stderr
        self.warnings = json.loads((self.folder / out / "manifest.json").read_text())["warnings"]
        return {row["parameter"]: float(row["final_value"]) for row in table(self.folder / out / "parameters.csv")}

    def assert_right(self, values, pier, out="out"):
        """Each pier within four of its own standard deviations, which are small."""
        std = {row["parameter"]: float(row["std"]) for row in table(self.folder / out / "posterior.csv")}
        for name in "WE":
            self.assertLess(std[f"k_pier_{name}"], 0.1)
            self.assertLess(abs(values[f"k_pier_{name}"] - (SOFT if name == pier else 1.0)), 4 * std[f"k_pier_{name}"], name)
        self.assertFalse([w for w in self.warnings if "apart" in w or "another optimum" in w], self.warnings)

    def test_shapes_name_the_pier_that_frequencies_cannot(self):
        blamed = []
        for pier, seed in (("W", 31), ("E", 31)):  # the same noise of the frequencies, so that they are the same
            frequency, shapes = measured(pier, seed)
            write_features(self.folder / pier, frequency, shapes)
            values = self.updated(features=pier, out="frequencies_" + pier)
            blamed.append(min("WE", key=lambda name: values[f"k_pier_{name}"]))
            self.assertTrue(any("apart" in w and "weigh the shapes too" in w for w in self.warnings), self.warnings)
            self.assert_right(self.updated(*SHAPES, features=pier, out=pier + "_out"), pier, pier + "_out")
        self.assertEqual(blamed[0], blamed[1], "the same frequencies cannot lead to two answers: one of them is wrong")

    def test_right_over_further_noise(self):
        for seed in (32, 33, 34):
            write_features(self.folder / f"f{seed}", *measured("E", seed))
            out = f"out{seed}"
            self.assert_right(self.updated(*SHAPES, features=f"f{seed}", out=out), "E", out)
            quantity = {row["quantity"]: float(row["value"]) for row in table(self.folder / out / "weighing.csv")}
            drawn = girder.modes()[0][:MODES]
            self.assertEqual([i for i in range(1, MODES) if drawn[i] - drawn[i - 1] < 0.02 * drawn[i]], [2], "modes 2 and 3 are close")
            degrees = MODES + 9 * MODES - (MODES + 2) - 3  # each of the two close modes has the scales of both shapes
            self.assertEqual(quantity["degrees_of_freedom"], degrees)
            self.assertLess(quantity["chi_squared"], degrees + 5 * (2 * degrees) ** 0.5)

    def test_complex_scales_are_free_and_channels_may_be_missing(self):
        frequency, shapes = measured("W", 35)
        turned = shapes * np.exp(1j * np.linspace(0.3, 2.7, MODES)) * np.linspace(0.2, 5.0, MODES)
        write_features(self.folder / "features", frequency, turned, missing={(2, "A1"), (3, "A5"), (3, "A9")})
        self.assert_right(self.updated(*SHAPES), "W")
        self.assertEqual(len(table(self.folder / "out" / "weighed_rows.csv")), MODES + 2 * (9 * MODES - 3))

    def test_the_covariance_is_what_weighs(self):
        frequency, shapes = measured("W", 36)
        std = write_features(self.folder / "plain", frequency, shapes)
        write_features(self.folder / "same", frequency, shapes)
        write_features(self.folder / "loose", frequency, shapes)
        np.save(self.folder / "same" / "covariance.npy", np.diag(std**2))
        np.save(self.folder / "loose" / "covariance.npy", 4 * np.diag(std**2))
        found = {name: self.updated(*SHAPES, features=name, out=name + "_out") for name in ("plain", "same", "loose")}
        for name in ("k_pier_W", "k_pier_E"):
            self.assertAlmostEqual(found["plain"][name], found["same"][name], delta=1e-7, msg="a search ends at a gradient of 1e-6")
            self.assertAlmostEqual(found["plain"][name], found["loose"][name], places=4)
        rows = {name: {r["parameter"]: float(r["std"]) for r in table(self.folder / (name + "_out") / "posterior.csv")} for name in found}
        self.assertAlmostEqual(rows["loose"]["k_pier_W"] / rows["plain"]["k_pier_W"], 2.0, delta=0.05)

    def test_a_reversed_sensor_is_named(self):
        frequency, shapes = measured("W", 31)
        shapes[list(girder.SENSORS).index("A4")] *= -1
        write_features(self.folder / "features", frequency, shapes)
        self.updated(*SHAPES)
        self.assertTrue(any("chi²" in w and "channel A4's: it may be reversed" in w for w in self.warnings), self.warnings)

    def test_twins_and_their_second_optimum_are_named_where_frequencies_alone_are_weighed(self):
        write_features(self.folder / "features", *measured("W", 31))
        self.updated("--set", "weights=covariance", "--set", "starts=8")
        self.assertTrue(any("cannot tell k_pier_W, k_pier_E apart at the initial values" in w for w in self.warnings), self.warnings)
        self.assertTrue(any("another optimum is as good" in w for w in self.warnings), self.warnings)

    def test_the_flat_direction_is_told_in_words(self):
        """Stiffness and mass in one proportion: modulus and density cannot be told apart."""
        file = self.folder / "model" / "model.toml"
        file.write_text(file.read_text() + DENSITY)
        write_features(self.folder / "features", *measured("W", 31))
        self.updated(*SHAPES)
        flat = [w for w in self.warnings if w.startswith("flat direction")]
        self.assertEqual(len(flat), 1, self.warnings)
        self.assertIn("E_concrete by", flat[0])
        self.assertIn("rho by", flat[0])
        correlation = {(r["parameter"], r["other_parameter"]): float(r["correlation"]) for r in table(self.folder / "out" / "correlations.csv")}
        self.assertGreater(correlation.get(("E_concrete", "rho"), correlation.get(("rho", "E_concrete"))), 0.9)

    def test_by_default_nothing_is_weighed(self):
        write_features(self.folder / "features", *measured("W", 31))
        self.updated()
        for name in ("weighed_rows.csv", "weighing.csv"):
            self.assertFalse((self.folder / "out" / name).exists(), name)
        self.assertEqual({row["label"] for row in table(self.folder / "out" / "posterior.csv")}, {"assumed"})
        self.assertLess(float(table(self.folder / "out" / "costs.csv")[0]["cost"]), 1.0, "squares of relative errors")

    def test_what_cannot_be_weighed_is_refused(self):
        frequency, shapes = measured("W", 31)
        write_features(self.folder / "features", frequency, shapes)
        modes = self.folder / "modes"
        modes.mkdir()
        (modes / "modes.csv").write_text("mode,frequency_Hz,frequency_std_Hz,damping_ratio_pct,damping_ratio_std_pct\n" +
                                         "".join(f"{i + 1},{f:.9g},0.01,,\n" for i, f in enumerate(frequency)))
        (modes / "channels.csv").write_text((self.folder / "features" / "channels.csv").read_text())
        for arguments, features, word in ((("--set", "residuals=['shape']"), "features", "lacks \"frequency\""),
                                          ((*SHAPES, "--set", "weights=relative"), "features", "says nothing of shapes"),
                                          (SHAPES, "modes", "no measured shape")):
            done = self.run_step(*arguments, features=features)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(word, done.stderr)
            self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
