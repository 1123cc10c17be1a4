"""One answer per question: a step run by hand with --study, --results and --out gives what make gives.

Oracles: the command lines that make would run (make -n), of which nothing but the contract's four options may be left; the bytes of a step
run both ways; --model, which is another way to the same.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import test_diagnosis as chain  # noqa: E402

ROOT, BIN = chain.ROOT, chain.BIN.resolve()
STUDIES = sorted(path.parent.name for path in ROOT.glob("workflows/*/study.toml"))


def make(*arguments):
    environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
    return subprocess.run(["make", "--no-print-directory", "NO_BUILD=1", f"BIN={BIN}", *arguments], cwd=ROOT, capture_output=True, text=True,
                          env=environment, timeout=300)


class CommandLines(unittest.TestCase):
    def test_make_adds_nothing_that_a_configuration_does_not_say(self):
        self.assertGreaterEqual(len(STUDIES), 9)
        for study in STUDIES:
            said = make("-n", "-B", "steps", f"STUDY={study}", "DATA=/tmp").stdout
            workflow, results = f"workflows/{study}", f"results/{study}"
            lines = [line for line in said.splitlines() if re.match(rf"{BIN}/(s\d_\w+) .* --out {results}/\1 ", line)]
            self.assertTrue(lines, study)
            for line in lines:
                token = re.match(rf"{BIN}/(s\d_\w+)", line)[1]
                self.assertEqual(line.split(), [f"{BIN}/{token}", "--study", workflow, "--results", results, "--out", f"{results}/{token}",
                                                "--threads", "2"])


class Diagnosis(unittest.TestCase):
    """Step 9 on a study whose configuration names the model."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.study, self.results = self.folder / "study", self.folder / "results"
        self.study.mkdir()
        (self.results / "inputs").mkdir(parents=True)
        chain.write_model(self.results / "inputs" / "model")
        chain.write_features(self.folder / "features", stiffness={"g3": 0.7})
        (self.study / "study.toml").write_text(f'title = "chain"\nfeatures = "{self.folder}/features"\nsteps = ["s9_diagnosis"]\n')
        self.configure("{results}/inputs/model")

    def configure(self, model):
        (self.study / "s9_diagnosis.toml").write_text(f'# a chain\nmodel = "{model}"\ncatalogue = "{ROOT}/workflows/common/hypotheses"\n')

    def run_step(self, name, *arguments):
        out = self.results / name
        done = subprocess.run([BIN / "s9_diagnosis", "--study", self.study, "--results", self.results, "--out", out, "--quiet", *arguments],
                              cwd=self.folder, capture_output=True, text=True, timeout=300)
        return done, out

    def outcome(self, name, *arguments):
        done, out = self.run_step(name, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        written = {str(p.relative_to(out)): p.read_bytes() for p in out.rglob("*") if p.is_file() and p.suffix != ".json"}
        result = json.loads((out / "diagnosis.json").read_text())
        result.pop("seconds")
        return result, written

    def test_the_configured_model_is_the_one_of_the_option(self):
        self.assertEqual(self.outcome("configured"), self.outcome("option", "--model", self.results / "inputs" / "model"))

    def test_the_option_goes_first(self):
        shutil.move(self.results / "inputs" / "model", self.folder / "elsewhere")
        self.assertEqual(self.outcome("option", "--model", self.folder / "elsewhere")[0]["verdict"], "named")

    def test_a_path_without_results_is_taken_as_it_stands(self):
        self.configure("results/inputs/model")
        self.assertEqual(self.run_step("s9_diagnosis")[0].returncode, 0)

    def test_a_model_that_is_not_there_is_named_with_its_key(self):
        self.configure("{results}/inputs/modell")
        done, out = self.run_step("s9_diagnosis")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn(f"s9_diagnosis.toml:2: model: is '{self.results}/inputs/modell', which is not there", done.stderr)
        self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
