"""The article refers to what there is. Oracle: the list of macros, tables and figures that the package makes; the paper's fourteen
tables and twenty-one figures, none of which may be left out."""
import re
import shutil
import sys
import unittest
from pathlib import Path
from unittest import mock

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

from made_up_case import MadeUpCase  # noqa: E402
from twindeck_report.article.numbers import ABSENT, camel, names  # noqa: E402
from twindeck_report.figures import FIGURES  # noqa: E402
from twindeck_report.tables import TABLES, table_name  # noqa: E402

SOURCE = HERE.parents[1] / "paper/article"


class Source(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.text = "\n".join(p.read_text(encoding="utf-8") for p in [SOURCE / "article.tex", *sorted((SOURCE / "sections").glob("*.tex"))])
        cls.drawn = re.findall(r"\\drawing(?:\[[^]]*\])?\{(\w+)\}", cls.text)
        cls.tables = re.findall(r"\\inputtable\{(\w+)\}", cls.text)

    def test_every_macro_exists(self):
        used = set(re.findall(r"\\((?:val|paper)[A-Z]\w*)", self.text))
        self.assertGreater(len(used), 50)
        self.assertEqual(used - set(names()), set())
        self.assertEqual(len(names()), len(set(names())), "each is defined once")
        self.assertTrue(all(re.fullmatch("[A-Za-z]+", name) for name in names()), "a macro's name holds letters alone")
        self.assertEqual(camel("preliminary_f10"), "PreliminaryFOneZero")

    def test_every_table_and_figure_exists_and_none_is_left_out(self):
        self.assertEqual(sorted(self.tables), sorted(table_name(n).removeprefix("table_") for n in TABLES))
        self.assertEqual(sorted(self.drawn), sorted(figure.NAME for figure in FIGURES))
        self.assertEqual(sum(bool(re.fullmatch(r"fig_\d\d", name)) for name in self.drawn), 21)

    def test_references_have_their_label(self):
        labels = {f"fig:{name}" for name in self.drawn} | {f"tab:table_{name}" for name in self.tables}
        self.assertEqual(set(re.findall(r"\\ref\{([^}]*)\}", self.text)) - labels, set())

    def test_sections_are_there(self):
        for name in re.findall(r"\\input\{(sections/\w+)\}", self.text):
            self.assertTrue((SOURCE / f"{name}.tex").is_file(), name)


class Making(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = MadeUpCase(cls.addClassCleanup)
        cls.results = cls.case.results
        code, _, err = cls.case.run("tables")
        assert code == 0, err

    def test_without_latex_it_says_how_to_get_it(self):
        """Its numbers are written all the same: each macro once, n/a for what the study has no step for."""
        with mock.patch.object(shutil, "which", return_value=None):
            code, _, err = self.case.run("article")
        self.assertEqual(code, 2)
        self.assertRegex(err, r"pdflatex is not here.*apt-get install.*texlive-latex-base.*`make paper STUDY=made_up` again\n\Z")
        made = {name: (self.results / "paper" / name).read_text(encoding="utf-8") for name in ("numbers.tex", "captions.tex", "errata.tex")}
        defined = dict(re.findall(r"\\newcommand\{\\(\w+)\}\{(.*)\}", made["numbers.tex"]))
        self.assertEqual(sorted(defined), sorted(names()))
        self.assertEqual((defined["valVerdict"], defined["valPreliminaryFOneZero"], defined["paperPreliminaryFOneZero"]), (ABSENT, "2.102", "2.100"))
        for name, text in made.items():
            self.assertTrue(text.isascii(), f"{name}: {re.findall('[^ -~]', text.replace(chr(10), ''))}")

    @unittest.skipUnless(shutil.which("pdflatex"), "LaTeX is not installed")
    def test_with_latex_a_page_comes_out(self):
        """Without drawings: they are left out where there are none."""
        code, _, err = self.case.run("article")
        self.assertEqual((code, err), (0, ""))
        self.assertTrue((self.results / "paper/paper.pdf").read_bytes().startswith(b"%PDF"))


if __name__ == "__main__":
    unittest.main()
