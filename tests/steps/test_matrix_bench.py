"""The bench on the matrices of a real bridge (tests/blind/matrices): its geometry, its truths, what seeds hide, its folders and its rating; skipped where the matrices are not at hand.

Oracles. Frequencies that the authors publish of their model (reference_results.json, printed to four decimals). Rigid motions: the strain energy of a part that moves as a rigid
body is zero, with and without errors of the form. Mass: Sylvester's law, a mass beside its joint leaves as many non-zero eigenvalues. A mass, a spring and an oscillator change
frequencies in the direction of Rayleigh's quotient. The program computes the frequencies of the folder. Rating: answers written by hand.
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
import scipy.sparse

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
BENCH = ROOT / "tests" / "blind" / "matrices"
sys.path[:0] = [str(BENCH), str(BENCH.parent / "exam")]
import bridge as published  # noqa: E402
import folders  # noqa: E402
import hidden  # noqa: E402
import matrices  # noqa: E402
import rated  # noqa: E402
import truth as truths  # noqa: E402

AT_HAND = unittest.skipUnless(published.is_at_hand(), f"the bridge's matrices are not at hand ({published.DATA})")


def told(folder, *options):
    return subprocess.run([sys.executable, BENCH / "matrices.py", BIN, folder, *options], capture_output=True, text=True, timeout=300)


@AT_HAND
class Geometry(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bridge = published.read_bridge()

    def test_the_published_frequencies(self):
        expected = json.loads((published.DATA / "reference_results.json").read_text(encoding="utf-8"))["nominal_f"]
        found, shapes = published.modes(sum(self.bridge.stiffness.values()), scipy.sparse.diags(self.bridge.mass), 12)
        np.testing.assert_allclose(found, expected, atol=6e-5)
        np.testing.assert_allclose(shapes.T @ (self.bridge.mass[:, None] * shapes), np.eye(12), atol=1e-9)

    def test_eleven_panels_of_nine_feet(self):
        self.assertEqual(self.bridge.length, 11 * 108.0)
        np.testing.assert_array_equal(self.bridge.place, np.round(self.bridge.place))
        for dof, other in ((20, 21), (16, 12), (301, 300)):  # channels along y and z of one joint
            self.assertEqual(self.bridge.joint_of[dof], self.bridge.joint_of[other])
        ends = [self.bridge.place[self.bridge.joint_of[np.flatnonzero(np.diag(self.bridge.stiffness[part]))], 0] for part in published.SPRINGS]
        np.testing.assert_allclose(ends, [[0.0, 0.0], [1188.0, 1188.0]] * 2, atol=1e-4)

    def test_parts_turn_as_rigid_bodies_with_errors_of_the_form(self):
        """About x, y and z through the origin: a joint moves by the turn times its place."""
        truth = truths.with_form(self.bridge, {}, truths.draw_form(self.bridge, np.random.default_rng(1)), 1.0)
        joint, direction = self.bridge.joint_of, self.bridge.direction
        for axis in range(3):
            turned = np.cross(np.eye(3)[axis], self.bridge.place)[joint]
            motion = np.where(direction < 3, turned[np.arange(len(joint)), direction % 3], direction == 3 + axis)
            for part in ("Conc5", "Conc8", "Truss"):
                for matrix in (self.bridge.stiffness[part], truth.parts[part]):
                    scale = np.abs(matrix).max() * (motion @ motion)
                    self.assertLess(abs(motion @ matrix @ motion), 1e-9 * scale, (axis, part))
                if axis == 0:
                    rows = np.flatnonzero(np.abs(matrix).sum(axis=1))
                    self.assertGreater(np.linalg.eigvalsh(matrix[np.ix_(rows, rows)])[0], -1e-9 * np.abs(matrix).max())


@AT_HAND
class Truths(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.bridge = published.read_bridge()
        cls.ones = dict.fromkeys(cls.bridge.stiffness, 1.0)
        cls.form = truths.draw_form(cls.bridge, np.random.default_rng(2))

    def test_without_error_and_cause_it_is_the_model(self):
        truth = truths.with_form(self.bridge, self.ones, self.form, 0.0)
        model = sum(self.bridge.stiffness.values())
        self.assertLess(np.abs(truth.stiffness() - model).max(), 1e-9 * np.abs(model).max())
        found, _ = hidden.measured_modes(self.bridge, truth, None, tuple(self.bridge.measured), 8)
        expected, _ = published.modes(model, scipy.sparse.diags(self.bridge.mass), 8)
        np.testing.assert_allclose(found, expected, rtol=1e-9)

    def test_a_mass_beside_its_joint_stays_one_mass(self):
        mass = truths.mass_matrix(self.bridge, self.form, 1.0).toarray()
        np.testing.assert_allclose(mass, mass.T, atol=0.0)
        values = np.linalg.eigvalsh(mass)
        self.assertGreater(values[0], -1e-9 * values[-1])
        self.assertEqual(np.sum(values > 1e-9 * values[-1]), np.sum(self.bridge.mass > 0.0))

    def test_the_error_of_the_form_is_what_was_asked_for(self):
        random = np.random.default_rng(3)
        truth = truths.draw_truth(self.bridge, random, 0.01)
        random = np.random.default_rng(3)
        exact = truths.draw_truth(self.bridge, random, 0.0)
        self.assertEqual(truth.theta, exact.theta)
        error = np.log(truths.frequencies(truth) / truths.frequencies(exact))
        self.assertAlmostEqual(float(np.sqrt(np.mean(error**2))), 0.01, delta=1e-4)

    def test_causes_act_as_rayleigh_says(self):
        truth = truths.with_form(self.bridge, self.ones, self.form, 0.3)
        channels = tuple(self.bridge.measured)

        def found(cause, temperature=None):
            return hidden.measured_modes(self.bridge, truth, cause, channels, 6, temperature)[0]

        sound = found(None)
        self.assertLess(np.max(found(hidden.Cause("mass", "69", 0.005)) - sound), 0.0)
        self.assertGreater(np.min(found(hidden.Cause("spring", "z1", 3.0)) - sound), 0.0)
        warm = found(hidden.Cause("temperature", "global", -0.002), 25.0)
        self.assertTrue(np.all((warm < sound) & (warm > sound * np.sqrt(0.98) - 1e-9)))  # stray springs do not soften
        swinging = found(hidden.Cause("oscillator", "69", 0.003, 4.7))
        self.assertEqual(len(swinging), 7)
        self.assertLess(swinging[0], sound[0])


@AT_HAND
class Hidden(unittest.TestCase):
    def test_a_seed_holds_four_sound_trials_and_twelve_causes(self):
        self.assertEqual(len(hidden.KINDS), 16)
        self.assertEqual(sum(kind in hidden.SOUND for kind in hidden.KINDS), 4)
        errors = {(kind, hidden.FORM_ERRORS[(seed + n) % 3]) for seed in range(3) for n, kind in enumerate(hidden.KINDS)}
        self.assertEqual(len(errors), 3 * len(set(hidden.KINDS)))

    def test_two_draws_of_one_seed_are_equal(self):
        bridge = published.read_bridge()
        one, same = hidden.hide(5, 9, bridge), hidden.hide(5, 9, bridge)
        self.assertEqual((one.cause, one.channels, one.modes), (same.cause, same.channels, same.modes))
        self.assertGreaterEqual(one.cause.sigma, hidden.VISIBLE_SIGMA)
        for (_, f, shapes), (_, g, others) in zip(folders.measurement(bridge, one), folders.measurement(bridge, same)):
            np.testing.assert_array_equal(f, g)
            np.testing.assert_array_equal(shapes, others)

    def test_a_fault_of_a_channel_is_in_its_row_alone(self):
        shapes = np.arange(6.0).reshape(3, 2) + 1.0
        channels = (20, 21, 16)
        np.testing.assert_array_equal(hidden.faulty(shapes, hidden.Cause("gain", "c22", 2.0), channels), [[1, 2], [6, 8], [5, 6]])
        np.testing.assert_array_equal(hidden.faulty(shapes, hidden.Cause("swap", "c17,c21", 1.0), channels), [[5, 6], [3, 4], [1, 2]])

    def test_effects_by_hand(self):
        shapes = np.eye(3)[:, :2] + 0.1
        self.assertEqual(hidden.effect((np.ones(2), shapes), (np.ones(2), -3.0 * shapes), 0.01), 0.0)
        self.assertAlmostEqual(hidden.effect((np.array([1.0, 2.0]), shapes), (np.array([1.0, 2.0 * np.exp(0.02)]), shapes), 0.01), 10.0)


@AT_HAND
class Folders(unittest.TestCase):
    def test_the_program_computes_the_published_model(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        bridge = published.read_bridge()
        for joints in (False, True):
            model = folders.write_model(published.DATA, folder / str(joints), bridge, joints)
            done = subprocess.run([BIN / "s1_model", "--model", model, "--out", folder / "s1", "--quiet", "--set", "n_modes=6"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(folder / "s1" / "modes.csv", newline="", encoding="utf-8") as stream:
                computed = [float(row["frequency_Hz"]) for row in csv.DictReader(stream)]
            expected, _ = published.modes(sum(bridge.stiffness.values()), scipy.sparse.diags(bridge.mass), 6)
            np.testing.assert_allclose(computed, expected, rtol=1e-6)

    def test_what_is_hidden_is_told_without_a_run(self):
        done = told(pathlib.Path("unused"), "2", "0", "--count")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(done.stdout.splitlines()), 2)
        self.assertIn("0 0 sound, form error 0.5 %: nothing", done.stdout)


@AT_HAND
class Rating(unittest.TestCase):
    def rate(self, verdict, entries, cause=None):
        effects = [dict(zip(("cause", "location", "cluster"), (*entry[0].split("@"), list(entry)))) for entry in entries]
        return rated.rate({"verdict": verdict, "effects": effects}, cause, published.read_bridge())

    def test_by_hand(self):
        part, spring = hidden.Cause("part", "Conc5", 0.5), hidden.Cause("spring", "z1", 0.3)
        mass = hidden.Cause("mass", str(published.read_bridge().joint_of[300]), 0.005)
        self.assertEqual(self.rate("named", [["stiffness@group:Conc5"]], part), "right")
        self.assertEqual(self.rate("ambiguous", [["stiffness@group:Conc4", "stiffness@group:Conc5"]], part), "right")
        self.assertEqual(self.rate("named", [["stiffness@group:Conc4"]], part), "wrong")
        self.assertEqual(self.rate("named", [["stiffness@groups:z1,z2"]], spring), "wrong")
        self.assertEqual(self.rate("named", [["mass@node:n302"]], mass), "right")   # the other direction of the joint
        self.assertEqual(self.rate("named", [["mass@node:n326"]], mass), "right")   # across the deck
        self.assertEqual(self.rate("named", [["mass@node:n928"]], mass), "wrong")   # five panels on
        self.assertEqual(self.rate("named", [["mass@node:n301"], ["stiffness@group:z1"]], mass), "wrong")
        self.assertEqual(self.rate("unknown", [], mass), "unknown")
        self.assertEqual(self.rate("named", [["mass@node:n301"]]), "wrong")
        self.assertEqual(self.rate("named", [["swap@channels:c22,c21"]], hidden.Cause("swap", "c21,c22", 1.0)), "right")
        self.assertEqual(rated.rank_of_truth(["mass@node:n928", "stiffness@group:Conc5"], part, published.read_bridge()), 2)


class WithoutData(unittest.TestCase):
    def test_it_says_so_and_runs_nothing(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        done = subprocess.run(
            [sys.executable, BENCH / "matrices.py", BIN, folder / "out", "16", "0"], env=os.environ | {"TWINDECK_DATA": str(folder)}, capture_output=True, text=True, timeout=60,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("not at hand", done.stdout)
        self.assertFalse((folder / "out").exists())

    def test_the_score_counts_each_trial_once(self):
        sound = {"kind": "sound", "rating": "wrong", "form_error_pct": "1"}
        found = sound | {"kind": "mass", "rating": "right"}
        scored = dict(matrices.lines([sound, found, found | {"rating": "none"}]))
        self.assertEqual(scored["sound: alarms"], "1 of 1 (3 to 100 %)")
        self.assertEqual(scored["causes: right"], "1 of 2 (1 to 99 %)")


if __name__ == "__main__":
    unittest.main()
