"""The figure of the campaigns' scores: what it shows of made-up tables, and what it says where none were scored.

Oracle: means and standard deviations worked out by hand.
"""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "paper"))
from twindeck_report.figures import identification_scoring as scoring  # noqa: E402
from twindeck_report.study import Study  # noqa: E402


class Scoring(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.study = Study(name="bridge", workflow=self.folder, results=self.folder / "results" / "bridge", data=self.folder)

    def words(self):
        figure, table = scoring.draw(self.study)
        return " ".join(t.get_text() for axes in figure.axes for t in [*axes.texts, axes.title, axes._left_title]), table

    def test_says_that_it_was_not_run(self):
        words, table = self.words()
        self.assertIn("not run: TWINDECK_SLOW=1", words)
        self.assertEqual(len(table), 0)

    def test_shows_errors_and_what_was_found(self):
        folder = self.study.results.parent / "scoring"
        folder.mkdir(parents=True)
        (folder / "identification_errors.csv").write_text("seed,state,mode,frequency_error,damping_error\n1,without_dampers,1,1.0,2.0\n"
                                                          "1,without_dampers,2,-1.0,-2.0\n")
        (folder / "identification_recall.csv").write_text("seed,state,selection,named,found,lost,spurious\n1,without_dampers,automatic,10,10,,0\n"
                                                          "2,without_dampers,automatic,10,9,3,1\n")
        words, table = self.words()
        self.assertEqual(len(table), 2)
        for expected in ("frequency: 2 errors, standard deviation 1.00", "damping: 2 errors, standard deviation 2.00", "9.50 of 10\n+ 0.50",
                         "mean of 2 campaigns"):
            self.assertIn(expected, words)


if __name__ == "__main__":
    unittest.main()
