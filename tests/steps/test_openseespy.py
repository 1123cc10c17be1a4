"""Models of OpenSeesPy and matrices of .npz files as matrix models (python/twindeck/openseespy.py).

Oracle: closed forms of a shear building of two storeys and of a cantilever with a tip mass; the calls that the walker makes of OpenSees are recorded and
answered from those matrices, since openseespy itself is not a Debian package.
"""
import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

try:
    import numpy as np
    import twindeck
    from twindeck import openseespy
except ModuleNotFoundError as missing:  # an interpreter without pandas
    raise unittest.SkipTest(str(missing)) from missing

BIN = pathlib.Path(os.environ["TWINDECK_BIN"]).resolve()


class Recorded:
    """Answers as openseespy.opensees does, and keeps the calls."""

    def __init__(self, dimension, nodes, equations, stiffness, mass):
        self.dimension, self.nodes, self.equations = dimension, nodes, equations
        self.matrices = {(1.0, 0.0, 0.0): mass, (0.0, 0.0, 1.0): stiffness}
        self.calls, self.formed = [], None

    def __getattr__(self, name):
        if name not in ("wipeAnalysis", "system", "numberer", "constraints", "algorithm", "analysis"):
            raise AttributeError(name)
        return lambda *arguments: self.calls.append((name, *arguments))

    def integrator(self, name, *factors):
        self.calls.append(("integrator", name, *factors))
        self.formed = self.matrices[factors]

    def analyze(self, steps, seconds):
        self.calls.append(("analyze", steps, seconds))
        return 0

    def systemSize(self):
        return len(self.formed)

    def printA(self, option):
        assert option == "-ret"
        return [float(v) for row in self.formed for v in row]

    def getNDM(self):
        return [self.dimension]

    def getNodeTags(self):
        return list(self.nodes)

    def nodeCoord(self, node):
        return self.nodes[node]

    def nodeDOFs(self, node):
        return self.equations[node]


def frequencies(folder, count):
    """What step 1 computes of it."""
    out = folder.parent / "s1"
    done = subprocess.run([str(BIN / "s1_model"), "--model", str(folder), "--out", str(out), "--set", f"n_modes={count}"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    with open(out / "modes.csv", encoding="utf-8") as file:
        return [float(row["frequency_Hz"]) for row in csv.DictReader(file)]


def shear_building(k, m):
    """Two storeys: omega² = (3 ± sqrt 5)/2 k/m. OpenSees' frame of two dimensions; rotations and heights are fixed."""
    return Recorded(2, {1: [0.0, 0.0], 2: [0.0, 120.0], 3: [0.0, 240.0]}, {1: [-1, -1, -1], 2: [1, -1, -1], 3: [0, -1, -1]},
                    [[k, -k], [-k, 2 * k]], [[m, 0.0], [0.0, m]])


class OpenSeesPy(unittest.TestCase):
    def test_shear_building_in_kip_and_inches(self):
        # k = 100 kip/in, m = 0.5 kip s2/in
        ops = shear_building(100.0, 0.5)
        with tempfile.TemporaryDirectory() as scratch:
            folder = openseespy.write_openseespy(pathlib.Path(scratch) / "model", ops, length="in", force="kip")
            with open(folder / "dofs.csv", encoding="utf-8") as file:
                dofs = list(csv.DictReader(file))
            self.assertEqual([(row["node"], row["direction"]) for row in dofs], [("3", "x"), ("2", "x")])
            self.assertAlmostEqual(float(dofs[0]["y_m"]), 240 * 0.0254)
            found = frequencies(folder, 2)
        for got, sign in zip(found, (-1.0, 1.0)):
            self.assertAlmostEqual(got, math.sqrt((3.0 + sign * math.sqrt(5.0)) / 2.0 * 200.0) / (2.0 * math.pi), places=6)
        self.assertEqual(ops.calls.count(("wipeAnalysis",)), 3)  # before each matrix, and at the end
        self.assertIn(("system", "FullGeneral"), ops.calls)
        self.assertIn(("constraints", "Transformation"), ops.calls)

    def test_rotations_scale_with_length(self):
        # Cantilever of 2 m with a tip mass of 1 t, E I = 8e3 kN m2: k = 3 E I / L³; in kN and mm. Rotation without inertia.
        ei, l = 8e3 * 1e6, 2000.0
        stiffness = [[12 * ei / l**3, -6 * ei / l**2], [-6 * ei / l**2, 4 * ei / l]]
        ops = Recorded(2, {1: [0.0, 0.0], 2: [2000.0, 0.0]}, {1: [-1, -1, -1], 2: [-1, 0, 1]}, stiffness, [[1e-3, 0.0], [0.0, 0.0]])
        with tempfile.TemporaryDirectory() as scratch:
            found = frequencies(openseespy.write_openseespy(pathlib.Path(scratch) / "model", ops, length="mm", force="kN"), 1)
        # 1 t is 1 kN s2/m, 1e-3 kN s2/mm
        self.assertAlmostEqual(found[0], math.sqrt(3 * 8e6 / 2.0**3 / 1000.0) / (2 * math.pi), places=6)

    def test_matrices_of_an_npz_file(self):
        with tempfile.TemporaryDirectory() as scratch:
            file = pathlib.Path(scratch) / "grillage.npz"
            np.savez(file, K=np.array([[2e6, -1e6], [-1e6, 1e6]]), M=np.diag([1e3, 1e3]), nodes=np.array([[1, 0, 0, 0], [2, 5, 0, 0]]),
                     dofs=np.array([[1, 3], [2, 3]]))
            found = frequencies(openseespy.write_npz(pathlib.Path(scratch) / "model", file, length="m", force="N"), 2)
            self.assertAlmostEqual(found[0], math.sqrt((3 - math.sqrt(5)) / 2 * 1e3) / (2 * math.pi), places=6)
            np.savez(file, K=np.eye(2), M=np.eye(2))
            with self.assertRaisesRegex(twindeck.InputError, "no array 'nodes'"):
                openseespy.write_npz(pathlib.Path(scratch) / "model", file, length="m", force="N")

    def test_refusals(self):
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch) / "model"
            with self.assertRaisesRegex(twindeck.InputError, "length: 'inch' is no unit"):
                openseespy.write_openseespy(folder, shear_building(1.0, 1.0), length="inch", force="N")
            with self.assertRaisesRegex(twindeck.InputError, "no mass"):
                openseespy.write_openseespy(folder, shear_building(1.0, 0.0), length="m", force="N")
            skew = shear_building(1.0, 1.0)
            skew.matrices[(0.0, 0.0, 1.0)] = [[1.0, 0.5], [-0.5, 1.0]]
            with self.assertRaisesRegex(twindeck.InputError, "not symmetric"):
                openseespy.write_openseespy(folder, skew, length="m", force="N")
            lost = shear_building(1.0, 1.0)
            lost.equations[3] = [-1, -1, -1]
            with self.assertRaisesRegex(twindeck.InputError, "equation 0 belongs to no node"):
                openseespy.write_openseespy(folder, lost, length="m", force="N")
            self.assertFalse(folder.exists())


if __name__ == "__main__":
    unittest.main()
