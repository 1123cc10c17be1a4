"""What the machine or its limits do not allow: one line, exit code 2, nothing left behind, and an end.

Oracle: the exit code, the lines of stderr, the folder beside --out before and after. A limit under which a step still can work is answered by 0.
"""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
STEPS = {"s1_model": "--model model", "s3_identification": "--campaign campaign", "s6_updating": "--model model --features features"}


class Limits(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for part in ("model", "campaign", "features"):
            shutil.copytree(ROOT / "data/template" / part, self.folder / part)

    def run_step(self, step, limit="", more="", **environment):
        """Under a limit of the shell's. Whatever happens, nothing may lie beside the results; without exit code 0 no results either."""
        command = f"{limit}\nexec '{BIN}/{step}' {STEPS.get(step, '')} --out out/{step} {more}"
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, env={**os.environ, **environment}, capture_output=True, text=True, timeout=120)
        left = sorted(p.name for p in (self.folder / "out").glob("*"))
        self.assertEqual(left, [step] if done.returncode == 0 else [], (limit, more, done.stderr))
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        return done

    def refused(self, done, words):
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn(words, done.stderr)

    def test_little_memory_ends_every_step(self):
        for step in STEPS:
            for megabytes in (200, 235, 400, 500):
                for threads in (1, 2):
                    done = self.run_step(step, f"ulimit -v {megabytes}000", f"--threads {threads} --quiet")
                    if megabytes == 200 or (megabytes, threads) in ((235, 2), (400, 2)):
                        self.refused(done, "--threads: needs")
                    elif megabytes >= 400:
                        self.assertEqual(done.returncode, 0, done.stderr)
                    elif done.returncode != 0:
                        self.refused(done, "memory")

    def test_as_many_threads_as_the_memory_is_for(self):
        self.assertEqual(self.run_step("s1_model", "ulimit -v 400000").returncode, 0)

    def test_a_small_stack(self):
        self.refused(self.run_step("s1_model", "ulimit -s 64"), "the stack is limited to 64 kB")
        for size in ("16k", "1"):
            self.assertEqual(self.run_step("s6_updating", "", "--threads 2", OMP_STACKSIZE=size).returncode, 0)

    def test_a_name_that_is_too_long(self):
        for model, out in ((300 * "a", "out/x"), ("model", 300 * "a")):
            done = subprocess.run([BIN / "s1_model", "--model", model, "--out", out], cwd=self.folder, capture_output=True, text=True)
            self.refused(done, "too long for the file system")

    def test_a_limit_of_the_size_of_files(self):
        self.refused(self.run_step("s1_model", "ulimit -f 1", "--quiet"), "cannot be written")

    def test_a_reader_of_the_lines_that_has_gone(self):
        """The first line of a step that says many; its reader ends at once. Results or none, and no other folder."""
        command = f"'{BIN}/s6_updating' {STEPS['s6_updating']} --out out/s6_updating 2>&1 >/dev/null | sleep 0; exit ${{PIPESTATUS[0]}}"
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual((done.returncode, list((self.folder / "out").glob("*"))), (2, []))

    @unittest.skipUnless(pathlib.Path("/dev/full").exists(), "no /dev/full here")
    def test_printing_to_a_full_device(self):
        for asked in ("--help", "--version", "--describe", "--print-config", "--model model --out out/x --check"):
            done = subprocess.run(["bash", "-c", f"'{BIN}/s1_model' {asked} >/dev/full"], cwd=self.folder, capture_output=True, text=True, timeout=60)
            self.refused(done, "standard output: cannot be written: No space left on device")
        for asked in ("--help", "--version"):
            done = subprocess.run(["bash", "-c", f"'{ROOT}/packaging/twindeck' {asked} >/dev/full"], cwd=self.folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 2, done.stderr)

    def test_samples_whose_squares_are_zero(self):
        file = self.folder / "campaign/records/wind.npy"
        record = np.load(file).astype(float)
        for factor in (1e-200, 1e-310):
            np.save(file, record * factor)
            self.refused(self.run_step("s3_identification", "", "--quiet"), "records/wind.npy: A_x: holds nothing above")


if __name__ == "__main__":
    unittest.main()
