"""A user's own model through s1_model: the good one gives the textbook's frequencies, each bad one is one clear line and changes nothing.

Oracles: the clamped beam's closed form f = (beta L)^2 / (2 pi L^2) sqrt(EI / (rho A)) with cos(x) cosh(x) = -1 (Blevins 1979, table 8-1);
a dense eigensolution of the exported matrices; the command line contract (exit code 2, one line, earlier results untouched).
"""
import csv
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))

LENGTH, WIDTH, HEIGHT, E, NU, RHO, BEAMS = 10.0, 0.2, 0.4, 210e9, 0.3, 7850.0, 4
CLAMPED_ROOTS = (1.875104068711961, 4.694091132974174)  # of cos(x) cosh(x) = -1


def table(folder, name, header, rows):
    lines = [header] + [",".join(str(cell) for cell in row) for row in rows]
    (folder / name).write_text("\n".join(lines) + "\n")


def write_cantilever(folder):
    """Four beams along X, clamped at node 1: strong axis y, weak axis z."""
    folder.mkdir(parents=True)
    area = WIDTH * HEIGHT
    (folder / "model.toml").write_text('title = "cantilever"\n\n[[parameter]]\nname = "E"\ntarget = "youngs_modulus"\nof = ["steel"]\n'
                                       f'unit = "Pa"\ninitial = {E}\nlower = {0.9 * E}\nupper = {1.1 * E}\n')
    table(folder, "nodes.csv", "node,x_m,y_m,z_m", [(i + 1, i * LENGTH / BEAMS, 0, 0) for i in range(BEAMS + 1)])
    table(folder, "materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3", [("steel", E, NU, RHO)])
    table(folder, "sections.csv", "section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4",
          [("box", area, WIDTH * HEIGHT**3 / 12, HEIGHT * WIDTH**3 / 12, 7.3e-4)])
    table(folder, "elements.csv", "element,type,group,material,section,node1,node2",
          [(i + 1, "beam", "cantilever", "steel", "box", i + 1, i + 2) for i in range(BEAMS)])
    table(folder, "supports.csv", "support,node,x,y,z,rx,ry,rz", [("wall", 1, 1, 1, 1, 1, 1, 1)])


def closed_form(inertia):
    stiffness = math.sqrt(E * inertia / (RHO * WIDTH * HEIGHT))
    return [root**2 / (2 * math.pi * LENGTH**2) * stiffness for root in CLAMPED_ROOTS]


def read_csv(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def read_matrix(numpy, file):
    lines = [line for line in file.read_text().splitlines() if not line.startswith("%")]
    matrix = numpy.zeros([int(word) for word in lines[0].split()[:2]])
    for line in lines[1:]:
        row, column, value = line.split()
        matrix[int(row) - 1, int(column) - 1] = matrix[int(column) - 1, int(row) - 1] = float(value)
    return matrix


def bytes_below(folder):
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


class OwnModel(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.model, self.out = self.folder / "cantilever", self.folder / "out" / "s1_model"
        write_cantilever(self.model)

    def run_step(self, *options, out=None):
        return subprocess.run([str(BIN / "s1_model"), "--out", str(out or self.out), "--quiet", "--set", "n_modes=6", *options],
                              capture_output=True, text=True, cwd=ROOT)

    def solve(self, *options, model=None, out=None):
        done = self.run_step("--model", str(model or self.model), *options, out=out)
        self.assertEqual(done.returncode, 0, done.stderr)
        return [float(row["frequency_Hz"]) for row in read_csv((out or self.out) / "modes.csv")]

    def edit(self, file, before, after):
        text = (self.model / file).read_text()
        self.assertIn(before, text)
        (self.model / file).write_text(text.replace(before, after, 1))


class GoodInput(OwnModel):
    def test_frequencies_of_the_textbook(self):
        found = self.solve()
        weak, strong = closed_form(HEIGHT * WIDTH**3 / 12), closed_form(WIDTH * HEIGHT**3 / 12)
        # First bending about both axes and second about the weak one: 1 % holds what four elements and rotary inertia leave.
        for expected in (weak[0], strong[0], weak[1]):
            nearest = min(found, key=lambda f: abs(f - expected))
            self.assertLess(abs(nearest / expected - 1), 0.01, f"{expected} Hz expected, found {found}")

    def test_what_is_promised_is_written(self):
        self.solve("--export-matrices")
        for name in ("modes.csv", "shapes.csv", "model.vtu", "stays.csv", "dampers.csv", "summary.csv", "K.mtx", "M.mtx", "dofs.csv",
                     "model/model.toml", "manifest.json"):
            self.assertTrue((self.out / name).is_file(), name)
        summary = {row["quantity"]: row["value"] for row in read_csv(self.out / "summary.csv")}
        self.assertEqual(summary["degrees_of_freedom"], str(6 * BEAMS))
        self.assertEqual(summary["beams"], str(BEAMS))
        shapes = read_csv(self.out / "shapes.csv")
        self.assertEqual({row["direction"] for row in shapes}, {"x", "y", "z"})
        self.assertEqual(len(shapes), 6 * 3 * (BEAMS + 1))
        for mode in range(1, 7):
            values = [float(row["value"]) for row in shapes if row["mode"] == str(mode)]
            self.assertEqual(max(values, key=abs), 1.0)
        self.assertEqual(json.loads((self.out / "manifest.json").read_text())["status"], "converged")

    def test_the_written_model_gives_the_same_modes(self):
        first = self.solve()
        again = self.solve(model=self.out / "model", out=self.folder / "again" / "s1_model")
        for a, b in zip(first, again):
            self.assertAlmostEqual(a / b, 1.0, delta=1e-9)

    def test_without_the_flag_no_matrices(self):
        self.solve()
        self.assertFalse((self.out / "K.mtx").exists())

    def test_exported_matrices_reproduce_the_modes(self):
        try:
            import numpy
        except ImportError:
            self.skipTest("numpy is not installed")
        found = self.solve("--export-matrices")
        stiffness, mass = (read_matrix(numpy, self.out / name) for name in ("K.mtx", "M.mtx"))
        self.assertEqual(len(read_csv(self.out / "dofs.csv")), len(stiffness))
        # K x = lambda M x as the ordinary problem of L^-1 K L^-T: M of four beams is positive definite.
        half = numpy.linalg.inv(numpy.linalg.cholesky(mass))
        values = numpy.sort(numpy.linalg.eigvalsh(half @ stiffness @ half.T))
        for expected, frequency in zip(numpy.sqrt(values) / (2 * math.pi), found):
            self.assertAlmostEqual(frequency / expected, 1.0, delta=1e-9)

    def test_the_exported_matrices_are_a_model(self):
        found = self.solve("--export-matrices")
        matrices = self.folder / "matrices"
        matrices.mkdir()
        for name in ("K.mtx", "M.mtx", "dofs.csv"):
            shutil.copy(self.out / name, matrices / name)
        (matrices / "model.toml").write_text('[matrices]\nK = "K.mtx"\nM = "M.mtx"\n')
        again = self.solve(model=matrices, out=self.folder / "again" / "s1_model")
        for a, b in zip(found, again):
            self.assertAlmostEqual(a / b, 1.0, delta=1e-9)


class BadInput(OwnModel):
    def refused(self, *said, options=()):
        """One line, exit code 2, and the results of an earlier run as they were."""
        before = bytes_below(self.out)
        self.assertTrue(before, "there are no earlier results")
        done = self.run_step("--model", str(self.model), *options)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertEqual(done.stdout, "")
        for part in said:
            self.assertIn(part, done.stderr)
        self.assertEqual(bytes_below(self.out), before)
        self.assertEqual([path.name for path in self.out.parent.iterdir()], [self.out.name], "something was left beside the results")

    def setUp(self):
        super().setUp()
        self.solve()

    def test_unknown_key_of_the_configuration(self):
        self.refused("n_mode", "n_modes", options=("--set", "n_mode=6"))

    def test_unknown_key_in_a_configuration_file(self):
        study = self.folder / "study"
        study.mkdir()
        (study / "study.toml").write_text(f'title = "own"\nsteps = ["s1_model"]\n[model]\nfolder = "{self.model}"\n')
        (study / "s1_model.toml").write_text("# own\nn_mods = 6\n")
        self.refused("s1_model.toml:2", "n_mods", "n_modes", options=("--study", str(study)))

    def test_value_out_of_range(self):
        self.refused("n_modes", "0", options=("--set", "n_modes=0"))

    def test_more_modes_than_degrees_of_freedom(self):
        self.refused("n_modes", "24 degrees of freedom", options=("--set", "n_modes=25"))

    def test_missing_column(self):
        self.edit("materials.csv", "youngs_modulus_Pa", "modulus")
        self.refused("materials.csv:1", "youngs_modulus_Pa")

    def test_missing_file(self):
        (self.model / "sections.csv").unlink()
        self.refused("sections.csv")

    def test_nan(self):
        self.edit("nodes.csv", "3,5.0,0,0", "3,nan,0,0")
        self.refused("nodes.csv:4", "x_m", "nan")

    def test_negative_modulus(self):
        self.edit("materials.csv", f"steel,{E}", f"steel,{-E}")
        self.refused("materials.csv:2", "youngs_modulus_Pa", "-210000000000")

    def test_two_nodes_at_one_place(self):
        self.edit("nodes.csv", "3,5.0,0,0", "3,2.5,0,0")
        self.refused("elements.csv:3", "nodes 2 and 3 lie at one place")

    def test_mechanism(self):
        (self.model / "supports.csv").unlink()
        self.refused(str(self.model), "node", "mechanism", "moves freely in")

    def test_mechanism_of_one_direction(self):
        # Nothing but the wall holds the beam along X: freeing x there lets every node slide along X and nowhere else.
        self.edit("supports.csv", "wall,1,1,1", "wall,1,0,1")
        self.refused(str(self.model), "moves freely in x;")

    def test_section_that_is_not_there(self):
        self.edit("elements.csv", "steel,box", "steel,bix")
        self.refused("elements.csv:2", "section 'bix' is not in sections.csv", "did you mean 'box'")

    def test_material_that_is_not_there(self):
        self.edit("elements.csv", "steel,box", "steal,box")
        self.refused("elements.csv:2", "material 'steal' is not in materials.csv", "did you mean 'steel'")

    def test_node_that_is_not_there(self):
        self.edit("elements.csv", "steel,box,1,2", "steel,box,1,22")
        self.refused("elements.csv:2", "node2", "node 22 is not in nodes.csv")

    def test_parameter_of_nothing(self):
        self.edit("model.toml", '["steel"]', '["concrete"]')
        self.refused("model.toml:4", "parameter E", "concrete")


if __name__ == "__main__":
    sys.exit(unittest.main())
