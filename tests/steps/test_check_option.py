"""--check: every step reads and validates its inputs, tells what would run, and computes and writes nothing; make check does so for a study.

Oracles: the listing of the working folder before and after, with sizes, times and bytes; the manifest of the earlier run; what the steps of the
shipped studies read, by hand. That a bad input is answered as by the run is held by tests/broken_inputs, case by case. The sound inputs here are
copies of its bases.
"""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
BASES = ROOT / "tests" / "broken_inputs" / "bases"
STUDIES = sorted(path.parent.name for path in ROOT.glob("workflows/*/study.toml"))

# step: (base, command line, folders and files that the plan names)
STEPS = {
    "s0_campaign": ("study", "--study study --set points={root}/data/ponte_del_mare/layout/points.csv --set setups={root}/data/ponte_del_mare/layout/setups.csv "
                    "--set bridge={root}/data/ponte_del_mare/virtual/bridge.toml", ["data/ponte_del_mare/layout", "virtual/bridge.toml"]),
    "s1_model": ("model", "--model model", ["files of model:"]),
    "s2_sensors": ("deck", "--study study --model model", ["files of model:", "files of layout:"]),
    "s3_identification": ("campaign", "--campaign campaign --set block_rows=10 --set maximum_order=14", ["campaign/records/wind.csv:"]),
    "s4_refinement": ("features", "--model model --features features", ["files of model:", "files of features:"]),
    "s5_sensitivity": ("features", "--model model", ["files of model:"]),
    "s6_updating": ("features", "--model model --features features", ["files of model:", "files of features:"]),
    "s7_aerodynamics": ("deck", "--study study --model model", ["files of model:", "files of aero:"]),
    "s8_validation": ("deck", "--study study --model model --results results", ["files of aero:", "wind/turbulence_sets.csv:", "s7_aerodynamics/sets.csv:"]),
    "s9_diagnosis": ("features", "--model model --features features --catalogue catalogue", ["files of features:", "files of catalogue:"]),
}


def listing(folder):
    """Names with size and time of change, and the bytes of files."""
    return {str(path.relative_to(folder)): (path.stat().st_size, path.stat().st_mtime_ns, path.read_bytes() if path.is_file() else b"")
            for path in sorted(folder.rglob("*"))}


def write_record(file):
    """80 s at 50 Hz of numbers that do not repeat, for the channels of the base's campaign."""
    channels = [line.split(",")[0] for line in (file.parents[1] / "channels.csv").read_text().splitlines()[1:]]
    lines = [",".join(["time_s", *channels])]
    lines += [",".join([f"{k / 50.0:g}", *(str((k * (17 + 6 * c)) % 4999 - 2499) for c in range(len(channels)))]) for k in range(4000)]
    file.parent.mkdir(exist_ok=True)
    file.write_text("\n".join(lines) + "\n")


class SoundInputs(unittest.TestCase):
    def lay(self, step):
        """The sound input of a step in a folder of its own. @return folder, command line"""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        base, line, _ = STEPS[step]
        shutil.copytree(BASES / base, folder, dirs_exist_ok=True)
        if base == "campaign":
            write_record(folder / "campaign" / "records" / "wind.csv")
        return folder, line.format(root=ROOT).split()

    def run_step(self, step, folder, *words):
        done = subprocess.run([BIN / step, "--out", f"out/{step}", *words], cwd=folder, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, f"{step}: {done.stderr}")
        return done

    def check(self, step, folder, *words):
        before = listing(folder)
        done = self.run_step(step, folder, "--check", *words)
        self.assertEqual(listing(folder), before, f"{step} --check has changed something")
        return done.stdout

    def test_every_step_tells_its_plan_and_writes_nothing(self):
        for step, (_, _, named) in STEPS.items():
            with self.subTest(step):
                folder, line = self.lay(step)
                plan = self.check(step, folder, *line)
                self.assertTrue(plan.startswith(f"{step}: inputs are valid; nothing was computed or written\n  would run: "), plan)
                for words in [*named, f"would write: out/{step}\n", "takes: not known: there is no earlier run\n"]:
                    self.assertIn(words, plan)
                self.assertFalse((folder / "out").exists())
                self.assertEqual(self.check(step, folder, *line, "--quiet"), "")

    def test_every_help_shows_it(self):
        for step in STEPS:
            with self.subTest(step):
                said = subprocess.run([BIN / step, "--help"], capture_output=True, text=True, timeout=60).stdout
                self.assertIn("--check", said.split("Examples:")[0])
                self.assertRegex(said, rf"\n  {step} .* --check\n")

    def test_the_time_is_that_of_the_run_whose_results_lie_there(self):
        folder, line = self.lay("s1_model")
        self.run_step("s1_model", folder, *line, "--set", "n_modes=4")
        seconds = json.loads((folder / "out" / "s1_model" / "manifest.json").read_text())["seconds"]
        plan = self.check("s1_model", folder, *line, "--set", "n_modes=4")
        self.assertIn(f"takes: about {seconds:.1f} s, as the earlier run did\n", plan)
        self.assertIn("would write: out/s1_model, in place of the results there\n", plan)
        self.assertIn("as the earlier run of another configuration did\n", self.check("s1_model", folder, *line, "--set", "n_modes=3"))


class MakeCheck(unittest.TestCase):
    def setUp(self):
        self.results = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "results"

    def make(self, study, *arguments):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
        return subprocess.run(["make", "--no-print-directory", "check", "NO_BUILD=1", f"BIN={BIN}", f"STUDY={study}", f"RESULTS={self.results}",
                               *arguments], cwd=ROOT, capture_output=True, text=True, env=environment, timeout=600)

    def first_lines(self, study):
        """{step: what is said of it}, in the order of the steps; the study must pass and nothing be written."""
        done = self.make(study)
        self.assertEqual(done.returncode, 0, study + ": " + done.stdout + done.stderr)
        self.assertFalse(self.results.exists(), study)
        return dict(line.split(": ", 1) for line in done.stdout.splitlines() if line[:1] == "s")

    def test_every_step_of_every_shipped_study(self):
        self.assertGreaterEqual(len(STUDIES), 9)
        for study in STUDIES:
            with self.subTest(study):
                said = self.first_lines(study)
                listed = (ROOT / "workflows" / study / "study.toml").read_text().split("steps = [")[1].split("]")[0]
                self.assertEqual(list(said), [word.strip('" \n') for word in listed.split(",")])

    def test_a_study_that_is_not_there(self):
        done = self.make("no_such_study")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("there is no study 'no_such_study' (workflows/no_such_study/study.toml)", done.stderr)

    def test_what_can_be_checked_before_anything_ran(self):
        said = self.first_lines("smoke")
        waits = {step: words.split("inputs wait for ")[1] for step, words in said.items() if "inputs wait for " in words}
        self.assertEqual(waits, {"s2_sensors": "s1_model", "s3_identification": "s0_campaign", "s4_refinement": "s1_model",
                                 "s5_sensitivity": "s4_refinement", "s6_updating": "s4_refinement s5_sensitivity", "s7_aerodynamics": "s6_updating",
                                 "s8_validation": "s0_campaign s6_updating s7_aerodynamics"})
        for step in ("s0_campaign", "s1_model"):
            self.assertEqual(said[step], "inputs are valid; nothing was computed or written")

    def test_a_step_is_checked_once_its_inputs_are_there(self):
        subprocess.run([BIN / "s1_model", "--study", "workflows/smoke", "--out", self.results / "s1_model", "--quiet"], cwd=ROOT, check=True, timeout=300)
        done = self.make("smoke")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([path.name for path in self.results.iterdir()], ["s1_model"])
        for step in ("s2_sensors", "s4_refinement"):
            self.assertIn(f"{step}: inputs are valid", done.stdout)
        measured = self.make("smoke", f"FEATURES={self.results}")  # measured modes of one's own that are not there: no results to wait for
        self.assertEqual(measured.returncode, 2, measured.stdout)
        self.assertIn("s4_refinement: ", measured.stderr)

    def test_what_is_wrong_is_a_failure_and_the_others_are_checked_all_the_same(self):
        study = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        shutil.copytree(ROOT / "workflows" / "smoke", study, dirs_exist_ok=True)
        (study / "s1_model.toml").write_text("n_mode = 4\n")
        (study / "s5_sensitivity.toml").write_text("n_mode = 4\n")
        done = self.make("smoke", f"WORKFLOW={study}")
        self.assertEqual(done.returncode, 2)
        for step in ("s1_model", "s5_sensitivity"):
            self.assertIn(f"{step}.toml:1: unknown key 'n_mode'", done.stderr)
        self.assertIn("s6_updating: configuration is valid; inputs wait for", done.stdout)


if __name__ == "__main__":
    unittest.main()
