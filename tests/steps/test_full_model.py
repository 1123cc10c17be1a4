"""Step 1 on the study at full size. Oracles: SciPy's eigenvalues of the exported matrices, the paper's 27,093 degrees of freedom, and
arithmetic between rows of one table."""

import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class FullModel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        done = subprocess.run(
            [BIN / "s1_model", "--study", "workflows/ponte_del_mare", "--out", cls.folder / "s1_model", "--export-matrices", "--quiet",
             "--set", 'meshes=["coarse"]'], cwd=ROOT, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        cls.out = cls.folder / "s1_model"
        cls.summary = {r["quantity"]: int(r["value"]) for r in table(cls.out / "summary.csv")}

    def test_scipy_finds_the_same_frequencies(self):
        try:
            import scipy.io
            import scipy.sparse.linalg
        except ImportError:
            self.skipTest("SciPy is not installed")
        stiffness, mass = (scipy.io.mmread(self.out / name).tocsc() for name in ("K.mtx", "M.mtx"))
        self.assertEqual(stiffness.shape[0], self.summary["degrees_of_freedom"])
        values = sorted(scipy.sparse.linalg.eigsh(stiffness, 13, mass, sigma=0.0, return_eigenvectors=False))
        ours = [float(r["frequency_Hz"]) for r in table(self.out / "modes.csv")]
        for value, frequency in zip(values, ours):
            self.assertAlmostEqual(value**0.5 / 6.283185307179586 / frequency, 1.0, delta=1e-5)

    def test_summary_counts_every_part(self):
        self.assertGreaterEqual(self.summary["degrees_of_freedom"], 27000)
        for part in ("decks", "end_blocks", "mast", "piers", "ramps", "stays"):
            self.assertGreater(self.summary["nodes_" + part], 0, part)
        for kind in ("beams", "shells", "solids", "stays", "springs"):
            parts = [n for quantity, n in self.summary.items() if quantity.startswith(kind + "_")]
            self.assertGreater(self.summary[kind], 0)
            self.assertEqual(sum(parts), self.summary[kind], kind)

    def test_mesh_convergence_compares_with_the_study_mesh(self):
        rows = table(self.out / "mesh_convergence.csv")
        self.assertEqual({r["mesh"] for r in rows}, {"", "coarse"})
        own = {r["mode"]: float(r["frequency_Hz"]) for r in rows if r["mesh"] == ""}
        for row in rows:
            if row["frequency_Hz"]:
                change = 100 * (float(row["frequency_Hz"]) / own[row["mode"]] - 1)
                self.assertAlmostEqual(float(row["change_pct"]), change, places=6)


if __name__ == "__main__":
    unittest.main()
