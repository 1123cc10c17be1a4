"""The IASC-ASCE benchmark frame (workflows/iasc_asce, tests/blind/exam): its generator, its scorer and the baselines beside it.

Oracles. Frequencies and losses of storey stiffness that are published of the benchmark (Johnson et al. 2004; Black and Ventura 1998), printed to 0.01 Hz and 0.1 %: within 0.1 %
for 12 degrees of freedom and for 120. Records: RMS of a mode of unit mass under a white load by the closed form, noise by its definition. Rating: answers written by hand. Baselines:
modes computed without noise, from which least squares must give the shares back and falsification must leave the truth standing. Intervals: closed
forms at 0 and n of n. losses.csv is what its script writes.
"""
import csv
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
EXAM = ROOT / "tests" / "blind" / "exam"
sys.path[:0] = [str(ROOT / "workflows" / "iasc_asce"), str(EXAM), str(ROOT / "tests" / "blind" / "baselines")]
import answers  # noqa: E402
import exam  # noqa: E402
import frame  # noqa: E402
import intervals  # noqa: E402
import losses  # noqa: E402
import make_inputs  # noqa: E402
import records  # noqa: E402
from changed_parts import Change  # noqa: E402
from falsification import not_falsified  # noqa: E402
from least_squares import fit_shares  # noqa: E402
from measured_modes import Mode  # noqa: E402

PUBLISHED_HZ = {
    1: (9.41, 25.54, 38.66, 48.01, 11.79, 32.01, 48.44, 60.15, 16.38, 44.64, 67.48, 83.62),
    2: (8.59, 23.45, 36.81, 46.98, 9.18, 25.95, 42.21, 56.74, 14.58, 40.65, 62.96, 81.05),
}
# (pattern, storey) -> loss of its stiffness along x and y [%]
PUBLISHED_LOSS = {
    (1, 1): (45.2, 71.0), (2, 1): (45.2, 71.0), (2, 3): (45.2, 71.0), (3, 1): (0.0, 17.8), (4, 1): (0.0, 17.8), (4, 3): (11.3, 0.0), (6, 1): (0.0, 5.9),
}


def storey_stiffness(damage, storey):
    """Along x and y: what couples a floor to the one below."""
    stiffness, _ = frame.stiffness_and_mass(1, damage)
    at = 3 * (storey - 1)
    if storey > 1:
        return np.array([-stiffness[at + k, at - 3 + k] for k in (0, 1)])
    return np.array([stiffness[at + k, at + k] + stiffness[at + k, at + 3 + k] for k in (0, 1)])


def exact_modes(case, damage, std=0.001):
    """Modes of the truth as an identification without error would give them."""
    found = losses.seen(case, damage)
    return [
        Mode(f, std * f, shape, np.full(16, 0.002), np.zeros(16), np.full(16, 0.002)) for f, shape in zip(found.frequencies_Hz, found.shapes.T)
    ]


def answer(verdict, *effects):
    return {"verdict": verdict, "effects": [
        {"cause": "stiffness", "location": location, "cluster": list(cluster), "state": "after", "probability": 0.9,
         "parameters": [{"name": "factor", "value": factor, "low": 0.0, "high": 1.0, "level": 0.9}]} for location, factor, cluster in effects
    ]}


class Generator(unittest.TestCase):
    def test_frequencies_are_the_published_ones(self):
        for case, published in PUBLISHED_HZ.items():
            found = frame.modes(case, frame.Damage())
            for hertz in published:
                nearest = found.frequencies_Hz[np.argmin(np.abs(found.frequencies_Hz - hertz))]
                self.assertLess(abs(nearest / hertz - 1.0), 0.001, f"case {case}: {hertz} Hz, nearest {nearest}")

    def test_each_pattern_takes_the_published_share_of_a_storey(self):
        for pattern in range(1, 7):
            for storey in range(1, frame.FLOORS + 1):
                damage = frame.PATTERNS[pattern]
                lost = 100.0 * (1.0 - storey_stiffness(damage, storey) / storey_stiffness(frame.Damage(), storey))
                published = PUBLISHED_LOSS.get((4 if pattern == 5 else pattern, storey), (0.0, 0.0))
                np.testing.assert_allclose(lost, published, atol=0.06, err_msg=f"pattern {pattern}, storey {storey}")

    def test_the_hinged_beam_is_felt_only_where_nodes_turn(self):
        same = [frame.modes(case, frame.PATTERNS[p]).frequencies_Hz[:12] for case in (1, 2) for p in (4, 5)]
        np.testing.assert_allclose(same[0], same[1], rtol=1e-10)
        self.assertGreater(np.max(np.abs(same[2] / same[3] - 1.0)), 1e-4)

    def test_a_cut_brace_keeps_its_mass(self):
        np.testing.assert_allclose(frame.stiffness_and_mass(1, frame.PATTERNS[2])[1], frame.stiffness_and_mass(1, frame.Damage())[1], rtol=1e-14)

    def test_records_have_the_variance_of_a_white_load(self):
        # Motion of the roof along y in case 1 without its high modes' share above the load's limit: sum over modes of a load of density S on each floor gives
        # the variance S pi f / (4 zeta) phi^2 (sum of phi_load^2) a mode; 40 s of four modes leave some 10 % of it, and cross terms of modes are small.
        found = frame.modes(1, frame.Damage())
        density = 2.0 * records.LOAD_N**2 / records.RATE_HZ
        push = ((records.load_shapes(1).T @ found.floors) ** 2).sum(axis=0)
        at = frame.at_sensors(found.floors)[-1] ** 2
        below = found.frequencies_Hz < 90.0
        expected = np.sqrt(np.sum((density * np.pi * found.frequencies_Hz / (4.0 * frame.DAMPING) * push * at)[below]))
        measured = np.sqrt(np.mean(records.accelerations(1, 0, np.random.default_rng(3))[:, -1] ** 2))
        self.assertLess(abs(measured / expected - 1.0), 0.25)

    def test_the_same_seed_gives_the_same_records(self):
        one, same, other = (records.accelerations(4, 3, np.random.default_rng(seed)) for seed in (5, 5, 6))
        self.assertTrue(np.array_equal(one, same))
        self.assertFalse(np.array_equal(one, other))


class Losses(unittest.TestCase):
    def test_the_committed_table_is_what_the_script_writes(self):
        text = io.StringIO()
        writer = csv.DictWriter(text, losses.HEADER, lineterminator="\n")
        writer.writeheader()
        writer.writerows(losses.table(cases=(1,)))
        committed = (EXAM / "losses.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(text.getvalue().splitlines(), [line for line in committed if line[0] in "c1"])

    def test_nothing_along_x_is_visible_where_the_load_is_along_y(self):
        for (case, _), rows in answers.read_losses(EXAM / "losses.csv").items():
            for row in rows:
                self.assertEqual(row["visible"] == "1", case > 2 or row["face"][0] == "x", row)


class Rating(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        make_inputs.write_model(folder)
        cls.faces = answers.Faces(folder)
        cls.rows = answers.read_losses(EXAM / "losses.csv")

    def rate(self, case, pattern, told):
        return answers.rate(told, self.rows.get((case, pattern), []), self.faces)[0]

    def test_damaged(self):
        right = ("group:braces_1_x2", 0.5, ())
        self.assertEqual(self.rate(3, 3, answer("named", right)), "complete")
        self.assertEqual(self.rate(3, 3, answer("named", ("group:braces_1_x0", 0.5, ()))), "wrong")
        self.assertEqual(self.rate(3, 3, answer("named", ("group:braces_1_x2", 1.5, ()))), "wrong")
        self.assertEqual(self.rate(3, 4, answer("named", right)), "half")
        self.assertEqual(self.rate(1, 4, answer("named", right)), "complete")  # the other is along x
        self.assertEqual(self.rate(3, 4, answer("named", right, ("group:braces_3_y0", 0.5, ()))), "complete")
        self.assertEqual(self.rate(3, 3, answer("named", right, ("group:braces_2_y0", 0.9, ()))), "wrong")
        wide = tuple(f"stiffness@group:braces_{s}_x0" for s in (1, 2, 3, 4))
        self.assertEqual(self.rate(3, 3, answer("ambiguous", ("group:braces_1_x2", 0.5, wide[:3]))), "complete")
        self.assertEqual(self.rate(3, 3, answer("ambiguous", ("group:braces_1_x2", 0.5, wide))), "half")
        self.assertEqual(self.rate(3, 3, answer("unknown", right)), "unknown")
        storey = "group:" + ",".join(f"braces_1_{face}" for face in frame.ALL_FACES)
        self.assertEqual(self.rate(3, 1, answer("named", (storey, 0.1, ()))), "complete")
        self.assertEqual(self.rate(3, 3, answer("named", (storey, 0.9, ()))), "wrong")
        # A brace is a spring between two floors: one that is missing in the later state says the same.
        tie = {"cause": "tie", "location": "nodes:3,15", "cluster": [], "state": "before", "probability": 0.9, "parameters": [{"name": "stiffness_N_m", "value": 1e7}]}
        self.assertEqual(self.rate(3, 3, {"verdict": "named", "effects": [tie]}), "complete")
        self.assertEqual(self.rate(3, 3, {"verdict": "named", "effects": [tie | {"state": "after"}]}), "wrong")

    def test_sound(self):
        self.assertEqual(self.rate(3, 0, answer("none")), "none")
        self.assertEqual(self.rate(3, 0, answer("named", ("group:braces_1_x2", 0.9, ()))), "wrong")

    def test_exact_intervals(self):
        self.assertAlmostEqual(intervals.exact_interval(0, 20)[1], 1.0 - 0.025 ** (1.0 / 20.0))
        self.assertAlmostEqual(intervals.exact_interval(20, 20)[0], 0.025 ** (1.0 / 20.0))


class Baselines(unittest.TestCase):
    def test_least_squares_gives_the_shares_back(self):
        change = Change.of(exam.structure(), exact_modes(3, frame.Damage()), exact_modes(3, frame.PATTERNS[4]))
        shares, _ = fit_shares(change)
        expected = [1.0 - 0.5 * (part in ((1, "x2"), (3, "y0"))) for part in exam.PARTS]
        np.testing.assert_allclose(shares, expected, atol=0.02)

    def test_falsification_keeps_the_truth(self):
        before = exact_modes(3, frame.Damage())
        change = Change.of(exam.structure(), before, exact_modes(3, frame.PATTERNS[3]))
        self.assertIn((exam.PARTS.index((1, "x2")),), not_falsified(change, exam.predictions()))
        self.assertIn((), not_falsified(Change.of(exam.structure(), before, before), exam.predictions()))


class Chain(unittest.TestCase):
    """One pair through steps 3 and 9; step 9 with stiffness as its only cause, two modes a state and real shapes, which is what a test has time for."""

    def test_a_pair_is_examined(self):
        out = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        catalogue = out / "catalogue"
        catalogue.mkdir()
        source = ROOT / "workflows" / "common" / "hypotheses" / "stiffness.toml"
        (catalogue / source.name).write_text(source.read_text(encoding="utf-8"), encoding="utf-8")
        done = subprocess.run(
            [sys.executable, EXAM / "exam.py", BIN, out, "1", "1", "--cases", "3", "--patterns", "3", "--set", f'catalogue="{catalogue}"',
             "--set", 'left_out=["shape_imag","damping_ratio_pct"]', "--set", "highest_frequency=30", "--set", "most_causes=1"],
            capture_output=True, text=True, timeout=600,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out / "exam_1_1.csv", newline="", encoding="utf-8") as stream:
            row = next(csv.DictReader(stream))
        self.assertIn(row["rating"], ("complete", "half", "wrong", "unknown", "none"))
        self.assertEqual(row["squares_located"], "1")
        self.assertGreaterEqual(int(row["modes_after"]), 6)
        self.assertIn("1 pairs", (out / "exam_1_1.md").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
