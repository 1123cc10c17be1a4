"""The command line contract of every step, tried on s1_model (it stands on the same run_step as all others).

Oracle: the contract in src/runner/run_step.hpp: what is printed, exit codes, and that earlier results stay whole.
"""

import hashlib
import json
import os
import pathlib
import pty
import re
import signal
import subprocess
import tempfile
import time
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEP = pathlib.Path(os.environ["TWINDECK_BIN"]).resolve() / "s1_model"
STUDY = "workflows/smoke"  # the bridge on its coarse mesh
NEVER = pathlib.Path(tempfile.gettempdir()) / f"twindeck-never-written-{os.getpid()}"


def run(*arguments):
    return subprocess.run([STEP, *map(str, arguments)], cwd=ROOT, capture_output=True, text=True, timeout=300)


def fingerprint(folder):
    """Every file below a folder with its hash."""
    return {str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.rglob("*")) if p.is_file()}


def described_keys():
    """Keys of the configuration, from --describe: the lines that are not indented."""
    return re.findall(r"^([A-Za-z_][\w.]*): ", run("--describe").stdout, re.MULTILINE)


class Refusals(unittest.TestCase):
    def refused(self, *arguments):
        """Exit code 2, nothing on stdout, one line on stderr that begins with the step's token. Returns that line."""
        done = run(*arguments)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("s1_model: "), done.stderr)
        self.assertFalse(NEVER.exists())
        return done.stderr

    def test_unknown_option_names_the_nearest(self):
        line = self.refused("--out", NEVER, "--thread", "2")
        self.assertIn("command line: unknown option '--thread'; did you mean '--threads'?", line)

    def test_word_that_belongs_to_no_option(self):
        self.assertIn("'stray'", self.refused("stray"))

    def test_out_is_required(self):
        self.assertIn("--out: is missing", self.refused())

    def test_values_out_of_range(self):
        self.assertIn("--threads", self.refused("--out", NEVER, "--threads", "0"))
        self.assertIn("--seed", self.refused("--out", NEVER, "--seed", "-3"))

    def test_folders_that_are_not_there(self):
        for option in ("--study", "--model", "--campaign", "--modes", "--features"):
            self.assertIn("'/nonexistent/y' does not exist", self.refused("--out", NEVER, option, "/nonexistent/y"))
        self.assertIn("name a model folder or a deck that exists", self.refused("--out", NEVER, "--model", "/nonexistent/bridge.bdf"))
        self.assertIn(f"'{__file__}' is not a folder", self.refused("--out", NEVER, "--features", __file__))

    def test_unknown_key_of_set_names_the_nearest(self):
        key = max(described_keys(), key=len)
        line = self.refused("--out", NEVER, "--set", key[:-1] + "=1")
        self.assertIn(f"--set: unknown key '{key[:-1]}'; did you mean '{key}'?", line)

    def test_unknown_key_in_configuration_names_file_line_and_nearest(self):
        key = max((k for k in described_keys() if "." not in k), key=len)
        with tempfile.TemporaryDirectory() as folder:
            config = pathlib.Path(folder) / "s1_model.toml"
            config.write_text(f"# a comment\n{key[:-1]} = 1\n")
            line = self.refused("--study", folder, "--out", folder + "/out")
            self.assertIn(f"{config}:2: unknown key '{key[:-1]}'; did you mean '{key}'?", line)
            self.assertFalse((pathlib.Path(folder) / "out").exists())

    def test_broken_toml_names_file_and_line(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "s1_model.toml").write_text("\n\na = \n")
            self.assertIn("s1_model.toml:3: is no valid TOML", self.refused("--study", folder, "--out", folder + "/out"))

    def test_contradictory_study_is_refused(self):
        model = {"names more than one of generator, folder and inp": 'generator = "ponte"\nfile = "a"\nfolder = "b"\n', "names no model": "",
                 "names only one of generator and file": 'generator = "ponte"\n', "did you mean 'ponte'?": 'generator = "pont"\n'}
        for problem, lines in model.items():
            with tempfile.TemporaryDirectory() as folder:
                (pathlib.Path(folder) / "study.toml").write_text('title = "t"\n[model]\n' + lines)
                self.assertIn(problem, self.refused("--study", folder, "--out", NEVER))

    def test_describe_of_an_unknown_key(self):
        key = max(described_keys(), key=len)
        self.assertIn(f"did you mean '{key}'?", self.refused("--describe", key[:-1]))

    def test_foreign_folder_is_never_replaced(self):
        with tempfile.TemporaryDirectory() as folder:
            precious = pathlib.Path(folder) / "thesis.txt"
            precious.write_text("years of work")
            self.assertIn("holds no results of a step", self.refused("--study", STUDY, "--out", folder))
            self.assertEqual(precious.read_text(), "years of work")


class Answers(unittest.TestCase):
    def test_help_has_options_and_two_examples(self):
        done = run("--help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        examples = done.stdout.split("Examples:")[1].split("Exit codes")[0]
        self.assertGreaterEqual(sum("s1_model" in line for line in examples.splitlines()), 2)
        for option in ("study out results threads set seed quiet model campaign modes features accept-unconverged help version "
                       "print-config describe").split():
            self.assertIn("--" + option, done.stdout)

    def test_version(self):
        done = run("--version")
        self.assertEqual(done.returncode, 0)
        self.assertRegex(done.stdout, r"^s1_model \(twindeck\) \d+\.\d+\.\d+\n$")

    def test_describe_tells_each_key_once(self):
        keys = described_keys()
        self.assertTrue(keys)
        self.assertEqual(len(keys), len(set(keys)))
        one = run("--describe", keys[0])
        self.assertEqual(one.returncode, 0)
        self.assertTrue(one.stdout.startswith(keys[0] + ": "))
        self.assertEqual(run("--describe", "all").stdout, run("--describe").stdout)

    def test_print_config_reads_back(self):
        printed = run("--study", STUDY, "--print-config")
        self.assertEqual(printed.returncode, 0, printed.stderr)
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "s1_model.toml").write_text(printed.stdout)
            again = run("--study", folder, "--print-config")
        self.assertEqual(again.stdout, printed.stdout, again.stderr)


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = pathlib.Path(cls.folder.name) / "s1_model"
        cls.done = run("--study", STUDY, "--out", cls.out)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def setUp(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)

    def assert_only_earlier_results(self, before):
        self.assertEqual(fingerprint(self.out), before)
        self.assertEqual([p.name for p in self.out.parent.iterdir()], ["s1_model"])

    def test_every_line_is_prefixed(self):
        for line in self.done.stderr.splitlines():
            self.assertTrue(line.startswith("s1_model: "), line)

    def test_manifest_vouches_for_every_output(self):
        manifest = json.loads((self.out / "manifest.json").read_text())
        hashes = fingerprint(self.out)
        hashes.pop("manifest.json")
        self.assertEqual(manifest["outputs"], hashes)
        self.assertEqual(manifest["step"], "s1_model")
        self.assertEqual(manifest["status"], "converged")
        for path, digest in manifest["inputs"].items():
            self.assertEqual(hashlib.sha256((ROOT / path).read_bytes()).hexdigest(), digest, path)
        self.assertIn(STUDY + "/study.toml", manifest["inputs"])
        self.assertEqual(manifest["seed"], tomllib.loads((ROOT / STUDY / "study.toml").read_text())["seed"])

    def test_bad_input_leaves_earlier_results(self):
        before = fingerprint(self.out)
        self.assertEqual(run("--study", STUDY, "--out", self.out, "--set", "no_such_key=1").returncode, 2)
        self.assert_only_earlier_results(before)

    def test_interrupt_leaves_earlier_results(self):
        before = fingerprint(self.out)
        process = subprocess.Popen([STEP, "--study", STUDY, "--out", self.out, "--quiet"], cwd=ROOT, stderr=subprocess.DEVNULL)
        deadline = time.monotonic() + 60
        while not any(".partial-" in p.name for p in self.out.parent.iterdir()):
            self.assertLess(time.monotonic(), deadline, "the run never began to write")
            self.assertIsNone(process.poll(), "the run ended before it could be interrupted")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), -signal.SIGINT)
        self.assert_only_earlier_results(before)

    def test_a_killed_run_is_cleaned_up_by_the_next(self):
        """Its folder is left, as no signal could be caught; the next run of this step removes it, but not another step's."""
        before = fingerprint(self.out)
        process = subprocess.Popen([STEP, "--study", STUDY, "--out", self.out, "--quiet"], cwd=ROOT, stderr=subprocess.DEVNULL)
        left = self.out.parent / f"s1_model.partial-{process.pid}"
        deadline = time.monotonic() + 60
        while not left.exists():
            self.assertLess(time.monotonic(), deadline, "the run never began to write")
            self.assertIsNone(process.poll(), "the run ended before it could be killed")
        process.kill()
        process.wait(60)
        self.assertTrue(left.exists())
        other = self.out.parent / f"s2_sensors.partial-{process.pid}"
        other.mkdir()
        done = run("--study", STUDY, "--out", self.out, "--quiet")
        other.rmdir()
        self.assertEqual(done.returncode, 0, done.stderr)
        before.pop("manifest.json")
        after = fingerprint(self.out)
        after.pop("manifest.json")
        self.assertEqual(after, before)
        self.assertEqual([p.name for p in self.out.parent.iterdir()], ["s1_model"])

    def test_a_link_as_out_stays_a_link(self):
        with tempfile.TemporaryDirectory() as folder:
            disk, link = pathlib.Path(folder) / "disk" / "s1", pathlib.Path(folder) / "s1_model"
            disk.parent.mkdir()
            link.symlink_to(disk)
            for _ in range(2):  # first to a place that is not there yet, then over what is there
                done = run("--study", STUDY, "--out", link, "--quiet")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertTrue(link.is_symlink())
                self.assertTrue((disk / "manifest.json").is_file())
            self.assertEqual(sorted(p.name for p in disk.parent.iterdir()), ["s1"])
            self.assertEqual(sorted(p.name for p in pathlib.Path(folder).iterdir()), ["disk", "s1_model"])

    def test_results_do_not_depend_on_threads(self):
        with tempfile.TemporaryDirectory() as folder:
            other = pathlib.Path(folder) / "s1_model"
            done = run("--study", STUDY, "--out", other, "--threads", "1", "--quiet")
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            one, two = fingerprint(self.out), fingerprint(other)
        one.pop("manifest.json")
        two.pop("manifest.json")
        self.assertEqual(one, two)

    def test_changed_results_are_refused_as_input(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "changed"
            subprocess.run(["cp", "-r", self.out, copy], check=True)
            nodes = copy / "model" / "nodes.csv"
            nodes.write_text(nodes.read_text() + "\n")
            done = run("--model", copy / "model", "--out", pathlib.Path(folder) / "s1_model")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("nodes.csv: was changed after s1_model wrote it", done.stderr)


class Alive(unittest.TestCase):
    """A computation that reports nothing for seconds, seen on a terminal."""

    def on_a_terminal(self, *arguments):
        """What stands on a pseudo terminal when the step has ended."""
        ours, theirs = pty.openpty()
        step = subprocess.Popen([STEP, *map(str, arguments)], cwd=ROOT, stdout=theirs, stderr=theirs)
        os.close(theirs)
        seen = b""
        while True:
            try:
                part = os.read(ours, 4096)
            except OSError:  # the other end is closed
                break
            if not part:
                break
            seen += part
        os.close(ours)
        self.assertEqual(step.wait(300), 0, seen)
        return seen.decode()

    def test_a_silent_step_says_that_it_works(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        n = 150  # 136,000 degrees of freedom: seconds on any machine
        lines = ["*NODE"] + [f"{j * (n + 1) + i + 1}, {i}., {j}., 0." for j in range(n + 1) for i in range(n + 1)]
        lines += ["*ELEMENT, TYPE=S4, ELSET=P"]
        lines += [f"{j * n + i + 1}, {j * (n + 1) + i + 1}, {j * (n + 1) + i + 2}, {(j + 1) * (n + 1) + i + 2}, {(j + 1) * (n + 1) + i + 1}"
                  for j in range(n) for i in range(n)]
        lines += ["*SHELL SECTION, ELSET=P, MATERIAL=S", "1.", "*MATERIAL, NAME=S", "*ELASTIC", "2.E11, 0.3", "*DENSITY", "8000.", "*NSET, NSET=E, GENERATE",
                  f"1, {n + 1}", "*BOUNDARY", "E, 1, 6"]
        (folder / "plate.inp").write_text("\n".join(lines) + "\n")
        arguments = ("--model", folder / "plate.inp", "--out", folder / "out", "--set", "n_modes=40")
        seen = self.on_a_terminal(*arguments)
        self.assertRegex(seen, r"\r\x1b\[Ks1_model: working, \d+ s so far")
        self.assertNotIn("working", seen.splitlines()[-1].split("\x1b[K")[-1], "the line is gone at the end")
        self.assertEqual(self.on_a_terminal(*arguments, "--quiet").count("working"), 0)


if __name__ == "__main__":
    unittest.main()
