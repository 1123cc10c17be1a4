"""The faults that `make mutants` puts into the sources. Oracle: a planted text of which every fault is known; the sources themselves."""
import itertools
import pathlib
import sys
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/mutants"), str(ROOT / "tests/architecture")]
import run  # noqa: E402
from faults import KINDS, faults, faults_by_kind  # noqa: E402
from source_text import blanked  # noqa: E402

PLANTED = """
// a + b in a comment, 2.0 there
constexpr double outside = 2.5;

double work(const Matrix& a, int i, int j) {
  const double sum = a(i, j) + a(j, i);  // a - b
  fail("x + y", 2.0);
  total += sum;
  b.noalias() = a.transpose() * c;
  return -0.5;
}
"""


class Faults(unittest.TestCase):
    def test_all_faults_of_a_planted_text_and_no_others(self):
        found = {(f.kind, f.shown(PLANTED)[1].partition("  //")[0]) for f in faults(PLANTED)}
        line = "const double sum = a(i, j) + a(j, i);"
        self.assertEqual(found, {
            ("sign", line.replace("+", "-")), ("sign", "total -= sum;"),
            ("index", line.replace("(i, j)", "(j, i)")), ("index", line.replace("(j, i)", "(i, j)")),
            ("factor 2", "return -(2.0 * 0.5);"), ("transposition", "b.noalias() = a * c;"),
            ("missing term", "const double sum = a(i, j);"), ("missing term", ";"),
        })

    def test_in_the_sources_every_fault_changes_code(self):
        files = run.sources(ROOT, ("fe", "modal", "identification"))
        by_kind = faults_by_kind(ROOT, files)
        for kind in KINDS:
            with self.subTest(kind):
                self.assertGreater(len(by_kind[kind]), 20)
                for fault in by_kind[kind]:
                    text = (ROOT / fault.file).read_text()
                    self.assertNotEqual(blanked(fault.applied(text)), blanked(text), fault)

    def test_a_seed_draws_the_same_faults_and_each_once(self):
        by_kind = faults_by_kind(ROOT, run.sources(ROOT, ("fe",)))
        first, again = (list(itertools.islice(run.draws(by_kind, seed), 30)) for seed in (5, 5))
        self.assertEqual(first, again)
        self.assertEqual(len(set(first)), 30)
        self.assertNotEqual(first, list(itertools.islice(run.draws(by_kind, 6), 30)))


class Reach(unittest.TestCase):
    USES = {"core": [], "fe": ["core"], "dynamics": ["fe"], "wind": ["core"], "updating": ["dynamics"]}

    def test_tests_of_a_room_its_own_first_then_those_that_use_it(self):
        known = ("test_core", "test_fe", "test_updating", "test_wind")
        self.assertEqual(run.tests_of("fe", self.USES, known), ["test_fe", "test_updating", "test_laws", "test_verification", run.SMOKE])
        of_diagnosis = [run.CHAIN_AND_GIRDER, run.DIAGNOSED_SMOKE, run.BLIND]
        uses = {**self.USES, "diagnosis/causes": ["fe"], "diagnosis": ["diagnosis/causes", "updating"]}
        self.assertEqual(run.tests_of("updating", uses, known), ["test_updating", "test_laws", "test_verification", run.SMOKE, *of_diagnosis])
        self.assertEqual(run.tests_of("wind", {**self.USES, "identification": ["wind"]}, known), ["test_wind", "test_laws", "test_verification", run.RECORDS, run.SMOKE])
        self.assertEqual(run.tests_of("diagnosis/causes", uses, known), ["test_laws", "test_verification", *of_diagnosis])

    def test_every_room_of_numerics_is_a_folder_with_a_library(self):
        uses = tomllib.loads((ROOT / "src/layers.toml").read_text())["uses"]
        for file in run.sources(ROOT, run.NUMERICS):
            self.assertIn(run.library_of(file, uses), uses)

    def test_an_equivalent_mutant_is_argued(self):
        for entry in tomllib.loads((ROOT / "tests/mutants/equivalent.toml").read_text()).get("mutant", []):
            self.assertTrue(entry["why"].strip(), entry)
            self.assertIn(entry["before"], (ROOT / entry["file"]).read_text(), "the line is gone: remove the entry")


if __name__ == "__main__":
    unittest.main()
