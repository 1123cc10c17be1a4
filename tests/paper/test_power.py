"""The power of the check. Oracles: files whose changed number is known; a made-up study with one result moved; and, on the Ponte del Mare
itself, changed inputs that the check has to notice by a cell that does not print them."""
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(ROOT / "paper")]

from made_up_case import CheckCase  # noqa: E402
from twindeck_power.edit import csv_edited, scaled, toml_edited  # noqa: E402
from twindeck_power.judge import Judge  # noqa: E402
from twindeck_power.perturbation import LEAST, read_plan  # noqa: E402
from twindeck_power.scratch import Scratch, link_tree  # noqa: E402
from twindeck_report.check import run_check  # noqa: E402
from twindeck_report.errors import InputError  # noqa: E402
from twindeck_report.study import Study  # noqa: E402

BIN = Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
PLAN = ROOT / "data/ponte_del_mare/power.toml"

TOML = '''gravity = "9.81 m/s^2"   # with its unit
[material.steel]
youngs_modulus = "210 GPa"    # [paper] 7 digits
[[damper]]
type = "A"
damping = "128.0 kN s/m"
[[damper]]
type = "C"
damping = "794.2 kN s/m"
[[change]]
name = "thin"
[change.set]
"deck.foot.slab.B.thickness" = "0.03 m"
weight = 1e-5
'''


class Edits(unittest.TestCase):
    def test_one_number_of_a_toml_file_changes_and_nothing_else(self):
        for key, factor, old, new in (("material.steel.youngs_modulus", 1.05, '"210 GPa" ', '"220.5 GPa" '), ("damper.C.damping", 0.5, "794.2", "397.1"),
                                      ("change.thin.set.deck.foot.slab.*.thickness", 1.1, '"0.03 m"', '"0.033 m"'), ("change.thin.set.weight", 10, "1e-5", "0.0001"),
                                      ("gravity", 2, "9.81", "19.62")):
            text, found = toml_edited(TOML, key, lambda value, factor=factor: scaled(value, factor))
            self.assertEqual((text, found), (TOML.replace(old, new), 1), key)
        tomllib.loads(text)

    def test_patterns_take_several_and_unknown_keys_none(self):
        self.assertEqual(toml_edited(TOML, "damper.*.damping", lambda value: '"1 N s/m"')[1], 2)
        self.assertEqual(toml_edited(TOML, "damper.B.damping", lambda value: value)[1], 0)

    def test_a_column_changes_in_the_rows_that_are_meant(self):
        text = 'set,words,x\na,"one, two",1\nb,three,2\n'
        self.assertEqual(csv_edited(text, "x", {"set": "b"}, lambda v: scaled(v, -3)), ('set,words,x\na,"one, two",1\nb,three,-6\n', 1))
        with self.assertRaises(InputError):
            csv_edited(text, "y", {}, str)


class Plan(unittest.TestCase):
    """Every entry changes something that some step of the study reads."""

    @classmethod
    def setUpClass(cls):
        cls.plan = read_plan(PLAN)
        cls.folder = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))

    def test_at_least_sixty_inputs_of_every_kind(self):
        self.assertGreaterEqual(len(self.plan.perturbations), LEAST)
        files = {p.file for p in self.plan.perturbations}
        self.assertLessEqual({"data/ponte_del_mare/bridge.toml", "data/ponte_del_mare/aero/foot_flutter.csv", "data/wind/turbulence_sets.csv"}, files)
        self.assertLessEqual({f"workflows/ponte_del_mare/{step}.toml" for step in ("s6_updating", "s7_aerodynamics", "s8_validation")}, files)
        self.assertLessEqual({f"workflows/ponte_del_mare_virtual/{step}.toml" for step in ("s0_campaign", "s2_sensors", "s3_identification")}, files)

    def test_every_entry_changes_its_file_and_leaves_it_readable(self):
        for p in self.plan.perturbations:
            with self.subTest(p.name):
                copy = self.folder / p.file
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / p.file, copy)
                p.apply(self.folder)
                self.assertNotEqual(copy.read_bytes(), (ROOT / p.file).read_bytes())
                if copy.suffix == ".toml":
                    tomllib.loads(copy.read_text(encoding="utf-8"))

    def test_what_is_no_change_is_refused(self):
        for text, words in (('name = "a"\nfile = "b"\nkey = "c"', "expected factor or value"), ('name = "a"\nfile = "b"\nfactor = 2.0', "expected key"),
                            ('name = "a"\nkey = "c"\nfactor = 2.0', "no file")):
            (self.folder / "power.toml").write_text("[[perturbation]]\n" + text + "\n")
            with self.assertRaisesRegex(InputError, words):
                read_plan(self.folder / "power.toml")


class Looking(CheckCase):
    def setUp(self):
        super().setUp()
        self.assertEqual(self.run_command("baseline")[0], 0)
        self.study = Study("made_up", self.results, self.data, self.workflow)
        self.judge = Judge(self.study, run_check(self.study))

    def test_the_unchanged_study_is_not_caught(self):
        found = self.judge.look(self.study, ())
        self.assertEqual((found.paper, found.ratchet), ({}, {}))
        self.assertLess(found.nearest, 1.0)

    def test_both_gates_and_what_prints_the_input(self):
        self.remake_with("s4_refinement", "comparison.csv", "numerical_mode", "12N", "computed_Hz", 1.06)
        found = self.judge.look(self.study, ())
        self.assertEqual(list(found.paper), ["table_07 row 10X column f_N_Hz"])
        self.assertIn("table_07 row 10X column f_N_Hz", found.ratchet)
        found = self.judge.look(self.study, ("table_07 row 10X *",))
        self.assertEqual((found.paper, found.ratchet), ({}, {}), "a cell that prints the input does not count")

    def test_what_is_only_shown_is_caught_by_the_ratchet_alone(self):
        self.remake_with("s2_sensors", "setups.csv", "setup", "DC1", "R_k", 1.02)
        found = self.judge.look(self.study, ())
        self.assertEqual((list(found.paper), list(found.ratchet)), ([], ["table_03 row DC1 column R_k"]))
        self.assertAlmostEqual(found.nearest, (0.255 - 0.25) / (1e-3 * 0.255))

    def test_tables_whose_step_has_not_run_are_left_out(self):
        shutil.rmtree(self.results / "s4_refinement")
        found = self.judge.look(self.study, ())
        self.assertEqual((found.paper, found.ratchet), ({}, {}), "what is missing has not moved")


class Reach(unittest.TestCase):
    """Which steps run. Oracle: a made-up chain, step 1 to step 7, of files whose contents are known."""

    def setUp(self):
        self.origin = Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.origin / "data/mine").mkdir(parents=True)
        (self.origin / "workflows/mine").mkdir(parents=True)
        for name in ("bridge.toml", "wind.csv"):
            (self.origin / "data/mine" / name).write_text("1\n")
        self.step("s1_model", "data/mine/bridge.toml")
        self.step("s4_refinement", "results/mine/s1_model/out.csv")
        self.step("s7_aerodynamics", "results/mine/s4_refinement/out.csv", "data/mine/wind.csv")

    def step(self, name, *inputs, study="mine"):
        folder = self.origin / "results" / study / name
        folder.mkdir(parents=True)
        (folder / "out.csv").write_text(f"{name}\n")
        recorded = {file: hashlib.sha256((self.origin / file).read_bytes()).hexdigest() for file in inputs}
        (folder / "manifest.json").write_text(json.dumps({"inputs": recorded, "outputs": {}, "seconds": 2.0}))

    def changed(self, file):
        scratch = Scratch(self.origin / "scratch", self.origin, "mine", BIN, {})
        scratch.own(file)
        (scratch.root / file).write_text("2\n")
        return scratch

    def finish(self, scratch, step, text):
        """As if the step had run."""
        folder = scratch.root / "results" / step
        folder.mkdir()
        (folder / "out.csv").write_text(text)
        scratch.done.append(step)

    def test_nothing_runs_unless_something_changed(self):
        self.assertEqual(Scratch(self.origin / "scratch", self.origin, "mine", BIN, {}).waiting(), [])

    def test_a_step_runs_if_what_it_read_is_another_and_its_followers_wait(self):
        scratch = self.changed("data/mine/bridge.toml")
        self.assertEqual(scratch.waiting(), ["mine/s1_model", "mine/s4_refinement", "mine/s7_aerodynamics"])
        self.assertFalse((scratch.results / "s4_refinement").exists(), "old results are out of sight")
        self.assertEqual((self.origin / "data/mine/bridge.toml").read_text(), "1\n", "the original is left alone")
        self.finish(scratch, "mine/s1_model", "another\n")
        self.assertEqual(scratch.waiting(), ["mine/s4_refinement", "mine/s7_aerodynamics"])

    def test_a_change_that_ends_half_way_runs_nothing_behind(self):
        scratch = self.changed("data/mine/bridge.toml")
        scratch.waiting()
        self.finish(scratch, "mine/s1_model", "s1_model\n")
        self.assertEqual(scratch.waiting(), [], "step 1 gave what it gave before")
        self.assertTrue((scratch.results / "s7_aerodynamics/out.csv").is_file(), "what was out of sight is back")

    def test_steps_of_the_virtual_campaign_come_first_and_reach_what_reads_them(self):
        (self.origin / "workflows/mine_virtual").mkdir()
        (self.origin / "data/mine/truth.toml").write_text("1\n")
        self.step("s0_campaign", "data/mine/truth.toml", study="mine_virtual")
        self.step("s8_validation", "results/mine_virtual/s0_campaign/out.csv", "results/mine/s7_aerodynamics/out.csv")
        self.assertEqual(self.changed("data/mine/truth.toml").waiting(), ["mine_virtual/s0_campaign", "mine/s8_validation"])

    def test_a_late_input_leaves_what_is_before_it_alone(self):
        self.assertEqual(self.changed("data/mine/wind.csv").waiting(), ["mine/s7_aerodynamics"])


class PonteDelMare(unittest.TestCase):
    """Quick changes on the study itself, against its committed baseline. Step 1 alone is run."""

    @classmethod
    def setUpClass(cls):
        cls.root = Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.plan = {p.name: p for p in read_plan(PLAN).perturbations}
        cls.judge = Judge(Study("ponte_del_mare", cls.root / "none", ROOT / "data/ponte_del_mare", ROOT / "workflows/ponte_del_mare"))

    def look(self, name=None):
        root = self.root / (self.plan[name].slug if name else "unchanged")
        for folder in ("data", "workflows"):
            link_tree(ROOT / folder, root / folder)
        if name:
            file = root / self.plan[name].file
            text = file.read_bytes()
            file.unlink()
            file.write_bytes(text)
            self.plan[name].apply(root)
        out = "results/ponte_del_mare/s1_model"
        (root / out).parent.mkdir(parents=True)
        done = subprocess.run([BIN / "s1_model", "--study", "workflows/ponte_del_mare", "--out", out, "--set", "meshes=[]", "--quiet"], cwd=root,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        study = Study("ponte_del_mare", root / "results/ponte_del_mare", root / "data/ponte_del_mare", root / "workflows/ponte_del_mare")
        return self.judge.look(study, self.plan[name].prints if name else ())

    def test_the_study_as_it_is_passes(self):
        found = self.look()
        self.assertEqual((found.paper, found.ratchet), ({}, {}))

    def test_steel_five_per_cent_stiffer_is_noticed(self):
        found = self.look("steel 5 % stiffer")
        self.assertTrue(any(cell.startswith("table_02 row") for cell in found.cells), found.cells)
        self.assertFalse(any("E_s" in cell for cell in found.cells), "not by a cell that prints it")

    def test_gravity_of_8_5_is_noticed(self):
        found = self.look("gravity 8.5 m/s2")
        self.assertTrue(found.paper or found.ratchet)
        self.assertTrue(any(cell.startswith("stay_forces row") for cell in found.cells), found.cells)

    def test_lighter_stays_and_a_doubled_mast_head_are_noticed(self):
        for name in ("stays of 44 mm 20 % heavier", "mast head twice as heavy"):
            self.assertTrue(self.look(name).cells, name)


if __name__ == "__main__":
    unittest.main()
