"""What makes a step run again: files that are edited, added or gone, wherever a configuration says they lie; and what `make why` and make itself
say of a study that is not there or lists what is no step.

Oracles: the inputs that a step's own manifest lists, each touched or removed in turn; what make would run (make -n); one line a fault.
"""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ["TWINDECK_BIN"]).resolve()
STEPS = ["s1_model", "s4_refinement", "s9_diagnosis"]


class OfOneStudy(unittest.TestCase):
    """A study on the template's frame whose measured modes and causes lie in folders beside it, one with a blank in its name."""

    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        for part in ("workflows", "paper", "data/template"):
            shutil.copytree(ROOT / part, cls.root / part, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "Makefile", cls.root / "Makefile")
        cls.make("new", "STUDY=mine")
        shutil.copytree(ROOT / "data/template/features", cls.root / "my feat")
        (cls.root / "my_causes").mkdir()
        for cause in ("stiffness", "mass"):
            shutil.copy(ROOT / f"workflows/common/hypotheses/{cause}.toml", cls.root / "my_causes")
        cls.study = cls.root / "workflows/mine/study.toml"
        cls.study.write_text('title = "mine"\nfeatures = "my feat"\nsteps = ["s1_model", "s4_refinement", "s9_diagnosis"]\n[model]\nfolder = "data/mine/model"\n')
        (cls.root / "workflows/mine/s9_diagnosis.toml").write_text('catalogue = "my_causes"\n')
        done = cls.make("steps")
        if done.returncode:
            raise AssertionError(done.stdout + done.stderr)

    @classmethod
    def make(cls, *arguments, executables=BIN):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
        return subprocess.run(["make", "--no-print-directory", "NO_BUILD=1", "STUDY=mine", f"BIN={executables}", *arguments], cwd=cls.root, env=environment,
                              capture_output=True, text=True, timeout=300)

    def would_run(self):
        said = self.make("-n", "steps")
        self.assertEqual(said.returncode, 0, said.stderr)
        return [step for step in STEPS if f"{BIN}/{step} " in said.stdout]

    def inputs(self, step):
        """Files outside the study's results that the step read."""
        listed = json.loads((self.root / f"results/mine/{step}/manifest.json").read_text())["inputs"]
        return [name for name in listed if not name.startswith("results/")]


class RunsAgain(OfOneStudy):
    def test_nothing_does_where_nothing_changed(self):
        self.assertEqual(self.would_run(), [])
        self.assertEqual([self.make("why", step).stdout for step in STEPS], [f"{step}: up to date\n" for step in STEPS])

    def test_every_file_that_a_step_read_counts_edited_or_gone(self):
        for step in STEPS:
            names = self.inputs(step)
            self.assertGreater(len(names), 3)
            for name in names:
                file = self.root / name
                kept, stamp = file.read_bytes(), file.stat()
                os.utime(file, (time.time() + 10, time.time() + 10))
                self.assertIn(step, self.would_run(), f"{name} edited")
                self.assertIn(f"{step}/manifest.json: older than {name}\n", self.make("why", step).stdout)
                if file.name not in ("study.toml", f"{step}.toml"):  # without a configuration there is no study, or the step's defaults
                    file.unlink()
                    self.assertIn(step, self.would_run(), f"{name} removed")
                    self.assertIn(f"{step}/manifest.json: {name} is not there\n", self.make("why", step).stdout)
                file.write_bytes(kept)
                os.utime(file, (stamp.st_atime, stamp.st_mtime))
        self.assertEqual(self.would_run(), [])

    def test_content_counts_where_the_time_does_not_tell(self):
        """`cp -p` of an edited file keeps its time; a file that is written again with the same content counts as unchanged."""
        readers = {}
        for step in STEPS:
            for name in self.inputs(step):
                readers.setdefault(name, step)  # the first that read it; later ones read what that makes
        earlier = self.root / "earlier"
        for name, step in readers.items():
            file = self.root / name
            kept, stamp = file.read_bytes(), file.stat()
            for content in (kept + b"\n# another\n", kept):
                earlier.write_bytes(content)
                os.utime(earlier, (stamp.st_atime, stamp.st_mtime))
                shutil.copy2(earlier, file)
                if content != kept:
                    self.assertIn(step, self.would_run(), name)
                    self.assertIn(f"{step}/manifest.json: {name} has changed\n", self.make("why", step).stdout)
        self.assertEqual(self.would_run(), [])
        self.assertEqual(self.make("why", "s9").stdout, "s9_diagnosis: up to date\n")

    def test_only_the_steps_that_read_a_file_run_again(self):
        file = self.root / "my_causes/mass.toml"
        stamp = file.stat()
        os.utime(file, (time.time() + 10, time.time() + 10))
        self.assertEqual(self.would_run(), ["s9_diagnosis"])
        os.utime(file, (stamp.st_atime, stamp.st_mtime))

    def test_a_cause_that_is_added_counts(self):
        added = self.root / "my_causes/cable.toml"
        shutil.copyfile(ROOT / "workflows/common/hypotheses/cable.toml", added)
        os.utime(added, (time.time() + 10, time.time() + 10))
        self.assertEqual(self.would_run(), ["s9_diagnosis"])
        added.unlink()
        self.assertEqual(self.would_run(), [])

    def test_a_step_that_ran_without_the_file_is_up_to_date(self):
        """The cause is gone, the step runs once and no more; verify names the file until then."""
        cause = self.root / "my_causes/mass.toml"
        kept = cause.read_bytes()
        cause.unlink()
        self.assertEqual(self.make("s9").returncode, 0)
        self.assertNotIn("my_causes/mass.toml", self.inputs("s9_diagnosis"))
        self.assertEqual(self.would_run(), [])
        cause.write_bytes(kept)
        os.utime(cause, (time.time() + 10, time.time() + 10))
        self.assertEqual(self.would_run(), ["s9_diagnosis"])
        os.utime(cause)
        self.assertEqual(self.make("s9").returncode, 0)
        self.assertEqual(self.would_run(), [])


class StudiesAndSteps(OfOneStudy):
    def fault(self, *arguments, line):
        done = self.make(*arguments)
        self.assertEqual(done.returncode, 2, arguments)
        self.assertEqual((done.stderr.count("\n"), done.stdout), (1, ""), done.stderr)
        self.assertIn(line, done.stderr)

    def with_steps(self, text):
        self.addCleanup(self.study.write_text, self.study.read_text())
        self.study.write_text(f'title = "mine"\n{text}\n[model]\nfolder = "data/mine/model"\n')

    def test_a_study_that_is_not_there_is_one_line_with_those_that_are(self):
        here = " ".join(sorted(p.parent.name for p in self.root.glob("workflows/*/study.toml")))
        for goal in (("steps",), ("s6",), ("all",), ("report",), ("why", "s6")):
            self.fault(*goal, "STUDY=nosuch", line=f"there is no study 'nosuch' (workflows/nosuch/study.toml); there are: {here}")
        self.assertEqual(self.make("help", "STUDY=nosuch").returncode, 0)

    def test_a_step_that_is_commented_out_does_not_run(self):
        self.with_steps('steps = ["s1_model",  # "s5_sensitivity"\n  # "s6_updating",\n  \'s4_refinement\']  # ["s7_aerodynamics"]\nfeatures = "results/mine/s3_identification/features"')
        said = self.make("-n", "-B", "steps").stdout
        self.assertEqual([step for step in ("s1", "s3", "s4", "s5", "s6", "s7", "s9") if f"{BIN}/{step}_" in said], ["s1", "s4"])

    def test_a_mistyped_step_is_named_with_its_line_and_the_steps_there_are(self):
        self.with_steps('steps = ["s1_model",\n  "s4_refinment"]')
        for goal in (("steps",), ("s1",), ("why", "s1")):
            self.fault(*goal, line="workflows/mine/study.toml:3: steps: there is no step 's4_refinment'; there are: s0_campaign s1_model ")

    def test_a_list_that_is_none(self):
        for text, line in (('steps = "s1_model"', "study.toml:2: steps: expected a list"), ("steps = []", "lists no steps"), ("", "lists no steps")):
            self.with_steps(text)
            self.fault("steps", line=line)

    def test_why_says_what_make_cannot_do(self):
        nowhere = self.root / "nowhere"
        said = self.make("why", "s4", executables=nowhere)
        self.assertIn(f"s4_refinement/manifest.json: {nowhere}/s4_refinement is not there\n", said.stdout)
        rules = self.root / "workflows/mine/study.mk"
        rules.write_text("INPUTS_s4_refinement += no/such/file\n")
        self.addCleanup(rules.unlink)
        said = self.make("why", "s4")
        self.assertEqual(said.returncode, 2)
        self.assertIn("why: make cannot make s4_refinement: No rule to make target 'no/such/file'", said.stderr)
        self.assertNotIn("up to date", said.stdout)


if __name__ == "__main__":
    unittest.main()
