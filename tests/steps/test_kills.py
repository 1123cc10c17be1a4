"""Runs that are killed at random moments: steps and make, by SIGKILL, SIGTERM and SIGINT.

Oracles: whatever lies in a step's folder afterwards is what its manifest says, byte by byte; the make that follows completes, leaves no
partial folder behind, and ends with the bytes of a run that was never disturbed. TWINDECK_KILLS=200 kills that often (about a quarter of an
hour); TWINDECK_KILLS_SEED draws other moments.
"""
import hashlib
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
KILLS = int(os.environ.get("TWINDECK_KILLS", "6"))
SEED = int(os.environ.get("TWINDECK_KILLS_SEED", "1"))
SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
# No shell script: between fork and exec of `sleep`, dash takes an interrupt for itself and its child goes on.
WAITING = """#!{python}
import pathlib, signal, time
signal.signal(signal.SIGINT, signal.SIG_DFL)
folder = pathlib.Path("{folder}")
folder.mkdir(parents=True, exist_ok=True)
(folder / "manifest.json").write_text("{{}}")
time.sleep(60)
"""


def alive(group):
    """Whether a process of this group runs."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


def digest(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def content(results):
    """Every file's hash; of a manifest, which holds seconds and hashes of inputs with their manifests', the outputs' hashes."""
    out = {}
    for file in sorted(results.rglob("*")):
        if file.is_file() and file.name != ".measured":
            out[str(file.relative_to(results))] = json.loads(file.read_text())["outputs"] if file.name == "manifest.json" else digest(file)
    return out


class Kills(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.workflow = cls.folder / "smoke"
        shutil.copytree(ROOT / "workflows" / "smoke", cls.workflow)
        begin = time.monotonic()
        cls.finish(cls.folder / "undisturbed")
        cls.seconds = time.monotonic() - begin
        cls.wanted = content(cls.folder / "undisturbed")

    @classmethod
    def command(cls, results):
        return ["make", "--no-print-directory", "steps", "STUDY=smoke", "NO_BUILD=1", f"BIN={BIN}", f"RESULTS={results}", f"WORKFLOW={cls.workflow}"]

    @classmethod
    def finish(cls, results):
        done = subprocess.run(cls.command(results), cwd=ROOT, capture_output=True, text=True)
        if done.returncode:
            raise AssertionError(done.stderr)

    def kill_once(self, results, chance):
        """Starts make with every step stale and ends the whole process group, or the step that runs alone, at some moment."""
        for file in self.workflow.glob("*.toml"):
            if chance.random() < 0.5:
                os.utime(file)
        process = subprocess.Popen(self.command(results), cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        time.sleep(chance.uniform(0.0, self.seconds))
        try:
            os.killpg(process.pid, chance.choice(SIGNALS))
        except ProcessLookupError:
            pass
        process.wait(timeout=60)
        while alive(process.pid):  # make has ended; a step that was asked to may still be at it
            time.sleep(0.01)

    def whole(self, results):
        """Every step's folder that is there holds what its manifest says, and nothing else."""
        for folder in results.iterdir():
            if not folder.is_dir() or ".partial-" in folder.name or ".unconverged" in folder.name:
                continue
            self.assertTrue((folder / "manifest.json").exists(), folder)
            outputs = json.loads((folder / "manifest.json").read_text())["outputs"]
            there = {str(f.relative_to(folder)) for f in folder.rglob("*") if f.is_file() and f.name != "manifest.json"}
            self.assertEqual(there, set(outputs), folder)
            for name, wanted in outputs.items():
                self.assertEqual(digest(folder / name), wanted, folder / name)

    def test_make_deletes_no_manifest_when_it_is_interrupted(self):
        """A step that has replaced its folder and not ended yet: here a program that waits then."""
        bin_folder, results = self.folder / "bin", self.folder / "interrupted"
        bin_folder.mkdir()
        waiting = bin_folder / "s1_model"
        waiting.write_text(WAITING.format(python=sys.executable, folder=results / "s1_model"))
        waiting.chmod(0o755)
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                manifest = results / "s1_model" / "manifest.json"
                manifest.unlink(missing_ok=True)
                process = subprocess.Popen(["make", "--no-print-directory", "s1", "STUDY=smoke", "NO_BUILD=1", f"BIN={bin_folder}", f"RESULTS={results}",
                                            f"WORKFLOW={self.workflow}"], cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                           start_new_session=True)
                while not manifest.exists() and process.poll() is None:
                    time.sleep(0.01)
                os.killpg(process.pid, number)
                process.wait(timeout=60)
                self.assertTrue(manifest.exists())

    def test_results_stay_whole_and_make_goes_on(self):
        chance = random.Random(SEED)
        results = self.folder / "killed"
        results.mkdir()
        for kill in range(KILLS):
            with self.subTest(kill):
                self.kill_once(results, chance)
                self.whole(results)
        self.finish(results)
        self.assertEqual(content(results), self.wanted)
        self.assertEqual([f.name for f in results.iterdir() if ".partial-" in f.name], [])


if __name__ == "__main__":
    unittest.main()
