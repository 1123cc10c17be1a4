"""A study's tables in one workbook and back. Oracle: the cells of the CSV files themselves, read again by openpyxl and by the product's own reader."""
import csv
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
READER = ROOT / "workflows/common/spreadsheet.py"

try:
    import openpyxl
except ImportError:
    openpyxl = None


def export(*arguments, python=sys.executable, **environment):
    return subprocess.run([python, "-m", "twindeck_export", "--xlsx", *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, "PYTHONPATH": f"{ROOT / 'paper'}:{os.environ.get('PYTHONPATH', '')}", **environment}, timeout=120)


class WithoutOpenpyxl(unittest.TestCase):
    """A module of that name that cannot be imported stands before any that is installed."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (self.folder / "openpyxl.py").write_text("raise ImportError\n")

    def test_export_names_the_package(self):
        done = export(self.folder, PYTHONPATH=f"{self.folder}:{ROOT / 'paper'}")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("apt-get install python3-openpyxl", done.stderr)


    def test_the_reader_says_why_it_reads_nothing(self):
        """A module of that name whose workbook has no sheet, an empty one, or one with a cell; and none that can be imported."""
        book = "class S:\n    def iter_rows(self, values_only): return {}\nclass B: worksheets = {}\ndef load_workbook(*a, **k): return B\n"
        for module, code, told in ((book.format("[]", "[]"), 6, ""), (book.format("[(None, None), ()]", "[S()]"), 6, ""), (book.format("[(None,), ('a', 1.0)]", "[S()]"), 0, "a,1\n"),
                                   ("raise ImportError\n", 4, "")):
            (self.folder / "openpyxl.py").write_text(module)
            done = subprocess.run([sys.executable, "-B", READER, "book.xlsx"], capture_output=True, text=True, env={**os.environ, "PYTHONPATH": str(self.folder)}, timeout=60)
            self.assertEqual((done.returncode, done.stdout), (code, told), done.stderr)


@unittest.skipUnless(openpyxl, "no openpyxl here")
class Workbook(unittest.TestCase):
    def setUp(self):
        self.results = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "bridge"
        for step, name, rows in (("s10_reliability", "years", [["year", "note"], ["1", "=1+1"]]),
                                 ("s1_model", "modes", [["mode", "frequency_Hz"], ["1", "1.25"], ["2", ""], ["3", "nan"]]),
                                 ("s1_model", "a_table_of_a_long_name_that_goes_on", [["a"], ["x"]]),
                                 ("s1_model", "a_table_of_a_long_name_that_goes_on_2", [["a"], ["y"]])):
            (self.results / step).mkdir(parents=True, exist_ok=True)
            with open(self.results / step / f"{name}.csv", "w", newline="") as file:
                csv.writer(file).writerows(rows)

    def test_every_table_is_a_sheet_and_no_text_is_a_formula(self):
        done = export(self.results)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        book = openpyxl.load_workbook(self.results / "tables.xlsx")
        self.assertEqual(len(book.sheetnames), 5)
        self.assertEqual(len({name.lower() for name in book.sheetnames}), 5)
        self.assertEqual([[cell.value for cell in row] for row in book["s1 modes"]], [["mode", "frequency_Hz"], [1, 1.25], [2, None], [3, "nan"]])
        cell = book["s10 years"]["B2"]
        self.assertEqual((cell.value, cell.data_type), ("=1+1", "s"))
        self.assertEqual(book.sheetnames[-1], "s10 years")

    def test_no_results(self):
        for folder, words in ((self.results / "nowhere", "no folder of results"), (self.results.parent / "empty", "holds no table")):
            (self.results.parent / "empty").mkdir(exist_ok=True)
            done = export(folder)
            self.assertEqual(done.returncode, 2)
            self.assertIn(words, done.stderr)

    def test_the_first_sheet_comes_back_as_it_was(self):
        book = openpyxl.Workbook()
        rows = [["time_s", "A_x"], [0, 1.5], [0.02, -3], [0.04, 1 / 3]]
        for row in rows:
            book.active.append(row)
        book.save(self.results / "record.xlsx")
        done = subprocess.run([sys.executable, READER, self.results / "record.xlsx"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0)
        back = list(csv.reader(io.StringIO(done.stdout)))
        self.assertEqual(back[0], rows[0])
        self.assertEqual([[float(cell) for cell in row] for row in back[1:]], rows[1:])

    def test_what_is_no_workbook(self):
        (self.results / "record.xlsx").write_text("no workbook")
        self.assertEqual(subprocess.run([sys.executable, READER, self.results / "record.xlsx"]).returncode, 3)


if __name__ == "__main__":
    unittest.main()
