"""The chain through make: what reruns, and that its bytes do not depend on the number of threads.

Oracle: modification times of the manifests (a step that did not run left its manifest alone) and the bytes of every CSV.
"""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))


class Chain(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.workflow = cls.folder / "workflow"
        shutil.copytree(ROOT / "workflows" / "smoke", cls.workflow)
        cls.results = cls.folder / "results"
        cls.run_steps(cls.results)

    @classmethod
    def run_steps(cls, results, jobs=1, threads=2):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
        done = subprocess.run(
            ["make", "--no-print-directory", "steps", "STUDY=smoke", "NO_BUILD=1", f"-j{jobs}", f"THREADS={threads}", f"BIN={BIN}",
             f"WORKFLOW={cls.workflow}", f"RESULTS={results}"], cwd=ROOT, capture_output=True, text=True, env=environment)
        if done.returncode:
            raise AssertionError(f"make failed with {done.returncode}:\n{done.stdout}\n{done.stderr}")

    def stamps(self):
        return {m.parent.name: m.stat().st_mtime_ns for m in self.results.glob("*/manifest.json")}

    def reruns_after_touching(self, path):
        before = self.stamps()
        path.touch()
        self.run_steps(self.results)
        after = self.stamps()
        return {step for step in after if after[step] != before[step]}

    def test_every_step_has_a_manifest(self):
        self.assertEqual(set(self.stamps()), {"s0_campaign", "s1_model", "s2_sensors", "s3_identification", "s4_refinement", "s5_sensitivity", "s6_updating", "s7_aerodynamics", "s8_validation"})

    def test_a_second_run_runs_no_step(self):
        before = self.stamps()
        self.run_steps(self.results)
        self.assertEqual(self.stamps(), before)

    def test_touching_one_configuration_reruns_that_step_and_what_depends_on_it(self):
        self.assertEqual(self.reruns_after_touching(self.workflow / "s6_updating.toml"), {"s6_updating", "s7_aerodynamics", "s8_validation"})
        self.assertEqual(self.reruns_after_touching(self.workflow / "s5_sensitivity.toml"), {"s5_sensitivity", "s6_updating", "s7_aerodynamics", "s8_validation"})

    def test_same_bytes_whatever_the_jobs_and_threads(self):
        other = self.folder / "other"
        self.run_steps(other, jobs=2, threads=1)
        names = {p.relative_to(self.results) for p in self.results.rglob("*.csv")}
        self.assertEqual(names, {p.relative_to(other) for p in other.rglob("*.csv")})
        self.assertTrue(names)
        different = [str(n) for n in sorted(names) if (self.results / n).read_bytes() != (other / n).read_bytes()]
        self.assertEqual(different, [])



class WhatIsCompiled(unittest.TestCase):
    """`make sN` compiles step N and those before it. Oracle: the table of what each step reads of earlier ones, followed by hand."""

    def compiled(self, *goals):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
        said = subprocess.run(["make", "-n", *goals, f"RESULTS={tempfile.gettempdir()}/no_such_results"], cwd=ROOT, capture_output=True, text=True,
                              env=environment).stdout
        return set(said.split("--target ")[1].split("\n")[0].split())

    def test_a_step_alone(self):
        self.assertEqual(self.compiled("s1"), {"s1_model"})
        self.assertEqual(self.compiled("look"), {"s1_model"})

    def test_a_step_and_those_before_it(self):
        self.assertEqual(self.compiled("s2", "s6", "STUDY=smoke"), {"s1_model", "s2_sensors", "s4_refinement", "s5_sensitivity", "s6_updating"})

    def test_a_dry_run_writes_nothing(self):
        """Not even which measured modes were asked for; what it prints is what a run would do."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        measured, results = folder / "measured", folder / "results"
        measured.mkdir()
        (measured / "modes.csv").write_text("mode,frequency_Hz,frequency_std_Hz\n1,1.0,0.01\n")
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}

        def make(*arguments):
            return subprocess.run(["make", "--no-print-directory", "NO_BUILD=1", f"BIN={BIN}", f"RESULTS={results}", *arguments], cwd=ROOT,
                                  capture_output=True, text=True, env=environment).stdout

        self.assertIn(f"--modes '{measured}'", make("-n", "s4", f"MODES={measured}"))
        self.assertFalse(results.exists())
        make(f"{results}/.measured", f"MODES={measured}")
        stamp = results / ".measured"
        self.assertEqual(stamp.read_text(), f"measured: --modes '{measured}'\n")
        before = stamp.stat().st_mtime_ns
        make(f"{results}/.measured", f"MODES={measured}")
        self.assertEqual(stamp.stat().st_mtime_ns, before, "written again though nothing changed")
        self.assertIn("measured:", make("-n", f"{results}/.measured"))
        self.assertEqual(stamp.stat().st_mtime_ns, before)
        make(f"{results}/.measured")
        self.assertEqual(stamp.read_text().strip(), "measured:")

    def test_everything_when_something_else_is_asked_for_too(self):
        for goals in (["build"], ["s1", "tables"], ["all"]):
            self.assertEqual(self.compiled(*goals), {"executables"}, goals)


if __name__ == "__main__":
    unittest.main()


class Unconverged(unittest.TestCase):
    def test_the_remedy_that_a_step_names_works_for_the_whole_study(self):
        """One iteration is too few for any search. What did not converge is marked, and the next step reads it."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

        def twindeck(*words):
            environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
            return subprocess.run([ROOT / "packaging/twindeck", *words], cwd=folder, capture_output=True, text=True, env=environment)

        self.assertEqual(twindeck("new", "mine").returncode, 0)
        with (folder / "workflows/mine/s6_updating.toml").open("a") as config:
            config.write("\nmax_iterations = 1\nouter_iterations = 1\n")
        refused = twindeck("run", "mine", "s9", f"BIN={BIN}")
        self.assertEqual(refused.returncode, 2, refused.stderr)
        self.assertIn("or publish it with --accept-unconverged", refused.stderr)
        self.assertFalse((folder / "results/mine/s9_diagnosis").exists())
        accepted = twindeck("run", "mine", "s9", f"BIN={BIN}", "--accept-unconverged")
        self.assertEqual(accepted.returncode, 0, accepted.stderr)
        self.assertEqual(json.loads((folder / "results/mine/s6_updating/manifest.json").read_text())["status"], "unconverged")
        self.assertTrue((folder / "results/mine/s9_diagnosis/diagnosis.json").exists())
