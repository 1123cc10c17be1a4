"""What the machine or its limits do not allow: one line, exit code 2, nothing left behind, and an end.

Oracle: the exit code, the lines of stderr, the folder beside --out before and after. A limit under which a step still can work is answered by 0.
"""
import json
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

    def test_the_same_kernels_of_blas_on_every_processor(self):
        """As OpenBLAS itself tells them. A choice of the caller's stays."""
        if not {"avx2", "fma", "sse4_2"} <= set(pathlib.Path("/proc/cpuinfo").read_text().split()):
            self.skipTest("a processor without AVX2")
        for shell, kernels in (("unset OPENBLAS_CORETYPE", "Haswell"), ("export OPENBLAS_CORETYPE=Nehalem", "Nehalem")):
            command = f"{shell}; exec '{BIN}/s1_model' {STEPS['s1_model']} --out out --quiet"
            subprocess.run(["bash", "-c", command], cwd=self.folder, check=True)
            libraries = json.loads((self.folder / "out" / "manifest.json").read_text())["libraries"]
            if "OpenBLAS" not in libraries:
                self.skipTest("another BLAS than OpenBLAS")
            self.assertEqual(libraries["OpenBLAS kernels"], kernels)

    def test_a_name_that_is_too_long(self):
        for model, out in ((300 * "a", "out/x"), ("model", 300 * "a")):
            done = subprocess.run([BIN / "s1_model", "--model", model, "--out", out], cwd=self.folder, capture_output=True, text=True)
            self.refused(done, "too long for the file system")

    def test_few_open_files(self):
        for files in range(5, 24):
            done = self.run_step("s1_model", f"ulimit -n {files}", "--quiet")
            if done.returncode != 0:
                self.refused(done, "raise the limit: ulimit -n 256")
            else:
                self.assertGreater(files, 15)
        self.assertEqual(self.run_step("s1_model", "ulimit -n 256", "--quiet").returncode, 0)

    def test_a_file_that_is_too_long_is_refused_before_it_is_read(self):
        """Forty gigabytes of a file with holes: to read it once takes a minute and more."""
        for name, step, options in (("deck.inp", "s1_model", "--model deck.inp"), ("features/rows.csv", "s6_updating", STEPS["s6_updating"]),
                                    ("model/notes.csv", "s1_model", STEPS["s1_model"])):
            file = self.folder / name
            kept = file.read_bytes() if file.exists() else None
            with open(file, "ab") as stream:
                stream.truncate(40_000_000_000)
            done = subprocess.run(["bash", "-c", f"exec '{BIN}/{step}' {options} --out out/x"], cwd=self.folder, capture_output=True, text=True, timeout=20)
            self.refused(done, f"{name}: has 40.0 GB, expected at most 2 GB")
            file.unlink()
            if kept is not None:
                file.write_bytes(kept)

    def test_thousands_of_channels(self):
        folder = self.folder / "many"
        folder.mkdir()

        def campaign(n, setups):
            names = [f"c{i}" for i in range(n)]
            (folder / "channels.csv").write_text("channel,unit,reference\n" + "".join(f"{name},m/s2,{int(i == 0)}\n" for i, name in enumerate(names)))
            own = [[names[0]] + [name for i, name in enumerate(names[1:]) if i % setups == s] for s in range(setups)]
            text = ""
            for s, channels in enumerate(own):
                np.save(folder / f"{s}.npy", np.random.default_rng(s).standard_normal((6000, len(channels))).astype("f4"))
                text += f'[[record]]\nsetup = "S{s}"\nfile = "{s}.npy"\nsampling_rate_Hz = 50.0\nchannels = {channels}\n'.replace("'", '"')
            (folder / "campaign.toml").write_text(text)
            return subprocess.run([BIN / "s3_identification", "--campaign", folder, "--out", self.folder / "out/x", "--check", "--quiet"], capture_output=True,
                                  text=True, timeout=20)

        self.refused(campaign(5000, 1), "campaign.toml:5: channels: 5000 response channels are to be identified together, expected at most 500")
        done = campaign(501, 2)  # the remedy: two setups that share a reference
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_messages_tell_nothing_of_a_file_that_is_no_deck(self):
        texts = ("root:$6$SALT9fQ7xR2mW4kZ:19000:0:99999:7:::\ndaemon:*:1:::\n", "*aSALT9fQ7xR2mW4kZ,SALT9fQ7xR2mW4kZ=SALT9fQ7xR2mW4kZ\nSALT9fQ7xR2mW4kZ\n*Y\n", "*$6$SALT9fQ7xR2mW4kZ, x\n",
                 "HOME=/root\0SECRET=SALT9fQ7xR2mW4kZ\0PATH=/bin\0", "HOME=/root\nSECRET=SALT9fQ7xR2mW4kZ\nTOKEN SALT9fQ7xR2mW4kZ\n", "-----BEGIN KEY-----\nSALT9fQ7xR2mW4kZSALT9fQ7xR2mW4kZ\n")
        for ending in (".inp", ".bdf", ".dat", ".cdb", ".s2k"):
            for text in texts:
                file = self.folder / f"deck{ending}"
                file.write_text(text)
                done = subprocess.run([BIN / "s1_model", "--model", file, "--out", self.folder / "out/x"], capture_output=True, text=True, timeout=20)
                self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
                self.assertNotIn("SALT9fQ7xR2mW4kZ", done.stderr)

    def test_a_limit_of_the_size_of_files(self):
        self.refused(self.run_step("s1_model", "ulimit -f 1", "--quiet"), "cannot be written")

    def test_a_reader_of_the_lines_that_has_gone(self):
        """The reading end of the pipe is closed before the step starts: no race between the two. Results or none, and no other folder."""
        reading, writing = os.pipe()
        os.close(reading)
        done = subprocess.run([BIN / "s6_updating", *STEPS["s6_updating"].split(), "--out", "out/s6_updating"], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=writing, timeout=120)
        os.close(writing)
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
