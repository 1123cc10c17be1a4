"""Numbers in guides that results hold. Oracle: files made here, of which every number is known."""
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "paper"))

from twindeck_report import prose  # noqa: E402
from twindeck_report.errors import InputError  # noqa: E402
from twindeck_report.study import Study  # noqa: E402


class Prose(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.study = Study("x", Path("results/x"), Path("data/x"), Path("workflows/x"))
        for path, text in (("results/x/s6/left.csv", "pair,error\n1X,-3.0\n2X,4.0\n3X,1234.5\n"),
                           ("results/x_virtual/s9/d.json", json.dumps({"verdict": "unknown", "gain": {"before": 2.5}, "effects": [{"cause": "fric", "at": "C1"}]}))):
            Path(path).parent.mkdir(parents=True)
            Path(path).write_text(text, encoding="utf-8")
        Path("docs").mkdir()

    def say(self, rule, text):
        Path("docs/a.md").write_text(f"# Head\n\nIt is <!--={rule}-->{text}<!--/--> so.\n", encoding="utf-8")
        return prose.check_prose(self.study)

    def test_what_a_mark_can_ask_for(self):
        for rule, text in (("x/s6/left.csv error pair=2X digits=1", "4.0"), ("x/s6/left.csv error pair=1X digits=0 signed", "-3"),
                           ("x/s6/left.csv error pair=2X digits=0 signed", "+4"), ("x/s6/left.csv error pair=3X digits=0", "1,234"),
                           ("x/s6/left.csv error max_abs digits=1", "1,234.5"), ("x/s6/left.csv error pair=1X factor=-0.001 digits=3", "0.003"),
                           ("x/s6/left.csv error count", "3"), ("x/s6/left.csv error mean_abs digits=2", "413.83"),
                           ("x_virtual/s9/d.json verdict", "unknown"), ("x_virtual/s9/d.json gain.before digits=1", "2.5"),
                           ("x_virtual/s9/d.json effects[0].cause", "fric"), ("x_virtual/s9/d.json effects[cause=fric].at", "C1")):
            self.assertEqual(self.say(rule, text), [], rule)

    def test_another_number_is_told_with_its_place_and_written_by_the_remedy(self):
        found = self.say("x/s6/left.csv error pair=2X digits=1", "5.0")
        self.assertEqual(found, ["docs/a.md:3: says '5.0', x/s6/left.csv error pair=2X digits=1 is '4.0'; run `make prose`"])
        self.assertEqual(prose.write_prose(self.study), [Path("docs/a.md")])
        self.assertEqual(prose.check_prose(self.study), [])
        self.assertIn("-->4.0<!--/--> so.", Path("docs/a.md").read_text())
        self.assertEqual(prose.write_prose(self.study), [])

    def test_marks_of_other_studies_are_left_alone(self):
        self.assertEqual(self.say("y/s6/left.csv error pair=2X digits=1", "5.0"), [])

    def test_a_mark_that_names_what_is_not_there_is_refused(self):
        for rule, said in (("x/s6/gone.csv error", "gone.csv: missing"), ("x/s6/left.csv eror", "no column eror"), ("x/s6/left.csv error", "3 rows; name one"),
                           ("x/s6/left.csv error pair=2X median", "'median'; expected one of"), ("x_virtual/s9/d.json gain.after", "has no gain.after")):
            with self.assertRaisesRegex(InputError, said, msg=rule):
                self.say(rule, "1")


class Guides(unittest.TestCase):
    def test_marks_of_the_guides_are_whole(self):
        """Each mark that is opened is closed, and names a file and a column."""
        held = 0
        for guide in (path for pattern in prose.GUIDES for path in ROOT.glob(pattern)):
            text = guide.read_text(encoding="utf-8")
            found = prose.marks(guide)
            self.assertEqual((text.count("<!--="), text.count("<!--/-->")), (len(found), len(found)), guide.name)
            self.assertTrue(all(len(mark.rule.split()) >= 2 for mark in found), guide.name)
            held += len(found)
        self.assertGreater(held, 0)


if __name__ == "__main__":
    unittest.main()
