"""Names never run: thirty hostile names, given to every target of make, to `twindeck` and in a received folder.

Oracle: each name would make the file `touched` if make or a shell expanded it (that they do is asked of make and sh themselves); no such file may be there
afterwards. A refusal is one line with exit code 2. Names that people do use (blanks, letters beyond ASCII) go through as they stand.
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
RUN = "touch touched"
HOSTILE = (
    f"`{RUN}`", f"$({RUN})", f"$(shell {RUN})", f"${{shell {RUN}}}", f"$$({RUN})", f"$$$$({RUN})", f";{RUN};", f"x;{RUN}", f"x & {RUN}", f"x && {RUN}",
    f"x || {RUN}", f"x | {RUN}", f"x\n{RUN}", f"x\r\n\t{RUN}", f"';{RUN};'", f"\";{RUN};\"", f"\\\";{RUN};\\\"", f"'$({RUN})'", f"\"$({RUN})\"", f"x:;{RUN}",
    f"x: ; {RUN}", f"$(eval $(shell {RUN}))", f"$(eval x:;{RUN})", f"$(file >touched)", f"$(call shell,{RUN})", "x > touched", "x >touched #", "*`>touched`",
    f"{{x,`{RUN}`}}", f"$(error $(shell {RUN}))",
)
VARIABLES = ("STUDY", "STEP", "A", "B", "MODES", "DATA", "FEATURES", "THREADS", "BATCH", "SIZES", "PREFIX", "UNHEARD_OF")
TARGETS = re.findall(r"(?m)^([a-z][a-z-]*):.*## ", (ROOT / "Makefile").read_text()) + ["s1", "s6_updating", "results/x/s1_model/manifest.json"]


class Names(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        for part in ("workflows", "paper", "packaging", "data/template", "src"):
            shutil.copytree(ROOT / part, cls.root / part, ignore=shutil.ignore_patterns("__pycache__", "*.?pp", "*.png"))
        shutil.copy(ROOT / "Makefile", cls.root / "Makefile")

    def run_here(self, *command, **environment):
        clean = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "MODES", "DATA", "REASON")}
        return subprocess.run(command, cwd=self.root, env={**clean, **environment}, capture_output=True, text=True, timeout=120)

    def make(self, *arguments, **environment):
        return self.run_here("make", "--no-print-directory", "NO_BUILD=1", f"BIN={BIN}", *arguments, **environment)

    def untouched(self, *what):
        found = [p for p in self.root.rglob("touched*")]
        for path in found:
            path.unlink()
        self.assertEqual(found, [], what)

    def refused(self, done, *what):
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1), (what, done.stderr))
        self.untouched(*what)

    def test_the_names_are_hostile(self):
        """Where nothing checks them, make or sh runs at least 20 of the 30; the others are hostile to one form of quoting."""
        (self.root / "open.mk").write_text("all:\n\t@echo $(NAME)\n\t@echo \"$(NAME)\"\n\t@echo '$(NAME)'\n")
        ran = 0
        for name in HOSTILE:
            self.run_here("make", "-k", "-f", "open.mk", f"NAME={name}")
            ran += (self.root / "touched").exists()
            (self.root / "touched").unlink(missing_ok=True)
        self.assertEqual(len(set(HOSTILE)), 30)
        self.assertGreaterEqual(ran, 20)

    def test_every_target_refuses_them(self):
        self.assertGreater(len(TARGETS), 40)
        for i, target in enumerate(TARGETS):
            for j, name in enumerate(HOSTILE):
                variable = VARIABLES[(i + j) % len(VARIABLES)]
                self.refused(self.make(target, f"{variable}={name}"), target, variable, name)

    def test_every_variable_refuses_them_from_the_environment_too(self):
        for variable in VARIABLES[:-1]:  # one that nobody reads may hold anything
            for name in HOSTILE:
                self.refused(self.make("help", **{variable: name}), variable, name)

    def test_what_is_made_refuses_them(self):
        for name in HOSTILE:
            if "=" not in name:
                self.refused(self.make(name), name)
                self.refused(self.make("why", name), "why", name)
                self.refused(self.make(f"s1{name}"), "s1", name)

    def test_a_reason_is_free_text_and_runs_nothing(self):
        (self.root / "workflows/python.sh").rename(self.root / "kept.sh")
        self.addCleanup(lambda: (self.root / "kept.sh").replace(self.root / "workflows/python.sh"))
        (self.root / "workflows/python.sh").write_text("#!/bin/sh\nprintf %s \"$REASON\" >reason.txt\n")
        (self.root / "workflows/python.sh").chmod(0o755)
        for name in HOSTILE:
            done = self.make("moves", f"REASON=another mesh {name}")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((self.root / "reason.txt").read_bytes(), f"another mesh {name}".encode())
            self.untouched(name)

    def test_the_command_refuses_them(self):
        for name in HOSTILE:
            for words in (("run", name), ("run", "mine", name), ("run", "s1", f"MODES={name}"), ("why", name), ("why", "s1", name), ("copy", name), (f"s1{name}",), (name,)):
                done = self.run_here("packaging/twindeck", *words)
                self.assertEqual(done.returncode, 2, (words, done.stderr))
                self.untouched(words)
        for option in (f"--eval=$(shell {RUN})", f"MODES:=$(shell {RUN})", f"MODES!={RUN}", "SHELL=/bin/true", f"-E$(shell {RUN})", "-C/tmp"):
            done = self.run_here("packaging/twindeck", "run", "template", option)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.untouched(option)

    def test_a_received_folder_runs_nothing(self):
        """Files of such names in a study's folders, and a study of such a name that is the only one there."""
        self.make("new", "STUDY=mine")
        self.addCleanup(shutil.rmtree, self.root / "workflows/mine")
        self.addCleanup(shutil.rmtree, self.root / "data/mine")
        for folder in ("data/mine/features", "data/mine/model", "workflows/mine", "workflows/mine/hypotheses", "data/mine/campaign/records"):
            (self.root / folder).mkdir(exist_ok=True)
            (self.root / folder / "x").write_text("")
            for name in HOSTILE:
                (self.root / folder / f"{name.replace('/', '')}.csv").write_text("")
        (self.root / "results/mine").mkdir(parents=True)
        self.addCleanup(shutil.rmtree, self.root / "results")
        for name in HOSTILE:
            (self.root / "results/mine" / name).mkdir()
            (self.root / "results/mine" / name / "manifest.json").write_text(f'{{\n"step": "s1_model",\n"inputs": {{\n"x`{RUN}`": "00",\n"y$({RUN})": "00"\n}}\n}}\n')
        done = self.make("steps", "report", "-n", "STUDY=mine")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.make("why", "s6", "STUDY=mine").returncode, 0)
        self.untouched("steps")
        for name in HOSTILE:
            with tempfile.TemporaryDirectory() as place:
                study = pathlib.Path(place) / "workflows" / name
                study.mkdir(parents=True)
                shutil.copy(ROOT / "workflows/template/study.toml", study)
                for words in (("run",), ("run", name), ("why", "s1"), ("studies",)):
                    done = subprocess.run([self.root / "packaging/twindeck", *words], cwd=place, capture_output=True, text=True, timeout=60)
                    self.assertEqual(done.returncode, 0 if words[0] == "studies" else 2, (name, done.stderr))
                    self.assertEqual([*pathlib.Path(place).rglob("touched*")], [], name)

    def test_measured_modes_in_a_folder_with_a_blank(self):
        """Step 4 reads them, and runs again where they are edited. Oracle: the inputs that its manifest lists."""
        study = self.root / "workflows/blank"
        self.make("new", "STUDY=blank")
        self.addCleanup(shutil.rmtree, study)
        (study / "study.toml").write_text('title = "t"\nsteps = ["s1_model", "s4_refinement"]\n[model]\nfolder = "data/blank/model"\n')
        modes = self.root / "my modes"
        modes.mkdir()
        (modes / "modes.csv").write_text("mode,frequency_Hz,frequency_std_Hz\n1,1.3,0.01\n")
        arguments = ("s4", "STUDY=blank", "MODES=my modes")
        done = self.make(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn('"my modes/modes.csv"', (self.root / "results/blank/s4_refinement/manifest.json").read_text())
        self.assertNotIn("s4_refinement", self.make("-n", *arguments).stdout)
        later = time.time() + 10
        os.utime(modes / "modes.csv", (later, later))
        self.assertIn(f"{BIN}/s4_refinement", self.make("-n", *arguments).stdout)

    def test_names_that_people_use_go_through(self):
        for modes in ("my modes", "/data/Brücke 7/möden", "a-b_c.d"):
            done = self.make("-n", "s4", "STUDY=template", f"MODES={modes}")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f"--modes '{modes}'", done.stdout)


if __name__ == "__main__":
    unittest.main()
