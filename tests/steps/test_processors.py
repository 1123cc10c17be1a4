"""The smoke study under the kernels of other processors: the short form of `make processors`.

Oracle: the same inputs give the same numbers. Records are the same bytes; every other number agrees to one part in a million of its column's
largest, text (names, pairs, verdicts) agrees to the letter.
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "reproduction"))
import processors  # noqa: E402
import roots  # noqa: E402
from columns import changes  # noqa: E402

BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
# What is computed from given data agrees to rounding times the condition of the problem; identification and search have a wider one.
MOST = 1e-6


def smoke(folder, name):
    results = folder / name
    done = subprocess.run(["make", "--no-print-directory", "steps", "STUDY=smoke", "NO_BUILD=1", f"BIN={BIN}", f"RESULTS={results}"], cwd=ROOT,
                          env=processors.environment(name), capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stderr)
    return results


class Processors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        able = processors.runnable()
        cls.names = [able[0], able[-1]]  # the oldest, and the newest that this machine has
        cls.results = {name: smoke(cls.folder, name) for name in cls.names}

    def test_records_are_the_same_bytes(self):
        reference = self.results[self.names[0]] / "s0_campaign"
        files = [f.relative_to(reference) for f in reference.rglob("*.npy")]
        self.assertGreaterEqual(len(files), 1)
        for name in self.names[1:]:
            self.assertEqual([str(f) for f in files if (reference / f).read_bytes() != (self.results[name] / "s0_campaign" / f).read_bytes()], [], name)

    def test_no_column_moves(self):
        reference = self.results[self.names[0]]
        self.assertGreater(len(list(reference.rglob("*.csv"))), 40)
        for name in self.names[1:]:
            moved = [c for c in changes(reference, self.results[name]) if c[2] > MOST]
            self.assertEqual(moved, [], name)

    def test_a_changed_number_and_a_changed_word_are_seen(self):
        a, b = self.folder / "a", self.folder / "b"
        for folder, number, word in ((a, "1.0", "1X"), (b, "1.00001", "2X")):
            folder.mkdir()
            (folder / "modes.csv").write_text(f"mode,frequency_Hz\n{word},{number}\n3X,2.0\n")
        seen = {column: change for _, column, change, _ in changes(a, b)}
        self.assertAlmostEqual(seen["frequency_Hz"], 5e-6, places=9)
        self.assertEqual(seen["mode"], float("inf"))


if __name__ == "__main__":
    unittest.main()

    def test_a_manifest_may_differ_in_its_seconds_alone_and_a_table_in_nothing(self):
        a, b = self.folder / "first", self.folder / "second"
        for folder, seconds, seed, number in ((a, 1.5, 1, 2), (b, 1.7, 1, 2)):
            (folder / "s4").mkdir(parents=True)
            (folder / "s4" / "manifest.json").write_text(f'{{"seconds": {seconds}, "seed": {seed}}}')
            (folder / "modes.csv").write_text(f"mode\n{number}\n")
        self.assertEqual([equal for _, equal, _ in roots.compared(a, b)], [True, True])
        (b / "s4" / "manifest.json").write_text('{"seconds": 1.5, "seed": 2}')
        (b / "modes.csv").write_text("mode\n3\n")
        (b / "left.csv").write_text("mode\n")
        self.assertEqual([(name, equal) for name, equal, _ in roots.compared(a, b)],
                         [("left.csv", False), ("modes.csv", False), ("s4/manifest.json", False)])
