"""Models as .inp files: written for CalculiX and Abaqus, read back, and solved by CalculiX.

Oracles: CalculiX (ccx), an independent solver, on models that twindeck exports; the model itself for the round trip, since the
Abaqus flavour loses nothing; a cantilever's closed form for a file written by hand; the file's own line numbers for refusals.

Tolerances, with their reasons: 0.5 % for shells and solids on a mesh fine enough that CalculiX has converged to about half of that
(it expands shells into solids of 8 nodes, which approach from above). Beams become solids of 20 nodes, written so that they keep
E A, E I, mass, and either torsion or shear (src/model_io/inp_expanded_beam.hpp); what they do not keep is computed by reading the
file back, which gives beams of what CalculiX sees, so that these frequencies must be CalculiX's far more closely than the model's.
"""

import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from random import Random

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import exchange_models as models  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEP = pathlib.Path(os.environ["TWINDECK_BIN"]).resolve() / "s1_model"
CCX = shutil.which("ccx")


def run(model, out, *arguments):
    return subprocess.run([STEP, "--model", model, "--out", out, *map(str, arguments)], cwd=ROOT, capture_output=True, text=True, timeout=300)


def frequencies(folder):
    return [float(row["frequency_Hz"]) for row in models.read_csv(folder / "modes.csv")]


def calculix(folder):
    """Frequencies [Hz] of model.inp as ccx prints them: the fourth column of the eigenvalue table."""
    done = subprocess.run([CCX, "-i", "model"], cwd=folder, capture_output=True, text=True, timeout=600, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if "Job finished" not in done.stdout:
        raise AssertionError("ccx did not finish: " + done.stdout[-2000:])
    row = re.compile(r"\s+\d+\s+\S+E\S+\s+\S+E\S+\s+(\S+E\S+)\s")
    return [float(m.group(1)) for m in map(row.match, (folder / "model.dat").read_text().splitlines()) if m]


class Folder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def exported(self, model, name="s1"):
        done = run(model, self.folder / name, "--set", "n_modes=10", "--export-inp")
        self.assertEqual(done.returncode, 0, done.stderr)
        return frequencies(self.folder / name)


@unittest.skipUnless(CCX, "ccx is not installed (Debian package calculix-ccx): CalculiX is not compared with")
class AgainstCalculiX(Folder):
    def compare(self, what, model, allowed):
        ours, theirs = self.exported(model), calculix(self.folder / "s1")
        self.close(what, ours, theirs, allowed)
        return theirs

    def close(self, what, ours, theirs, allowed):
        self.assertGreaterEqual(len(theirs), 10)
        print(f"\n{what}: mode, ours [Hz], CalculiX [Hz], difference")
        for mode, (f, x) in enumerate(zip(ours, theirs), 1):
            print(f"  {mode:2d} {f:10.4f} {x:10.4f} {100 * (x / f - 1):+.3f} %")
        for f, x in zip(ours, theirs):
            self.assertLess(abs(x / f - 1), allowed)

    def test_space_frame_of_tubes(self):
        models.space_frame(self.folder / "frame", pieces=8)
        theirs = self.compare("space frame", self.folder / "frame", 0.002)  # 0.10 % is the shear of tubes
        self.close("space frame, its file read back", self.exported(self.folder / "s1" / "model.inp", "again"), theirs, 0.0005)

    def test_stocky_frame_of_tubes_and_i_beams(self):
        """One element between joints, where a material with Poisson's ratio is 17 to 33 % too high. What is left is the shear
        of the tubes (2.9 %) and the torsion of the I beams (0.4 %): the file read back has both, with two elements a member for one."""
        models.stocky_frame(self.folder / "frame")
        theirs = self.compare("stocky frame", self.folder / "frame", 0.04)
        self.close("stocky frame, its file read back", self.exported(self.folder / "s1" / "model.inp", "again"), theirs, 0.01)

    def test_block_of_solids(self):
        models.block_alone(self.folder / "block")
        self.compare("block of solids", self.folder / "block", 0.005)

    def test_slab_and_end_block_of_the_bridge(self):
        done = subprocess.run([STEP, "--study", "workflows/ponte_del_mare", "--out", self.folder / "bridge", "--set", "n_modes=1"], cwd=ROOT,
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        models.bridge_part(self.folder / "part", self.folder / "bridge" / "model")
        self.compare("slab and end block of the foot deck", self.folder / "part", 0.005)


    def test_block_on_skew_springs(self):
        """The block's free end on springs along no axis, with a mass on one corner: they matter, for the first mode moves by more than a tenth."""
        folder = self.folder / "block"
        models.block_alone(folder)
        end = [row["node"] for row in models.read_csv(folder / "nodes.csv") if float(row["x_m"]) == 4.0]
        models.write_csv(folder / "springs.csv", ["spring", "group", "node", "direction_x", "direction_y", "direction_z", "stiffness_N_m"],
                         [["a", "ground", end[0], 0.6, 0, 0.8, 3e8], ["b", "ground", end[-1], 0, 0, 1, 2e7], ["c", "ground", end[3], 0, 0.6, 0.8, 1e8]])
        models.write_csv(folder / "masses.csv", ["group", "node", "mass_kg"], [["lamp", end[5], 500]])
        self.compare("block on skew springs", folder, 0.005)
        self.assertGreater(frequencies(self.folder / "s1")[0], 1.1 * 18.75)

    def test_whole_bridge(self):
        """Both directions at full size. The Abaqus flavour comes back the same. CalculiX is 0.12 % above ours at most in ten modes,
        a quarter of it by the shear of tubes and the torsion of floor beams. With Poisson's ratio in its beams it was 3.6 % above."""
        model = whole_bridge(self.folder)
        before = self.exported(model)
        shutil.copy(self.folder / "s1" / "model_abaqus.inp", self.folder / "bridge.inp")
        self.exported(self.folder / "bridge.inp", "again")
        for f, g in zip(before, frequencies(self.folder / "again")):
            self.assertAlmostEqual(g / f, 1.0, delta=1e-7)
        theirs = calculix(self.folder / "s1")
        self.close("whole bridge", before, theirs, 0.002)
        self.close("whole bridge, its file read back", self.exported(self.folder / "s1" / "model.inp", "back"), theirs, 0.001)


def whole_bridge(folder):
    """The study's model without geometric stiffness, which an .inp file does not carry."""
    done = subprocess.run([STEP, "--study", "workflows/ponte_del_mare", "--out", folder / "bridge", "--set", "n_modes=1"], cwd=ROOT,
                          capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    shutil.copytree(folder / "bridge" / "model", folder / "linear")
    toml = folder / "linear" / "model.toml"
    toml.write_text(toml.read_text().replace("geometric_stiffness = true", "geometric_stiffness = false"))
    return folder / "linear"


class RoundTrip(Folder):
    def test_abaqus_flavour_loses_nothing(self):
        models.space_frame(self.folder / "frame", pieces=2)
        before = self.exported(self.folder / "frame")
        after = self.exported(self.folder / "s1" / "model_abaqus.inp", "again")
        for f, g in zip(before, after):  # 12 digits in the file
            self.assertAlmostEqual(g / f, 1.0, delta=1e-9)
        groups = {row["group"] for row in models.read_csv(self.folder / "again" / "model" / "elements.csv")}
        self.assertEqual(groups, {"column", "girder", "brace"})
        materials = {row["material"] for row in models.read_csv(self.folder / "again" / "model" / "materials.csv")}
        self.assertEqual(materials, {"steel"})

    def test_imported_model_is_a_model_folder(self):
        models.block_alone(self.folder / "block")
        before = self.exported(self.folder / "block")
        self.exported(self.folder / "s1" / "model.inp", "read")
        self.assertEqual(self.exported(self.folder / "read" / "model", "again"), frequencies(self.folder / "read"))
        for f, g in zip(before, frequencies(self.folder / "read")):
            self.assertAlmostEqual(g / f, 1.0, delta=1e-9)


class RefusedExport(Folder):
    """What no card of the file can say and leaving out would make another structure: one line, exit 2, nothing written."""

    def refused(self, *fragments):
        done = run(self.folder / "block", self.folder / "s1", "--set", "n_modes=2", "--export-inp", "--quiet")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertFalse((self.folder / "s1").exists())
        for fragment in fragments:
            self.assertIn(fragment, done.stderr)

    def test_lumped_masses(self):
        models.block_alone(self.folder / "block")
        with open(self.folder / "block" / "model.toml", "a") as file:
            file.write("[formulation]\nlumped_mass = true\n")
        self.refused("formulation.lumped_mass", "consistent masses", "--export-matrices")

    def test_tapered_beam(self):
        models.space_frame(self.folder / "block", pieces=1)
        elements = models.read_csv(self.folder / "block" / "elements.csv")
        models.write_csv(self.folder / "block" / "elements.csv", [*elements[0], "section2"],
                         [[*row.values(), "girder" if row is elements[0] else ""] for row in elements])
        self.refused("element 1", "tapered beam")

    def test_element_given_by_matrices(self):
        models.block_alone(self.folder / "block")
        matrices = self.folder / "block" / "matrices"
        matrices.mkdir()
        (matrices / "k.mtx").write_text("%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 1e6\n")
        end = next(row["node"] for row in models.read_csv(self.folder / "block" / "nodes.csv") if float(row["x_m"]) == 4.0)
        with open(self.folder / "block" / "model.toml", "a") as file:
            file.write(f'[[matrix_element]]\nname = "wind"\ngroup = "wind"\ndofs = ["{end}:x"]\nstiffness = "matrices/k.mtx"\n')
        self.refused("matrix element 'wind'", "given by its matrices")


class DampingMatrix(Folder):
    def test_dashpots_and_their_own_unknowns(self):
        """A dashpot to the ground along z, and one in series with a spring: c stands where dofs.csv says, and in the row of the dashpot's own
        unknown z, with k (u - z) = c dz/dt; nothing else in C."""
        models.space_frame(self.folder / "frame", pieces=1)
        top = [row["node"] for row in models.read_csv(self.folder / "frame" / "nodes.csv") if float(row["z_m"]) == 6.5][:2]
        header = ["spring", "group", "node", "direction_x", "direction_y", "direction_z", "stiffness_N_m", "damping_N_s_m", "arrangement"]
        models.write_csv(self.folder / "frame" / "springs.csv", header, [["P", "damper", top[0], 0, 0, 1, 0, 5000, "parallel"],
                                                                         ["S", "damper", top[1], 1, 0, 0, 2e6, 700, "series"]])
        done = run(self.folder / "frame", self.folder / "out", "--set", "n_modes=2", "--export-matrices", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        dofs = models.read_csv(self.folder / "out" / "dofs_damped.csv")
        row = {(r["node"], r["direction"]): int(r["dof"]) for r in dofs}

        def entries(name):
            lines = (self.folder / "out" / name).read_text().splitlines()[2:]
            return {(int(i), int(j)): float(v) for i, j, v in map(str.split, lines)}

        own = row["S", "own"]
        self.assertEqual(entries("C.mtx"), {(row[top[0], "z"], row[top[0], "z"]): 5000.0, (own, own): 700.0})
        stiffness = entries("K_damped.mtx")
        self.assertEqual(stiffness[own, own], 2e6)
        self.assertEqual(stiffness[own, row[top[1], "x"]], -2e6)


CANTILEVER = """*Heading
A mast, as another program writes it
** a comment
*Part, name=Part-1
*Node
1, 0., 0., 0.
{nodes}
*Element, type=B33, elset=Mast
{elements}
*Nset, nset=Base
 1,
*Nset, nset=Top
 {last},
*Elset, elset=All, generate
 1, {count}, 1
*Beam Section, elset=All, material="Steel S355", section=RECT
0.2, 0.1
1., 0., 0.
*End Part
*Assembly, name=Assembly
*Instance, name=Part-1-1, part=Part-1
*End Instance
*End Assembly
*Material, name="Steel S355"
*Density
7850.,
*Elastic
 2.1e11, 0.3
*Boundary
Part-1-1.Base, ENCASTRE
*Step, name=Modes, nlgeom=NO
*Frequency, eigensolver=Lanczos
 6, , , ,
*Cload
Top, 1, 1000.
*Output, field
*Node Output
U,
*End Step
"""


def cantilever(count=20, height=10.0):
    return CANTILEVER.format(nodes="\n".join(f"{i + 1}, 0., 0., {height * i / count:.6f}" for i in range(1, count + 1)), count=count,
                             elements="\n".join(f"{i}, {i}, {i + 1}" for i in range(1, count + 1)), last=count + 1)


class ImportedByHand(Folder):
    def imported(self, text):
        file = self.folder / "mast.inp"
        file.write_text(text)
        return run(file, self.folder / "out", "--set", "n_modes=4")

    def refused(self, text, *fragments):
        done = self.imported(text)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertFalse((self.folder / "out").exists())
        for fragment in fragments:
            self.assertIn(fragment, done.stderr)

    def test_abaqus_flavour_cantilever(self):
        done = self.imported(cantilever())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("*CLOAD (line ", done.stderr)  # what does not enter is said
        # Euler cantilever, beta l = 1.8751041: bending about the weak axis first. n1 = x: 0.2 m along x, 0.1 m along y. Rotary inertia
        # lowers it by about (pi r/2 l)^2/2 = 1e-5.
        area, weak, strong = 0.02, 0.2 * 0.1**3 / 12, 0.1 * 0.2**3 / 12
        exact = [1.8751040687**2 / (2 * math.pi * 100) * math.sqrt(2.1e11 * i / (7850 * area)) for i in (weak, strong)]
        for f, wanted in zip(frequencies(self.folder / "out"), exact):
            self.assertAlmostEqual(f / wanted, 1.0, delta=1e-3)
        points = models.read_csv(self.folder / "out" / "model" / "points.csv")
        self.assertEqual({row["point"] for row in points}, {"Base", "Top"})

    def test_file_beside_gives_parameters(self):
        (self.folder / "mast.toml").write_text('title = "mast"\n[[parameter]]\nname = "E"\ntarget = "youngs_modulus"\nof = ["Steel S355"]\n'
                                               'unit = "Pa"\ninitial = 2.1e11\nlower = 1.9e11\nupper = 2.2e11\n')
        self.assertEqual(self.imported(cantilever()).returncode, 0)
        self.assertIn('name = "E"', (self.folder / "out" / "model" / "model.toml").read_text())

    def test_unsupported_card_names_card_and_line(self):
        text = cantilever().replace("*Boundary\n", "*Contact Pair, name=T\nA, B\n*Boundary\n")
        line = text[:text.index("*Contact Pair")].count("\n") + 1
        self.refused(text, f"mast.inp:{line}: *CONTACT PAIR: unsupported card")

    def test_unsupported_element_type_and_section(self):
        self.refused(cantilever().replace("type=B33", "type=B38"), "unsupported element type B38")
        self.refused(cantilever().replace("section=RECT", "section=ELBOW"), "unsupported SECTION=ELBOW")

    def test_other_faults(self):
        self.refused(cantilever().replace("*End Part", "*Include, input=a.inp\n*End Part"), "*INCLUDE", "'a.inp' is not there")
        self.refused(cantilever().replace("20, 20, 21", "20, 20, 99"), "node 99 is not defined")
        self.refused(cantilever().replace("material=\"Steel S355\",", "material=steal,"), "material 'steal' is not defined")
        self.refused(cantilever().replace("elset=All, material", "elset=Al, material"), "no set is called 'Al' (did you mean 'All'?)")
        self.refused(cantilever().replace("7850.,", "heavy"), "field 1 is 'heavy', expected a number")
        self.refused(cantilever().replace(" 1, 20, 1\n", " 1, 19, 1\n"), "element 20 has no section")
        self.refused(cantilever().replace("1., 0., 0.", "0., 0., 1."), "lies along element 1")
        self.refused(cantilever().replace("Base, ENCASTRE", "Base, 1, 3, 0.01"), "prescribes a displacement that is not zero")
        self.refused(cantilever().replace("*Elastic\n", "*Elastic, type=ORTHOTROPIC\n"), "TYPE=ORTHOTROPIC is not supported")

    def test_orthotropic_materials_are_those_of_our_own_beams(self):
        own = "*Elastic, type=ENGINEERING CONSTANTS\n2.1e11, 2.1e11, 2.1e11, 0., 0., 0., 8e10, 8e10\n8e10\n"
        beams = cantilever().replace("*Elastic\n 2.1e11, 0.3\n", own)
        axes = "*Orientation, name=Axes\n0., 0., 1., 1., 0., 0.\n*Boundary\n"
        oriented = beams.replace("section=RECT", "section=RECT, orientation=Axes").replace("*Boundary\n", axes)
        self.assertEqual(self.imported(oriented).returncode, 0)
        shutil.rmtree(self.folder / "out")
        self.refused(beams, "ORIENTATION")
        self.refused(oriented.replace("0., 0., 1., 1., 0., 0.", "1., 0., 0., 0., 0., 1."), "is not along the axes of element 1")
        self.refused(oriented.replace("2.1e11, 0., 0., 0.,", "2.1e11, 0.3, 0.3, 0.3,"), "several E or Poisson's ratios")


class PartsOfAFile(Folder):
    def test_springs_masses_and_links(self):
        """Two masses on springs, one carried by a rigid link: m ω² = k for each, whatever the card that says so."""
        text = "\n".join([
            "*NODE", "1, 0, 0, 0", "2, 1, 0, 0", "3, 1, 1, 0", "4, 3, 0, 0", "5, 4, 0, 0",
            "*ELEMENT, TYPE=SPRINGA, ELSET=K1", "1, 1, 2", "*SPRING, ELSET=K1", "", "4e6",
            "*ELEMENT, TYPE=MASS, ELSET=M1", "2, 3", "*MASS, ELSET=M1", "100.",
            "*ELEMENT, TYPE=SPRING1, ELSET=K2", "3, 4", "*SPRING, ELSET=K2", "1", "1D6",
            "*ELEMENT, TYPE=T3D2, ELSET=BAR", "5, 4, 5", "*MATERIAL, NAME=S", "*ELASTIC", "1e-3, 0", "*DENSITY", "200.",
            "*SOLID SECTION, ELSET=BAR, MATERIAL=S", "1.",
            "*EQUATION", "2", "3, 1, -1., 2, 1, 1.", "2", "3, 2, 1., 2, 2, -1.", "2", "3,3,1.,2,3,-1.",
            "*BOUNDARY", "1, 1, 6", "2, 2, 6", "4, 2, 3", "5, 1, 3", ""])
        # K1 carries 100 kg; K2 carries a third of the bar's 200 kg (consistent mass, other end held)
        wanted = sorted(math.sqrt(k / m) / (2 * math.pi) for k, m in ((4e6, 100.0), (1e6, 200.0 / 3)))
        # node 3 hangs on node 2 by translations alone, which no rigid link says: the equations are constraints of their own
        (self.folder / "a.inp").write_text(text)
        done = run(self.folder / "a.inp", self.folder / "out", "--set", "n_modes=2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len((self.folder / "out/model/constraints.csv").read_text().splitlines()), 4)
        for f, w in zip(frequencies(self.folder / "out"), wanted):
            self.assertAlmostEqual(f / w, 1.0, delta=1e-6)
        # written as a rigid body moves (u_x = u_m - theta_z) they are one link
        rigid = text.replace("*EQUATION\n2\n3, 1, -1., 2, 1, 1.\n2", "*EQUATION\n3\n3, 1, -1., 2, 1, 1., 2, 6, -1.\n2")
        rigid = rigid.replace("2\n3,3,1.,2,3,-1.", "3\n3,3,1.,2,3,-1.,2,4,-1.")
        (self.folder / "a.inp").write_text(rigid)
        done = run(self.folder / "a.inp", self.folder / "out", "--set", "n_modes=2")
        self.assertEqual(done.returncode, 0, done.stderr)
        for f, w in zip(frequencies(self.folder / "out"), wanted):
            self.assertAlmostEqual(f / w, 1.0, delta=1e-6)


class LeftOut(Folder):
    def test_what_neither_file_holds_is_said_of_both(self):
        """A shell's ratio of bending inertia; only the model itself knows that it is missing."""
        models.write_model(self.folder / "plate", "plate", {1: (0, 0, 0), 2: (1, 0, 0), 3: (1, 1, 0), 4: (0, 1, 0)}, [("shell", "slab", "slab", [1, 2, 3, 4])],
                           {"slab": [0, 0, 0, 0, 0, 0, 0, 0.1, 1.3]}, {1: [1] * 6, 4: [1] * 6})
        done = run(self.folder / "plate", self.folder / "s1", "--set", "n_modes=2", "--export-inp")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("model.inp, model_abaqus.inp: the bending inertia ratio 1.3 of section 'slab' is left out", done.stdout + done.stderr)


class SpoiltFiles(Folder):
    def test_spoilt_lines_are_refused_in_one_line_or_read(self):
        """Seeded mutations of both flavours: never a crash, never silence; a refusal names the file."""
        models.space_frame(self.folder / "frame", pieces=1)
        self.exported(self.folder / "frame")
        texts = [(self.folder / "s1" / name).read_text().splitlines() for name in ("model.inp", "model_abaqus.inp")]
        random = Random(3)
        refused = 0
        for _ in range(40):
            lines = list(random.choice(texts))
            i = random.randrange(len(lines))
            fields = lines[i].split(",")
            fields[random.randrange(len(fields))] = random.choice(["", "-1", "nan", "1e400", "word", "*", "="])
            lines[i] = ",".join(fields)
            (self.folder / "spoilt.inp").write_text("\n".join(lines) + "\n")
            done = run(self.folder / "spoilt.inp", self.folder / "out", "--set", "n_modes=2", "--quiet")
            self.assertIn(done.returncode, (0, 2), lines[i] + "\n" + done.stderr)
            if done.returncode == 2:
                refused += 1
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn("spoilt.inp:", done.stderr)
        self.assertGreater(refused, 20)


if __name__ == "__main__":
    unittest.main()
