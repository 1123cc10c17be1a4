"""Steps 4 and 6 where frequencies fit and the pairing is wrong: another scale, a reversed or strange channel, twins; and which condition
and state of a folder is looked at.

A chain of eight masses, symmetric about its middle, whose modes are known; features are written from them here. Oracles: the modes that
were written, the factor that was put in, the contract of exit codes and of the manifest.
"""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))
N, K, M = 8, 2e6, 1000.0
MODES = 6


def spring(i, k):
    direction = np.zeros(N)
    if i < N:
        direction[i] = 1.0
    if i > 0:
        direction[i - 1] = -1.0
    return k * np.outer(direction, direction)


PARTS = {"left": [1, 2], "right": [6, 7], "rest": [0, 3, 4, 5, 8]}
PARTS = {name: sum(spring(i, K) for i in which) for name, which in PARTS.items()}


def modes(values=None):
    k = sum((values or {}).get(name, 1.0) * matrix for name, matrix in PARTS.items())
    eigenvalues, vectors = np.linalg.eigh(k / M)
    return np.sqrt(eigenvalues) / (2 * np.pi), vectors / np.abs(vectors).max(axis=0)


def write_matrix(path, matrix):
    entries = [(i + 1, j + 1, matrix[i, j]) for j in range(N) for i in range(j, N) if matrix[i, j] != 0.0]
    path.write_text(f"%%MatrixMarket matrix coordinate real symmetric\n{N} {N} {len(entries)}\n" +
                    "".join(f"{i} {j} {v:.17g}\n" for i, j, v in entries))


def write_model(folder):
    folder.mkdir()
    (folder / "dofs.csv").write_text("dof,node,direction,x_m,y_m,z_m\n" + "".join(f"{i + 1},{i + 1},x,,,\n" for i in range(N)))
    write_matrix(folder / "K0.mtx", PARTS["rest"])
    write_matrix(folder / "M0.mtx", M * np.eye(N))
    text = '[matrices]\nK = "K0.mtx"\nM = "M0.mtx"\n'
    for name in ("left", "right"):
        write_matrix(folder / f"{name}.mtx", PARTS[name])
        text += f'[[parameter]]\nname = "{name}"\nmatrix = "{name}.mtx"\ntarget = "stiffness"\ninitial = 1.0\nlower = 0.4\nupper = 1.6\n'
    (folder / "model.toml").write_text(text)


def write_features(folder, conditions, text=None):
    """conditions: {name: (frequencies, shapes (N x modes), further rows)}."""
    folder.mkdir()
    rows = ["type,mode,channel,condition,value,std"]
    for name, (frequency, shapes, *more) in conditions.items():
        for i, f in enumerate(frequency):
            rows.append(f"frequency_Hz,{i + 1},,{name},{f:.12g},{0.002 * f:.6g}")
            rows += [f"shape,{i + 1},c{d + 1},{name},{shapes[d, i]:.12g},0.01" for d in range(N)]
        rows += more
    (folder / "rows.csv").write_text("\n".join(rows) + "\n")
    (folder / "conditions.toml").write_text(text or "".join(f"[{name}]\n" for name in conditions))
    (folder / "channels.csv").write_text("channel,point,dx,dy,dz\n" + "".join(f"c{d + 1},{d + 1},1,0,0\n" for d in range(N)))
    return folder


def table(path):
    with open(path, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


class OnAChain(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        write_model(self.folder / "model")

    def run_step(self, token, features, *arguments, out="out"):
        done = subprocess.run([BIN / token, "--model", self.folder / "model", "--features", features, "--out", self.folder / out,
                               *map(str, arguments)], capture_output=True, text=True, check=False, cwd=ROOT)
        file = self.folder / out / "manifest.json"
        return done, json.loads(file.read_text()) if done.returncode == 0 else None

    def features(self, frequency, shapes, *more, name="features"):
        return write_features(self.folder / name, {"calm": (frequency[:MODES], shapes[:, :MODES], *more)})


class WhatCannotFool(OnAChain):
    def test_a_sound_measurement_is_taken_without_a_word(self):
        features = self.features(*modes({"left": 0.8, "right": 0.8}))  # symmetric, so that no twin can be blamed in its place
        for token in ("s4_refinement", "s6_updating"):
            done, manifest = self.run_step(token, features, out=token)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual([w for w in manifest["warnings"] if "apart" not in w], [])
            self.assertEqual(manifest["message"], "")
            self.assertIn("0 of 6 measured modes unpaired, worst MAC", done.stderr)
            self.assertNotIn("WARNING", done.stderr)

    def test_a_model_of_another_scale_is_refused_with_the_factor(self):
        frequency, shapes = modes()
        for token in ("s4_refinement", "s6_updating"):
            done, _ = self.run_step(token, self.features(1.85 * frequency, shapes, name=token + "_f"), out=token)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("0.541 times the measured", done.stderr)
            self.assertFalse((self.folder / token).exists())
            self.assertEqual(len([line for line in done.stderr.splitlines() if "warning" not in line]), 1, done.stderr)

    def test_a_mode_that_is_like_none_is_not_paired_however_well_updating_could_fit_it(self):
        """A first mode at 1.85 times the model's, as 3.7 to 2 Hz, whose shape has a MAC of 0.003 with the model's first."""
        frequency, shapes = modes()
        unit = shapes / np.linalg.norm(shapes, axis=0)
        strange = unit[:, N - 1] + 0.055 * unit[:, 0]
        mac = (strange @ unit[:, 0])**2 / (strange @ strange)
        self.assertAlmostEqual(mac, 0.003, delta=0.0005)
        features = write_features(self.folder / "strange", {"calm": (1.85 * frequency[:1], strange[:, None])})
        for token in ("s4_refinement", "s6_updating"):
            done, _ = self.run_step(token, features, out=token)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("only 0 of 1 measured modes are like a computed one (MAC of at least 0.2", done.stderr)
            self.assertIn("unpaired mode 1X", done.stderr)
            self.assertFalse((self.folder / token).exists())

    def test_a_moderate_factor_is_a_warning(self):
        frequency, shapes = modes()
        done, manifest = self.run_step("s4_refinement", self.features(1.2 * frequency, shapes))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(any("0.833 times the measured" in w for w in manifest["warnings"]), manifest["warnings"])

    def test_weight_for_mass_is_guessed(self):
        frequency, shapes = modes()
        done, _ = self.run_step("s4_refinement", self.features(9.80665**0.5 * frequency, shapes))
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("weight in newtons", done.stderr)

    def test_strange_shapes_are_refused(self):
        frequency, _ = modes()
        shapes = np.linalg.qr(np.random.default_rng(3).standard_normal((N, N)))[0]
        done, _ = self.run_step("s6_updating", self.features(frequency, shapes), "--set", "minimum_mac=0.6")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("measured modes are like a computed one", done.stderr)
        done, _ = self.run_step("s6_updating", self.folder / "features", "--set", "minimum_mac=0.6", "--set", "least_paired=0")
        self.assertNotIn("expected a share", done.stderr)

    def test_a_reversed_channel_ends_in_a_warning(self):
        frequency, shapes = modes({"left": 0.8})
        shapes = shapes.copy()
        shapes[3] *= -1.0  # a share of 0.22, 0.17 and 0.17 of modes 1, 3 and 6: MACs of 0.32 and 0.44
        for token in ("s4_refinement", "s6_updating"):
            done, manifest = self.run_step(token, self.features(frequency, shapes, name=token + "_f"), out=token)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("WARNING: shapes disagree", done.stderr)
            self.assertTrue(any("shapes disagree" in w for w in manifest["warnings"]), manifest["warnings"])
            self.assertIn("shapes disagree", manifest["message"])
            self.assertTrue(any(w.startswith("channel c4 seems to be reversed") for w in manifest["warnings"]), manifest["warnings"])

    def test_a_reversed_channel_is_named_where_every_pair_still_agrees(self):
        frequency, shapes = modes({"left": 0.8, "right": 0.8})
        shapes = shapes.copy()
        shapes[0] *= -1.0  # the mass beside the wall moves little in modes 1 and 2: MACs of 0.91 and 0.68
        done, manifest = self.run_step("s4_refinement", write_features(self.folder / "two", {"calm": (frequency[:2], shapes[:, :2])}))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertFalse(any("shapes disagree" in w for w in manifest["warnings"]), manifest["warnings"])
        self.assertTrue(any(w.startswith("channel c1 seems to be reversed") for w in manifest["warnings"]), manifest["warnings"])

    def test_a_mode_that_is_none_stays_unpaired(self):
        frequency, shapes = modes()
        spurious = 0.5 * (frequency[1] + frequency[2])
        odd = modes()[1][:, 7]  # the shape of mode 8, far away in frequency
        more = [f"frequency_Hz,extra,,calm,{spurious:.9g},0.01"] + [f"shape,extra,c{d + 1},calm,{odd[d]:.9g},0.01" for d in range(N)]
        done, manifest = self.run_step("s4_refinement", self.features(frequency, shapes, *more), "--set", "n_modes=8")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1 of 7 measured modes unpaired", done.stderr)
        pairs = [f'{r["experimental_mode"]}-{r["numerical_mode"]}' for r in table(self.folder / "out" / "pairs.csv")]
        self.assertEqual(pairs, [f"{i}X-{i}N" for i in range(1, MODES + 1)])
        self.assertEqual(manifest["warnings"], [])

    def test_twins_of_a_symmetric_model_are_named(self):
        done, manifest = self.run_step("s6_updating", self.features(*modes({"left": 0.6})))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(any("left, right apart" in w for w in manifest["warnings"]), manifest["warnings"])
        found = {row["parameter"]: float(row["final_value"]) for row in table(self.folder / "out" / "parameters.csv")}
        if found["right"] < 0.99:  # the wrong twin was blamed, with frequencies that fit to the last digit: only the shapes tell
            self.assertIn("shapes disagree after the updating", "".join(manifest["warnings"]))

    def test_one_parameter_has_no_twin(self):
        done, manifest = self.run_step("s6_updating", self.features(*modes({"left": 0.6})), "--set", "parameters=['left']")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(manifest["warnings"], [])


class ConditionsAndStates(OnAChain):
    def two_states(self):
        before, after = modes(), modes({"left": 0.6})
        return write_features(self.folder / "states", {name: (f[:MODES], s[:, :MODES]) for name, (f, s) in
                                                       {"a_after": after, "before": before}.items()},
                              '[before]\ntemperature_C = 10\n[a_after]\nstate = "repaired"\n')

    def measured(self, out="out"):
        return float(table(self.folder / out / "comparison.csv")[0]["measured_Hz"])

    def test_the_reference_state_is_the_default(self):
        done, _ = self.run_step("s4_refinement", self.two_states())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(self.measured(), modes()[0][0], places=6)

    def test_state_and_condition_choose(self):
        features = self.two_states()
        for arguments in (("--state", "repaired"), ("--condition", "a_after"), ("--condition", "a_after", "--state", "repaired")):
            done, _ = self.run_step("s4_refinement", features, *arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertAlmostEqual(self.measured(), modes({"left": 0.6})[0][0], places=6)

    def test_unknown_names_list_what_there_is(self):
        features = self.two_states()
        for token in ("s4_refinement", "s6_updating", "s9_diagnosis"):
            for arguments, words in ((("--condition", "befor"), ("befor", "before", "a_after")), (("--state", "new"), ("new", "reference", "repaired")),
                                     (("--condition", "before", "--state", "repaired"), ("before", "reference", "repaired"))):
                done, _ = self.run_step(token, features, *arguments, "--quiet")
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                for word in words:
                    self.assertIn(word, done.stderr)

    def test_several_conditions_without_dampers_are_listed_without_a_word_of_dampers(self):
        frequency, shapes = modes()
        one = (frequency[:MODES], shapes[:, :MODES])
        done, _ = self.run_step("s6_updating", write_features(self.folder / "days", {"cold": one, "warm": one}))
        self.assertEqual(done.returncode, 2)
        self.assertIn("cold, warm", done.stderr)
        self.assertNotIn("damper", done.stderr)

    def test_without_dampers_is_still_the_default_where_there_are_some(self):
        frequency, shapes = modes()
        one, other = (frequency[:MODES], shapes[:, :MODES]), (1.01 * frequency[:MODES], shapes[:, :MODES])
        features = write_features(self.folder / "dampers", {"free": other, "held": one}, '[free]\ndampers = "off"\n[held]\ndampers = "on"\n')
        done, _ = self.run_step("s4_refinement", features)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(self.measured(), 1.01 * frequency[0], places=6)


if __name__ == "__main__":
    unittest.main()
