"""The container, the runs of CI and the version, as far as they can be checked without either.

Oracles: Debian's shell, which parses each command; the tree, which has the files that are copied; the Makefile, which has the targets that
are called; workflows/debian-packages.txt, the one list of packages.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
TARGETS = set(re.findall(r"^([a-z][a-z-]*):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M))


def instructions(text):
    """[(word, rest)] of a Dockerfile, continued lines joined."""
    lines = [line for line in text.replace("\\\n", " ").splitlines() if line.strip() and not line.startswith("#")]
    return [tuple(line.split(None, 1)) for line in lines]


def make_goals(command):
    """Targets that a shell command asks make for."""
    goals = []
    for part in re.split(r"&&|\|\||;|\n", command):
        words = part.split()
        if words[:1] == ["make"]:
            goals += [w for w in words[1:] if "=" not in w and not w.startswith("-")]
    return goals


def commands(workflow):
    """The commands of a workflow's `run:` keys; expressions of the platform replaced by a word."""
    found, lines = [], workflow.read_text(encoding="utf-8").splitlines()
    for i, line in enumerate(lines):
        match = re.match(r"^( *)(?:- )?run: (.*)$", line)
        if not match:
            continue
        text = match.group(2)
        if text == "|":
            depth = len(match.group(1)) + (2 if line.lstrip().startswith("- ") else 0)
            body = []
            for below in lines[i + 1:]:
                if below.strip() and len(below) - len(below.lstrip()) <= depth:
                    break
                body.append(below.strip())
            text = "\n".join(body)
        found.append(re.sub(r"\$\{\{.*?\}\}", "word", text))
    return found


def parses(command):
    return subprocess.run(["sh", "-n", "-c", command], capture_output=True, text=True)


class Container(unittest.TestCase):
    text = (ROOT / "Dockerfile").read_text(encoding="utf-8")
    steps = instructions(text)

    def test_two_stages_of_debian_12(self):
        self.assertEqual([rest.split()[0] for word, rest in self.steps if word == "FROM"], ["debian:12", "debian:12"])

    def test_commands_are_sound_shell_and_make_targets(self):
        runs = [rest for word, rest in self.steps if word == "RUN"]
        self.assertEqual(len(runs), 3)
        for command in runs:
            self.assertEqual(parses(command).stderr, "")
            self.assertLessEqual(set(make_goals(command)), TARGETS)
        self.assertIn("package", make_goals(runs[1]))

    def test_what_is_copied_is_there(self):
        for word, rest in self.steps:
            sources = rest.split()[:-1]
            if word == "COPY" and not sources[0].startswith("--from"):
                for source in sources:
                    self.assertTrue((ROOT / source).exists(), source)

    def test_packages_are_those_of_the_one_list(self):
        """The first stage calls deps.sh, which reads debian-packages.txt; by name come only those that are needed before and for packing."""
        first = next(rest for word, rest in self.steps if word == "RUN")
        self.assertTrue(first.endswith("&& workflows/deps.sh"))
        named = re.search(r"install (.*?) &&", first).group(1).split()
        self.assertEqual([n for n in named if not n.startswith("-")], ["dpkg-dev", "file", "make"])
        listed = subprocess.run([ROOT / "workflows/deps.sh", "--list"], capture_output=True, text=True)
        if shutil.which("dpkg-query"):
            lines = (ROOT / "workflows/debian-packages.txt").read_text().splitlines()
            self.assertEqual([line.split()[0] for line in listed.stdout.splitlines()], [line for line in lines if line and not line.startswith("#")])

    def test_an_installation_says_how_far_it_is_and_fails_as_apt_does(self):
        """An apt that fetches, installs and ends with a code of its own, as its status lines have it."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for name, text in (("dpkg-query", "exit 1"), ("sudo", 'exec "$@"'),
                           ("apt-get", 'if [ "$1" = update ]; then exit 0; fi\necho dlstatus:1:4.5:Retrieving file\necho Selecting package x\n'
                            "for p in 0 4.2 41.0 44.9 100; do echo pmstatus:libx:$p:Installing libx; done\nexit $APT_CODE")):
            (folder / name).write_text(f"#!/bin/sh\n{text}\n")
            (folder / name).chmod(0o755)
        for code in (0, 100):
            done = subprocess.run([ROOT / "workflows/deps.sh"], capture_output=True, text=True, timeout=60,
                                  env=os.environ | {"PATH": f"{folder}:{os.environ['PATH']}", "APT_CODE": str(code)})
            self.assertEqual(done.returncode, code, done.stderr)
            said = done.stdout.splitlines()[1:]
            self.assertEqual(said, ["deps: fetching, 4 %", "deps: installing, 0 %", "deps: installing, 41 %", "deps: installing, 100 %"] +
                             (["deps: done"] if code == 0 else []))

    def test_what_is_copied_into_the_build_is_not_ignored(self):
        ignored = (ROOT / ".dockerignore").read_text().split()
        for part in ("src", "workflows", "packaging", "paper", "python", "data", "docs", "tests", "Makefile", "CMakeLists.txt", "LICENSE"):
            self.assertTrue((ROOT / part).exists())
            self.assertFalse(any(pathlib.PurePath(part).match(pattern) for pattern in ignored), part)

    def test_the_documented_commands_are_the_same_everywhere(self):
        guide = (ROOT / "docs/install.md").read_text(encoding="utf-8")
        said = [line.removeprefix("#").strip() for line in self.text.splitlines() if line.startswith("#   docker")]
        self.assertEqual(len(said), 3)
        ran = "\n".join(c for w in WORKFLOWS for c in commands(w))
        for command in said:
            self.assertIn(command, guide)
            self.assertIn(command, ran)


class Runs(unittest.TestCase):
    def test_commands_are_sound_shell_and_make_targets(self):
        self.assertEqual([w.name for w in WORKFLOWS], ["ci.yml", "nightly.yml"])
        for workflow in WORKFLOWS:
            found = commands(workflow)
            self.assertGreater(len(found), 2, workflow.name)
            for command in found + re.findall(r"command: (.*)", workflow.read_text()):
                self.assertEqual(parses(command).stderr, "", command)
                self.assertLessEqual(set(make_goals(command)), TARGETS, command)

    def test_they_are_yaml(self):
        try:
            import yaml
        except ModuleNotFoundError:
            self.skipTest("no PyYAML here (Debian: python3-yaml)")
        for workflow in WORKFLOWS:
            for name, job in yaml.safe_load(workflow.read_text())["jobs"].items():
                self.assertTrue(job["runs-on"] and job["steps"] and job["timeout-minutes"], name)

    def test_files_that_they_name_are_there(self):
        for workflow in WORKFLOWS:
            for command in commands(workflow):
                for name in re.findall(r"(?<![\w/$])(?:tests|workflows|packaging|\.ci)/[\w./*-]+", command):
                    self.assertTrue(list(ROOT.glob(name)), name)

    def test_a_command_that_no_shell_takes_is_found(self):
        self.assertNotEqual(parses("make test && (").stderr, "")
        self.assertEqual(make_goals("cd x && make deps fuzz SECONDS=300"), ["deps", "fuzz"])

    def test_the_preset_of_coverage_is_there(self):
        presets = {p["name"]: p for p in json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]}
        self.assertIn("--coverage", presets["coverage"]["cacheVariables"]["CMAKE_CXX_FLAGS"])
        self.assertIn("-O0", presets["coverage"]["cacheVariables"]["CMAKE_CXX_FLAGS_RELWITHDEBINFO"])  # run.sh says why
        self.assertIn("--preset coverage", (ROOT / "tests/coverage/run.sh").read_text())


class Release(unittest.TestCase):
    def test_the_version_is_written_once(self):
        """CITATION.cff states it; the programs say it after the build, and the changelog's first section is of it or of what is not released."""
        stated = re.search(r"(?m)^version: (\d+\.\d+\.\d+)$", (ROOT / "CITATION.cff").read_text()).group(1)
        for file in ("CMakeLists.txt", "src/CMakeLists.txt", "src/core/build_info.cpp", "packaging/install.cmake", "packaging/twindeck"):
            self.assertNotIn(stated, (ROOT / file).read_text(), file)
        sections = re.findall(r"(?m)^## (.*)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"))
        self.assertRegex("\n".join(sections), rf"^(Unreleased\n)?{re.escape(stated)}, \d{{4}}-\d\d-\d\d(\n|$)")
        program = BIN / "s1_model"
        if not program.exists():
            self.skipTest("s1_model is not built: what the programs say is not checked")
        said = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=60)
        self.assertIn(f" {stated}", said.stdout.splitlines()[0])

    def test_the_citation_has_what_the_format_requires(self):
        """Citation File Format 1.2.0: cff-version, message, title and authors, each of whom has a name."""
        try:
            import yaml
        except ModuleNotFoundError:
            self.skipTest("no PyYAML here (Debian: python3-yaml)")
        citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
        for key in ("cff-version", "message", "title", "authors"):
            self.assertTrue(citation[key], key)
        self.assertTrue(all(a.get("name") or a.get("family-names") for a in citation["authors"]))
        self.assertIsInstance(citation["version"], str)

    def test_shell_scripts_have_no_findings(self):
        if not shutil.which("shellcheck"):
            self.skipTest("no shellcheck here (Debian: shellcheck)")
        scripts = sorted(str(p.relative_to(ROOT)) for folder in ("workflows", "tests") for p in (ROOT / folder).rglob("*.sh"))
        self.assertGreater(len(scripts), 5)
        done = subprocess.run(["shellcheck", "packaging/twindeck", ".ci/run", *scripts], cwd=ROOT, capture_output=True, text=True)
        self.assertEqual(done.stdout, "")


class Packages(unittest.TestCase):
    """workflows/deps.sh with a package manager made up here. Oracle: what it was asked to install, and what it said."""

    def deps(self, known, fails=False):
        """(completed process, packages asked for); nothing is installed, apt knows `known`."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        said = "dlstatus:1:4.2:Retrieving\\ndlstatus:1:9.9:Retrieving\\npmstatus:x:55.5:Installing\\nSetting up x\\n"
        stubs = {"dpkg-query": "exit 1", "sudo": 'exec "$@"', "apt-cache": f'case " {known} " in *" $2 "*) exit 0;; esac; exit 100',
                 "apt-get": f'[ "$1" = install ] || exit 0; shift; for w in "$@"; do case $w in -*|APT::*) ;; *) echo "$w" >>{folder}/asked;; esac; done; '
                            f'printf "{said}"; {"echo E: no room >&2; exit 100" if fails else "exit 0"}'}
        for name, body in stubs.items():
            (folder / name).write_text(f"#!/bin/sh\n{body}\n")
            (folder / name).chmod(0o755)
        done = subprocess.run([ROOT / "workflows/deps.sh"], env={"PATH": f"{folder}:/usr/bin:/bin"}, capture_output=True, text=True)
        return done, (folder / "asked").read_text().split() if (folder / "asked").exists() else []

    wanted = [line for line in (ROOT / "workflows/debian-packages.txt").read_text().splitlines() if line and not line.startswith("#")]

    def test_all_are_asked_for_and_progress_is_said(self):
        done, asked = self.deps("make calculix-ccx")
        self.assertEqual((done.returncode, asked), (0, self.wanted), done.stderr)
        for line in ("deps: fetching, 4 %", "deps: installing, 55 %", "deps: done"):
            self.assertEqual(done.stdout.splitlines().count(line), 1, done.stdout)
        self.assertNotIn("Setting up", done.stdout)

    def test_a_debian_without_calculix_does_without(self):
        done, asked = self.deps("make")
        self.assertEqual((done.returncode, asked), (0, [p for p in self.wanted if p != "calculix-ccx"]), done.stderr)

    def test_a_failure_shows_the_words_of_apt(self):
        done, _ = self.deps("make calculix-ccx", fails=True)
        self.assertEqual(done.returncode, 100)
        self.assertIn("E: no room", done.stderr)
        self.assertNotIn("deps: done", done.stdout)


class CoverageTable(unittest.TestCase):
    """Oracle: counts worked out by hand."""

    def test_by_room(self):
        import sys
        sys.path.insert(0, str(ROOT / "tests/coverage"))
        import rooms
        files = [{"filename": "src/fe/beam.cpp", "line_total": 60, "line_covered": 60, "branch_total": 10, "branch_covered": 5},
                 {"filename": "src/fe/shell.cpp", "line_total": 40, "line_covered": 30, "branch_total": 0, "branch_covered": 0},
                 {"filename": "src/steps/model/run.cpp", "line_total": 100, "line_covered": 10, "branch_total": 4, "branch_covered": 1}]
        self.assertEqual([rooms.room(f"src/diagnosis/{name}.cpp") for name in ("gain", "causes/candidate", "words/sentences")],
                         ["diagnosis", "diagnosis", "diagnosis/words"])
        found = rooms.by_room({"files": files})
        self.assertEqual(found, {"fe": [100, 90, 10, 5], "steps": [100, 10, 4, 1]})
        lines = rooms.table(found).splitlines()
        self.assertEqual(lines[2], "| fe | 100 | 90.0 % | 10 | 50.0 % | below 95 % |")
        self.assertEqual(lines[3], "| steps | 100 | 10.0 % | 4 | 25.0 % |  |")
        self.assertTrue(lines[4].startswith("| all | 200 | 50.0 % | 14 | 42.9 %"))


if __name__ == "__main__":
    unittest.main()
