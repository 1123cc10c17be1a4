"""The tutorial's files and commands, taken from the page and run from an empty folder.

Oracle: what the page says is printed, to its stated digits; and the values of the structure that the records stand for.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import guide  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ["TWINDECK_BIN"]).resolve()
PAGE = ROOT / "docs" / "tutorial.md"
CONTINUED = ROOT / "docs" / "tutorial_diagnosis.md"


class Tutorial(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder, tools = pathlib.Path(holder.name) / "empty", pathlib.Path(holder.name) / "tools"
        cls.folder.mkdir()
        tools.mkdir()
        (tools / "python3").symlink_to(sys.executable)
        cls.environment = {**os.environ, "PATH": f"{tools}:{BIN}:{os.environ['PATH']}", "OMP_NUM_THREADS": "1"}

    def follow(self, page):
        """Writes the page's files, runs its commands, compares what they print. Returns the number of commands."""
        printed, commands = None, 0
        for language, name, content in guide.blocks(page.read_text(encoding="utf-8")):
            if name:
                (self.folder / name).parent.mkdir(exist_ok=True)
                (self.folder / name).write_text(content, encoding="utf-8")
            elif language == "sh":
                done = subprocess.run(["sh", "-e", "-c", content], cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=300)
                self.assertEqual(done.returncode, 0, f"{content}\n{done.stderr}")
                printed = done.stdout
                commands += len(content.strip().splitlines())
            elif language == "text":
                self.assertEqual(guide.differences(content, printed), [])
        return commands

    def test_every_command_prints_what_the_pages_say(self):
        self.assertGreater(self.follow(PAGE), 10)
        rows = [line.split(",") for line in (self.folder / "results/s6_updating/parameters.csv").read_text().splitlines()[1:]]
        found = {row[0]: float(row[3]) for row in rows}
        # The structure's own values, 7/12 and 1.10; the standard deviations of four frequencies of ten minutes leave a few per cent
        self.assertAlmostEqual(found["k_base"] / (7 / 12), 1.0, delta=0.05)
        self.assertAlmostEqual(found["m_floor"] / 1.10, 1.0, delta=0.01)
        if not (BIN / "s9_diagnosis").exists():
            self.skipTest("s9_diagnosis is not built: the second page is not followed")
        self.assertGreater(self.follow(CONTINUED), 10)

    def test_template_is_the_tutorials_frame(self):
        script = next(content for language, name, content in guide.blocks(PAGE.read_text(encoding="utf-8")) if name == "frame.py")
        self.assertEqual((ROOT / "data/template/frame.py").read_text(), script)


class Comparison(unittest.TestCase):
    """The comparison itself can fail."""

    def test_digits(self):
        self.assertEqual(guide.differences("1,2.467", "1,2.46708223"), [])
        self.assertTrue(guide.differences("1,2.467", "1,2.4661"))
        self.assertTrue(guide.differences("1,2.467", "1,2.4661\n2,3"))
        self.assertTrue(guide.differences("k_base,2.4", "m_base,2.4"))


if __name__ == "__main__":
    unittest.main()
