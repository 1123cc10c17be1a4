"""Many runs as Snakemake jobs; skipped where Snakemake is not installed.

Oracles: the same executable run by hand with the same seed and value; blind trials in one run (TWINDECK_SLOW=1: some minutes); for the
adding up of scores, what the program itself prints of one chunk, and proportions of sums done by hand.
"""
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
SNAKEMAKE = shutil.which("snakemake")
sys.path.insert(0, str(ROOT / "workflows" / "batch"))
import blind_score  # noqa: E402

# As blind_trials prints it, shortened.
CHUNK = """350 rows, truth on 10248 dofs, diagnosis on 6468 dofs
   7 named     D    30.5 chi2/dof 1.06 p 0.995 s   8.4  1.56 s | effect seed 7; dampk@damper:B2 (2.742e+05) | found dampk@damper:B2
   8 none      D    -3.5 chi2/dof 0.92 p 0.847 s   0.0  0.55 s | null seed 8 | found nothing

by family: cases, detected, family named, truth in the reported set
  (null)          1    0    0    0
  dampk           1    1    1    1

score, exact 95 % intervals
  false alarms on nulls (a name or unknown)                     0/1      0.0 %  [  0.0,  97.5]  target <=   2 %  held
  detection, 6 sigma and above                                  1/1    100.0 %  [  2.5, 100.0]  target >=  97 %  held
  both of two causes named                                      0/0      0.0 %  [  0.0, 100.0]  target >=  75 %  no case
  mean size of the reported set 2.00 (target <= 1.5); slowest trial 1.56 s (target <= 5 s)
targets held
"""


def score_lines(text):
    return [line for line in text.splitlines() if blind_score.SCORE.match(line)]


def trials(text):
    """Trial lines without the seconds that they took."""
    return [re.sub(r" +[\d.]+ s \|", " |", line) for line in text.splitlines() if blind_score.TRIAL.match(line)]


def added_up(*texts):
    with tempfile.TemporaryDirectory() as folder:
        files = [pathlib.Path(folder) / f"{i}.txt" for i in range(len(texts))]
        for file, text in zip(files, texts):
            file.write_text(text, encoding="utf-8")
        return subprocess.run(
            [sys.executable, ROOT / "workflows/batch/blind_score.py", *files], capture_output=True, text=True, check=True
        ).stdout


class Scores(unittest.TestCase):
    def test_one_chunk_gives_what_the_program_prints(self):
        told = added_up(CHUNK)
        self.assertEqual(score_lines(told), score_lines(CHUNK))
        self.assertEqual(trials(told), trials(CHUNK))
        for line in ("  (null)          1    0    0    0", "  dampk           1    1    1    1", "targets held"):
            self.assertIn(line, told.splitlines())

    def test_chunks_add(self):
        """1 of 1 and 0 of 4 are 1 of 5; the exact interval of 1 of 5 is 0.5 to 71.6 %, wholly below a target of 97 %."""
        other = (
            CHUNK.replace("   7 named", "   9 none ")
            .replace("   8 none", "  10 none")
            .replace("1/1    100.0 %  [  2.5, 100.0]", "0/4      0.0 %  [  0.0,  60.2]")
        )
        told = added_up(other, CHUNK)
        self.assertIn(
            "detection, 6 sigma and above                                  1/5     20.0 %  [  0.5,  71.6]  target >=  97 %  MISSED",
            told,
        )
        self.assertEqual(
            [int(blind_score.TRIAL.match(line)[1]) for line in told.splitlines() if blind_score.TRIAL.match(line)],
            [7, 8, 9, 10],
        )
        self.assertIn("  dampk           2    2    2    2", told)
        self.assertIn("a target is missed", told)


def slurm_answers():
    """True where a Slurm controller runs that has a node, as one-node Slurm on this machine does."""
    if not shutil.which("sinfo"):
        return False
    try:
        done = subprocess.run(["sinfo", "--noheader", "--states=idle,mixed"], capture_output=True, text=True, timeout=20)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0 and bool(done.stdout.strip())


@unittest.skipUnless(SNAKEMAKE, "no Snakemake here (Debian: apt-get install --no-install-recommends snakemake)")
class Batch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        shutil.copytree(
            ROOT / "workflows" / "batch", cls.root / "workflows" / "batch", ignore=shutil.ignore_patterns("__pycache__")
        )
        shutil.copytree(ROOT / "data" / "template", cls.root / "data" / "template")

    def snakemake(self, *arguments, how=("-j2",)):
        done = subprocess.run(
            [SNAKEMAKE, "-s", "workflows/batch/Snakefile", *how, "--config", f"executables={BIN}", *arguments],
            cwd=self.root,
            capture_output=True,
            text=True,
            timeout=3600,
            env={**os.environ, "HOME": str(self.root), "OMP_NUM_THREADS": "1"},
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def test_runs_are_those_of_the_executable(self):
        self.snakemake("blind_trials=0")
        with open(self.root / "results/batch/trust_radius.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual(sorted({r["trust_radius"] for r in rows}), ["0.2", "1", "2"])
        out = self.root / "by_hand"
        subprocess.run(
            [
                BIN / "s6_updating",
                "--model",
                "data/template/model",
                "--features",
                "data/template/features",
                "--out",
                out,
                "--seed",
                "1",
                "--set",
                "trust_radius=0.2",
                "--threads",
                "1",
                "--quiet",
            ],
            cwd=self.root,
            check=True,
            timeout=300,
        )
        with open(out / "summary.csv", newline="") as stream:
            by_hand = [(r["quantity"], r["value"]) for r in csv.DictReader(stream)]
        self.assertEqual([(r["quantity"], r["value"]) for r in rows if r["trust_radius"] == "0.2"], by_hand)
        with open(self.root / "results/batch/updating_seeds.csv", newline="") as stream:
            self.assertEqual({r["seed"] for r in csv.DictReader(stream)}, {"1", "2", "3", "4"})
        self.assertIn("Nothing to be done", self.snakemake("blind_trials=0"))

    @unittest.skipUnless(slurm_answers(), "no Slurm answers here (sinfo); its profile is not tried")
    def test_slurm_gives_the_same_bytes(self):
        self.snakemake("blind_trials=0")
        here = {name: (self.root / f"results/batch/{name}.csv").read_bytes() for name in ("trust_radius", "updating_seeds")}
        self.snakemake("blind_trials=0", "results=results/slurm", how=("--profile", "workflows/batch/profile/slurm"))
        for name, content in here.items():
            self.assertEqual((self.root / f"results/slurm/{name}.csv").read_bytes(), content)

    @unittest.skipUnless(os.environ.get("TWINDECK_SLOW"), "some minutes: set TWINDECK_SLOW=1")
    def test_blind_trials_in_chunks_are_those_of_one_run(self):
        self.snakemake("blind_trials=4", "blind_chunk=2", "runs={}")
        chunked = (self.root / "results/batch/blind_trials.txt").read_text(encoding="utf-8")
        whole = subprocess.run([BIN / "blind_trials", "4", "1"], capture_output=True, text=True, timeout=3600).stdout
        self.assertEqual(trials(chunked), trials(whole))
        self.assertEqual(score_lines(chunked), score_lines(whole))


if __name__ == "__main__":
    unittest.main()
