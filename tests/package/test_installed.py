"""What is installed works without the source tree: a study of one's own from the template to its report, studies, single steps, manual pages.

Oracles: the values of the frame that the template's records were made from; the programs' own --describe; the path of the source tree, which
no file that is written may hold. Where it can be done (as root), an empty file system lies over the source tree while the commands run.
"""
import csv
import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from installed import BUILD, ROOT, Place, can_hide, install  # noqa: E402

sys.path.insert(0, str(ROOT / "paper"))
from twindeck_reference.__main__ import described  # noqa: E402


def mentions(folder, text):
    """Files below the folder that hold the text."""
    return [str(p.relative_to(folder)) for p in sorted(folder.rglob("*")) if p.is_file() and text.encode() in p.read_bytes()]


@unittest.skipUnless((BUILD / "cmake_install.cmake").is_file() and shutil.which("cmake"), "no build folder of CMake here")
class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.root = pathlib.Path(holder.name).resolve()
        cls.prefix = install(cls.root / "destination")
        cls.hidden = can_hide()
        cls.place = Place(cls.prefix, cls.root / "somewhere", cls.hidden)
        cls.new = cls.place.run("twindeck", "new", "my_bridge")
        cls.all = cls.place.run("twindeck", "run")

    def run_here(self, *command, code=0):
        done = self.place.run(*command)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def test_the_source_tree_is_out_of_reach(self):
        if not self.hidden:
            self.skipTest("not root, or no mount name spaces: the source tree stays readable; that no output names it is checked all the same")
        self.assertEqual(self.run_here("ls", ROOT).stdout, "")

    def test_a_new_study_runs_to_its_report(self):
        self.assertEqual(self.new.returncode, 0, self.new.stderr)
        self.assertIn("next: twindeck run my_bridge", self.new.stdout)
        self.assertEqual(self.all.returncode, 0, self.all.stdout + self.all.stderr)
        page = (self.place.folder / "results/my_bridge/report/report.html").read_text(encoding="utf-8")
        for part in ("two-storey frame", "k_base", "data:image/png;base64,", 'id="mode-shapes"'):
            self.assertIn(part, page)
        with open(self.place.folder / "results/my_bridge/s6_updating/parameters.csv", newline="") as stream:
            found = {row["parameter"]: float(row["final_value"]) for row in csv.DictReader(stream)}
        # the frame's own values, as in tests/steps/test_own_study.py
        self.assertAlmostEqual(found["k_base"] / (7 / 12), 1.0, delta=0.05)
        self.assertAlmostEqual(found["m_floor"] / 1.10, 1.0, delta=0.01)

    def test_the_installed_catalogue_was_read(self):
        manifest = (self.place.folder / "results/my_bridge/s9_diagnosis/manifest.json").read_text()
        self.assertIn(f"{self.prefix}/share/twindeck/workflows/common/hypotheses/stiffness.toml", manifest)

    def test_no_output_names_the_source_tree(self):
        for folder in ("results", "workflows", "data"):
            self.assertEqual(mentions(self.place.folder / folder, str(ROOT)), [])

    def test_no_installed_file_but_the_programs_names_the_source_tree(self):
        # the programs hold the names of their source files, for messages of failed assertions; nothing is read by them (test above)
        programs = {f"bin/{p.name}" for p in (self.prefix / "bin").iterdir()}
        self.assertEqual([f for f in mentions(self.prefix, str(ROOT)) if f not in programs], [])
        for program in sorted(programs):
            if re.match(r"bin/s\d_", program):
                config = subprocess.run([self.prefix / program, "--print-config"], cwd=self.root, capture_output=True, text=True, timeout=30)
                self.assertNotIn(str(ROOT), config.stdout)

    def test_a_second_run_does_nothing_and_why_says_so(self):
        self.assertNotIn("s6_updating:", (again := self.run_here("twindeck", "run", "my_bridge")).stdout + again.stderr)
        self.assertIn("s6_updating: up to date", self.run_here("twindeck", "why", "s6").stdout)

    def test_steps_run_by_themselves(self):
        self.assertIn("Usage: s6_updating", self.run_here("twindeck", "s6", "--help").stdout)
        self.assertIn("there is no step 's77'", self.run_here("twindeck", "s77", code=2).stderr)
        version = self.run_here("twindeck", "--version").stdout
        self.assertRegex(version, r"^twindeck \d+\.\d+\.\d+$")

    def test_the_python_package_finds_the_steps(self):
        python = "/usr/bin/python3" if subprocess.run(["/usr/bin/python3", "-c", "import pandas"], capture_output=True).returncode == 0 else sys.executable
        code = "import twindeck; print(twindeck.__file__, twindeck.find_step('s6'), len(twindeck.read_run('results/my_bridge').steps))"
        done = self.run_here(python, "-c", code)
        self.assertIn(f"{self.prefix}/lib/python3/dist-packages/twindeck", done.stdout)
        self.assertIn("bin/s6_updating", done.stdout)

    def test_installed_studies_are_listed_and_copied(self):
        self.assertIn("ponte_del_mare", self.run_here("twindeck", "studies").stdout)
        other = Place(self.prefix, self.root / "copied", self.hidden)
        self.assertEqual(other.run("twindeck", "copy", "painter_street_overpass").returncode, 0)
        # its diagnosis reads the causes of another study
        self.assertTrue((other.folder / "workflows/meloland_overpass/hypotheses").is_dir())
        self.assertEqual(other.run("twindeck", "copy", "ponte_del_mare").returncode, 0)
        rules = other.run("twindeck", "run", "ponte_del_mare", "all", "--dry-run")
        self.assertEqual(rules.returncode, 0, rules.stderr)
        for part in (f"{self.prefix}/bin/s8_validation", f"{self.prefix}/share/twindeck/tests/steps/diagnosis_score.py", "ponte_del_mare_virtual"):
            self.assertIn(part, rules.stdout)

    def test_refusals_say_what_to_do(self):
        empty = Place(self.prefix, self.root / "empty", self.hidden)
        for arguments, part in ((("run",), "make one: twindeck new my_bridge"), (("run", "nothing"), "there is no study 'nothing' here"),
                                (("new", "My-Bridge"), "twindeck new my_bridge"), (("copy", "nothing"), "is no installed study"),
                                (("frobnicate",), "unknown command 'frobnicate'"), (("why",), "name a step"), (("compare", "a"), "name two results folders")):
            done = empty.run("twindeck", *arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(part, done.stderr)

    def test_every_program_has_a_manual_page_with_all_its_keys(self):
        programs = sorted(p.name for p in (self.prefix / "bin").iterdir())
        self.assertEqual(sorted(p.name.removesuffix(".1.gz") for p in (self.prefix / "share/man/man1").iterdir()), programs)
        self.assertEqual(len([p for p in programs if re.match(r"s\d_", p)]), 10)
        for program in programs:
            text = gzip.decompress((self.prefix / f"share/man/man1/{program}.1.gz").read_bytes()).decode()
            keys = described(self.prefix / "bin" / program) if re.match(r"s\d_", program) else []
            for _, key, _, _ in keys:
                self.assertRegex(text, rf"(?m)^\.B (\S+\.)?{key}$")
            if shutil.which("groff"):
                seen = subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", "-Kutf8"], input=text, capture_output=True, text=True, timeout=30)
                self.assertEqual(seen.stderr, "", program)


class SourceTree(unittest.TestCase):
    def test_the_command_works_from_the_source_tree_too(self):
        """A study elsewhere, the programs of build/bin; nothing is compiled."""
        folder = self.enterContext(tempfile.TemporaryDirectory())

        def run(*arguments):
            return subprocess.run([ROOT / "packaging/twindeck", *arguments], cwd=folder, capture_output=True, text=True, timeout=60)

        self.assertEqual(run("new", "mine").returncode, 0)
        done = run("run", "--dry-run", "s6")
        self.assertEqual(done.returncode, 2, "an option of make needs the study's name or a step first")
        done = run("run", "mine", "s6", "--dry-run", f"BIN={BUILD}/bin")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"{BUILD}/bin/s6_updating --study workflows/mine", done.stdout)
        self.assertNotIn("cmake", done.stdout)
        done = run("run", "mine", "--dry-run", f"BIN={BUILD}/bin")
        self.assertIn("-m twindeck_report report", done.stdout, "options alone leave the default, all")

    def test_what_is_run_is_what_the_command_offers(self):
        """Targets of the Makefile that are not in the usage are refused, also behind the study's name. Oracle: the files of the user's, which are all still there."""
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for kept in ("results/mine/s1_model/modes.csv", "results/other/page.html", "build/notes.txt", "workflows/mine/study.toml"):
            (folder / kept).parent.mkdir(parents=True, exist_ok=True)
            (folder / kept).write_text("kept\n")
        before = sorted(folder.rglob("*"))
        for words in (("mine", "clean"), ("clean",), ("mine", "s6", "clean"), ("mine", "s6", "THREADS=1", "release"), ("mine", "--dry-run", "format")):
            done = subprocess.run([ROOT / "packaging/twindeck", "run", *words], cwd=folder, capture_output=True, text=True, timeout=60)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(f"'{next(w for w in words if w in ('clean', 'release', 'format'))}'", done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        self.assertEqual(sorted(folder.rglob("*")), before)
        done = subprocess.run([ROOT / "packaging/twindeck", "why", "s6", "nothing"], cwd=folder, capture_output=True, text=True, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (2, "twindeck: there is no study 'nothing' here (workflows/nothing/study.toml)\n"))


if __name__ == "__main__":
    unittest.main()
