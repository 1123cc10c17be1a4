"""The bench of the whole chain (tests/blind/chain): its truths, what seeds hide, its folders and its rating.

Oracles. Euler-Bernoulli beam on two supports: f_n = (n pi / L)^2 sqrt(E I / m) / 2 pi, 0.2 % with six pieces of consistent mass; Timoshenko's first correction, by
(1 + E/(kappa G) (n pi r / L)^2)^-1/2 without rotary inertia; a string, c / 2 L. The engineer's model computed by the program against the plan by the bench's own code: 0.2 % without rotary inertia (both are
the same Euler-Bernoulli frame, by two codes). Rating: answers written by hand.
"""
import csv
import dataclasses
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
BENCH = ROOT / "tests" / "blind" / "chain"
sys.path[:0] = [str(BENCH), str(BENCH.parent / "exam")]
import chain  # noqa: E402
import folders  # noqa: E402
import hidden  # noqa: E402
import plane  # noqa: E402
import rated  # noqa: E402
import structures  # noqa: E402

LENGTH, AREA, INERTIA, YOUNG, DENSITY = 10.0, 0.02, 2e-4, 2.1e11, 7850.0


def line(pieces, held, **sizes):
    """A straight member along x in equal pieces, as a truth."""
    nodes = {i + 1: (LENGTH * i / pieces, 0.0) for i in range(pieces + 1)}
    member = plane.Member((1, 2), "line", AREA, INERTIA, YOUNG, DENSITY)
    members = [dataclasses.replace(member, ends=(i + 1, i + 2), **sizes) for i in range(pieces)]
    plan = plane.Plan("line", nodes, members, held, [], [], [], LENGTH)
    return plane.Truth(nodes, members, plan)


class Truths(unittest.TestCase):
    def test_a_beam_on_two_supports(self):
        found, _ = plane.modes(line(6, {1: "xz", 7: "z"}), 1e4)
        for n in (1, 2):
            exact = (n * math.pi / LENGTH) ** 2 * math.sqrt(YOUNG * INERTIA / (DENSITY * AREA)) / (2.0 * math.pi)
            self.assertLess(min(abs(found / exact - 1.0)), 0.002)

    def test_shear_makes_it_softer_as_timoshenko_says(self):
        shear_area = 0.004
        found, _ = plane.modes(line(12, {1: "xz", 13: "z"}, shear_area=shear_area), 1e4)
        slow, _ = plane.modes(line(12, {1: "xz", 13: "z"}), 1e4)
        softer = YOUNG * INERTIA / (YOUNG / 2.6 * shear_area) * (math.pi / LENGTH) ** 2
        self.assertLess(abs(found[0] / slow[0] * math.sqrt(1.0 + softer) - 1.0), 0.001)

    def test_a_stay_swings_as_a_string(self):
        pull = 1e6
        found, _ = plane.modes(line(12, {1: "xz", 13: "xz"}, inertia=0.0, pull=pull), 50.0)
        self.assertLess(abs(found[0] / (math.sqrt(pull / (DENSITY * AREA)) / (2.0 * LENGTH)) - 1.0), 0.005)

    def test_the_truth_is_another_class_but_the_same_structure(self):
        for make in structures.STRUCTURES:
            random = np.random.default_rng(3)
            plan = make(random)
            truth = plane.truth_of(plan, random)
            planned, _ = plane.modes(plane.Truth(plan.nodes, plan.members, plan), 1e4)
            found, _ = plane.modes(truth, 1e4)
            error = min(abs(found / planned[0] - 1.0))
            self.assertGreater(error, 1e-4, plan.name)
            self.assertLess(error, 0.15, plan.name)


class Hidden(unittest.TestCase):
    def test_forty_seeds_hold_everything_and_repeat(self):
        drawn = {(trial.plan.name, trial.kind) for trial in map(hidden.hide, range(40))}
        self.assertEqual(len(drawn), 4 * len(set(hidden.KINDS)))
        one, same = hidden.hide(6), hidden.hide(6)
        self.assertEqual([(c.kind, c.place, c.size, c.sigma) for c in one.causes], [(c.kind, c.place, c.size, c.sigma) for c in same.causes])

    def test_a_cause_acts_in_its_own_conditions_alone(self):
        trial = hidden.hide(6)  # a mass on the frame, between two states
        self.assertEqual(trial.kind, "change")
        first, second = (plane.modes(trial.structure(acts, None), trial.highest_Hz)[0] for *_, acts in trial.conditions())
        sound = plane.modes(trial.truth, trial.highest_Hz)[0]
        np.testing.assert_array_equal(first, sound)
        self.assertLess(second[0], sound[0])

    def test_a_fault_of_a_sensor_is_in_every_record_of_it(self):
        trial = hidden.hide(16)  # polarity
        self.assertEqual(trial.causes[0].kind, "polarity")
        samples = np.ones((3, len(trial.plan.sensors)))
        self.assertEqual(folders.faulty(trial, samples).sum(), 3 * (len(trial.plan.sensors) - 2))


class Folders(unittest.TestCase):
    def test_the_program_computes_the_plan(self):
        for seed, make in enumerate(structures.STRUCTURES):
            folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
            plan = make(np.random.default_rng(seed))
            folders.write_model(folder / "model", plan)
            file = folder / "model" / "model.toml"
            file.write_text(file.read_text(encoding="utf-8").replace("[formulation]\n", "[formulation]\nbeam_rotary_inertia = false\n"), encoding="utf-8")
            done = subprocess.run([BIN / "s1_model", "--model", folder / "model", "--out", folder / "s1", "--quiet", "--set", "n_modes=6"], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(folder / "s1" / "modes.csv", newline="", encoding="utf-8") as stream:
                computed = [float(row["frequency_Hz"]) for row in csv.DictReader(stream)]
            expected, _ = plane.modes(plane.Truth(plan.nodes, [dataclasses.replace(m, shear_area=0.0, pull=0.0) for m in plan.members], plan), 1e4)
            if plan.name in ("girder", "frame"):  # of bars alone, or with bars, the program lumps masses or has no transverse one
                np.testing.assert_allclose(computed, expected[:6], rtol=0.002, err_msg=plan.name)
            else:
                np.testing.assert_allclose(computed[:3], expected[:3], rtol=0.1, err_msg=plan.name)

    def test_a_trial_goes_through_step_3(self):
        out = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        done = subprocess.run([sys.executable, BENCH / "chain.py", BIN, out, "1", "2", "--no-diagnosis"], capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out / "chain_2_1.csv", newline="", encoding="utf-8") as stream:
            row = next(csv.DictReader(stream))
        self.assertEqual((row["structure"], row["kind"], row["rating"]), ("frame", "sound", ""))
        self.assertGreaterEqual(int(row["modes"]), 5)


class Rating(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.plan = structures.girder(np.random.default_rng(1))
        folders.write_model(cls.folder, cls.plan)
        cls.places = rated.Places(cls.folder)

    def rate(self, verdict, entries, *causes):
        effects = [dict(zip(("cause", "location", "cluster"), (*entry[0].split("@"), list(entry[1:])))) for entry in entries]
        return rated.rate({"verdict": verdict, "effects": effects}, list(causes), self.places, self.plan.length)[0]

    def test_by_hand(self):
        zone = hidden.Cause("stiffness", "zone_05", 0.5, 40.0)
        mass = hidden.Cause("mass", "18", 4000.0, 30.0)
        faint = hidden.Cause("mass", "18", 4000.0, 2.0)
        self.assertEqual(self.rate("named", [["stiffness@group:zone_05"]], zone), "right")
        self.assertEqual(self.rate("named", [["joint@element:10"]], zone), "right")
        self.assertEqual(self.rate("named", [["stiffness@group:zone_06"]], zone), "right")  # the zone beside it
        self.assertEqual(self.rate("named", [["stiffness@group:zone_11"]], zone), "wrong")
        self.assertEqual(self.rate("named", [["mass@node:10"]], zone), "wrong")
        self.assertEqual(self.rate("ambiguous", [["mass@node:10", "stiffness@group:zone_05"]], zone), "right")
        self.assertEqual(self.rate("named", [["stiffness@group:zone_05"]], zone, mass), "part")
        self.assertEqual(self.rate("named", [["stiffness@group:zone_05"]], zone, faint), "right")
        self.assertEqual(self.rate("named", [["stiffness@group:zone_05"], ["mass@node:18"]], zone, mass), "right")
        self.assertEqual(self.rate("named", [["stiffness@group:zone_05"], ["osc@node:2"]], zone), "wrong")
        self.assertEqual(self.rate("unknown", [["stiffness@group:zone_05"]], zone), "unknown")
        self.assertEqual(self.rate("named", [["stiffness@group:zone_05"]]), "wrong")
        swap = hidden.Cause("swap", "n3_z,n7_z", 1.0, 50.0)
        self.assertEqual(self.rate("named", [["swap@channels:n3_z,n7_z"]], swap), "right")
        self.assertEqual(self.rate("named", [["swap@channels:n3_z,n9_z"]], swap), "wrong")

    def test_rows_that_were_not_diagnosed_are_not_scored(self):
        row = {"kind": "sound", "visible": "0", "rating": "", "structure": "girder"}
        self.assertEqual(set(value for _, value in chain.lines([row])), {"-"})
        self.assertEqual(dict(chain.lines([row | {"rating": "none"}]))["sound: alarms"], "0 of 1 (0 to 98 %)")


if __name__ == "__main__":
    unittest.main()
