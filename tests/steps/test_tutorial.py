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


class Tutorial(unittest.TestCase):
    def test_every_command_prints_what_the_page_says(self):
        with tempfile.TemporaryDirectory() as holder:
            folder, tools = pathlib.Path(holder) / "empty", pathlib.Path(holder) / "tools"
            folder.mkdir()
            tools.mkdir()
            (tools / "python3").symlink_to(sys.executable)
            environment = {**os.environ, "PATH": f"{tools}:{BIN}:{os.environ['PATH']}", "OMP_NUM_THREADS": "1"}
            printed, commands = None, 0
            for language, name, content in guide.blocks(PAGE.read_text(encoding="utf-8")):
                if language == "python":
                    (folder / name).write_text(content, encoding="utf-8")
                elif language == "sh":
                    done = subprocess.run(["sh", "-e", "-c", content], cwd=folder, env=environment, capture_output=True, text=True, timeout=300)
                    self.assertEqual(done.returncode, 0, f"{content}\n{done.stderr}")
                    printed = done.stdout
                    commands += len(content.strip().splitlines())
                elif language == "text":
                    self.assertEqual(guide.differences(content, printed), [])
            self.assertGreater(commands, 10)
            rows = [line.split(",") for line in (folder / "results/s6_updating/parameters.csv").read_text().splitlines()[1:]]
            found = {row[0]: float(row[3]) for row in rows}
            # The structure's own values, 7/12 and 1.10; the standard deviations of four frequencies of ten minutes leave a few per cent
            self.assertAlmostEqual(found["k_base"] / (7 / 12), 1.0, delta=0.05)
            self.assertAlmostEqual(found["m_floor"] / 1.10, 1.0, delta=0.01)

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
