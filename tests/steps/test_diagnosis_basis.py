"""Step 9: how many modes the reduced basis has, what the full model is held against, and which state the extended model is of.

Oracles: modes of the whole matrices by NumPy; a sound structure, in which nothing may be found; a mass that was taken away and is therefore
in no model of the structure as it is now.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import test_diagnosis as chain  # noqa: E402

MASSES, MEASURED = 40, 6
SPRING, MASS, BODY = 2e6, 1000.0, 5.0


def matrices(bodies):
    """A row of masses between two walls. Light bodies hang on it by soft springs and swing below its first mode of 0.55 Hz."""
    n = MASSES + bodies
    stiffness, mass = np.zeros((n, n)), np.diag([MASS] * MASSES + [BODY] * bodies)

    def tie(k, direction):
        stiffness[:] += k * np.outer(direction, direction)

    for s in range(MASSES + 1):
        direction = np.zeros(n)
        direction[s - 1 if s > 0 else s] -= 1.0 if s > 0 else 0.0
        if s < MASSES:
            direction[s] += 1.0
        tie(SPRING, direction)
    for i, frequency in enumerate(np.linspace(0.1, 0.4, bodies)):
        direction = np.zeros(n)
        direction[i % MASSES], direction[MASSES + i] = 1.0, -1.0
        tie(BODY * (2 * np.pi * frequency) ** 2, direction)
    return stiffness, mass


def lower(path, matrix):
    entries = [(i + 1, j + 1, matrix[i, j]) for j in range(len(matrix)) for i in range(j, len(matrix)) if matrix[i, j] != 0.0]
    path.write_text(f"%%MatrixMarket matrix coordinate real symmetric\n{len(matrix)} {len(matrix)} {len(entries)}\n" +
                    "".join(f"{i} {j} {v:.17g}\n" for i, j, v in entries))


def write_row(folder, bodies):
    """The model as it is, and what is measured of it. @return frequencies of the measured modes"""
    stiffness, mass = matrices(bodies)
    model, features = folder / "model", folder / "features"
    model.mkdir()
    features.mkdir()
    lower(model / "K.mtx", stiffness)
    lower(model / "M.mtx", mass)
    (model / "model.toml").write_text('[matrices]\nK = "K.mtx"\nM = "M.mtx"\n')
    (model / "dofs.csv").write_text("dof,node,direction,x_m,y_m,z_m\n" + "".join(f"{i + 1},{i + 1},x,,,\n" for i in range(len(mass))))
    root = 1.0 / np.sqrt(np.diag(mass))
    values, vectors = np.linalg.eigh(root[:, None] * stiffness * root[None, :])
    hertz, shapes = np.sqrt(values) / (2 * np.pi), root[:, None] * vectors
    own = [m for m in range(len(hertz)) if hertz[m] > 0.45][:MEASURED]  # of the row, above those of the bodies
    channels = range(2, MASSES, 4)
    random = np.random.default_rng(3)
    rows = ["type,mode,channel,condition,value,std"]
    for name, m in enumerate(own, 1):
        rows.append(f"frequency_Hz,{name},,calm,{hertz[m] * (1 + 0.001 * random.standard_normal()):.10g},{0.001 * hertz[m]:.6g}")
        shape = shapes[list(channels), m] / np.abs(shapes[list(channels), m]).max()
        rows += [f"shape,{name},c{c + 1},calm,{y + 0.02 * random.standard_normal():.10g},0.02" for c, y in zip(channels, shape)]
    (features / "rows.csv").write_text("\n".join(rows) + "\n")
    (features / "conditions.toml").write_text("[calm]\n")
    (features / "channels.csv").write_text("channel,point,dx,dy,dz\n" + "".join(f"c{c + 1},{c + 1},1,0,0\n" for c in channels))
    return hertz[own]


class Basis(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def run_step(self, *arguments):
        out = self.folder / "out"
        done = subprocess.run([chain.BIN / "s9_diagnosis", "--model", self.folder / "model", "--features", self.folder / "features", "--out", out,
                               "--catalogue", chain.ROOT / "workflows/common/hypotheses", *arguments],
                              capture_output=True, text=True, check=False)
        return done, out

    def test_it_reaches_modes_that_many_bodies_stand_below(self):
        hertz = write_row(self.folder, 30)
        done, out = self.run_step()
        self.assertEqual(done.returncode, 0, done.stderr)
        result = json.loads((out / "diagnosis.json").read_text())
        self.assertEqual(result["verdict"], "none", result["message"])
        checked = result["full_model"]
        self.assertEqual(len(checked["frequency_Hz"]), MEASURED)  # the measured modes, not the lowest, which are the bodies'
        np.testing.assert_allclose(checked["frequency_Hz"], hertz, rtol=0.02)  # masses and springs may scatter
        self.assertLess(checked["largest_deviation_pct"], 0.1)
        self.assertFalse([w for w in json.loads((out / "manifest.json").read_text())["warnings"] if "basis" in w])

    def test_it_ends_where_no_basis_reaches(self):
        write_row(self.folder, 210)
        done, _ = self.run_step()
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(done.stderr, r"has more than 200 modes below 4\.\d+ Hz")
        self.assertIn("highest_frequency", done.stderr)


class StateOfTheModel(unittest.TestCase):
    def test_a_mass_that_was_taken_away_is_in_no_model_of_the_last_state(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        chain.write_model(folder / "model")
        features = folder / "features"
        chain.write_features(features, seed=1, mass={3: 600.0})
        chain.write_features(folder / "later", seed=1)
        before = (features / "rows.csv").read_text()
        later = (folder / "later" / "rows.csv").read_text().split("\n", 1)[1].replace(",calm,", ",later,")
        (features / "rows.csv").write_text(before + later)
        (features / "conditions.toml").write_text('[calm]\n[later]\nstate = "later"\n')
        out = folder / "out"
        done = subprocess.run([chain.BIN / "s9_diagnosis", "--model", folder / "model", "--features", features, "--out", out,
                               "--catalogue", chain.ROOT / "workflows/common/hypotheses"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        effect = json.loads((out / "diagnosis.json").read_text())["effects"][0]
        self.assertEqual((effect["cause"], effect["location"], effect["state"]), ("mass", "node:3", "reference"))
        extension = tomllib.loads((out / "extended_model" / "extension.toml").read_text())
        self.assertEqual(extension["state"], "later")
        self.assertEqual((extension["cause"][0]["acts"], extension["cause"][0]["in_model"]), ("state reference", False))
        warnings = json.loads((out / "manifest.json").read_text())["warnings"]
        self.assertTrue(any("that of state later" in w and "mass@node:3" in w for w in warnings), warnings)
        entries = [line.split() for line in (out / "extended_model" / "M0.mtx").read_text().splitlines()[2:]]
        self.assertEqual({float(value) for *_, value in entries}, {1000.0})


if __name__ == "__main__":
    unittest.main()
