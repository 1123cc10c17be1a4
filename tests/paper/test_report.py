"""Figures and the report page. Oracle: what the made-up study (made_up_study.py) holds by construction, and that the same input
gives the same bytes."""
import csv
import hashlib
import re
import sys
import unittest
from html.parser import HTMLParser
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

import made_up_study  # noqa: E402
from made_up_case import MadeUpCase  # noqa: E402
from twindeck_report.cells import shown  # noqa: E402
from twindeck_report.figures import FIGURES  # noqa: E402
from twindeck_report.tables import TABLES  # noqa: E402

VOID = {"meta", "img", "br", "input"}


class Balance(HTMLParser):
    """Collects links and tags that are closed in another order than they were opened."""

    def __init__(self):
        super().__init__()
        self.open, self.wrong, self.links = [], [], []

    def handle_starttag(self, tag, attributes):
        if tag not in VOID:
            self.open.append(tag)
        self.links += [value for key, value in attributes if key in ("src", "href")]

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append((tag, self.getpos()))


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = MadeUpCase(cls.addClassCleanup)
        cls.results = cls.case.results
        for command in ("tables", "figures", "report"):
            code, _, err = cls.case.run(command)
            assert code == 0, err

    def test_figures_and_their_data(self):
        for name in ("fig_01", "fig_05", "sensitivity_map", "updating_history"):
            for suffix, magic in ((".pdf", b"%PDF"), (".png", b"\x89PNG")):
                path = self.results / "figures" / (name + suffix)
                self.assertTrue(path.read_bytes().startswith(magic), path)
        data = {n: made_up_study.read_rows(self.results / f"figures/{n}.csv")
                for n in ("fig_01", "fig_05", "sensitivity_map", "updating_history")}
        self.assertEqual([r["step"] for r in data["fig_01"]], made_up_study.STEPS)
        self.assertEqual(len(data["fig_05"]), 2 * 43, "two modes at every node")
        self.assertEqual(max(float(r["shape_z"]) for r in data["fig_05"] if r["mode"] == "1"), 1.0)
        self.assertEqual(len(data["sensitivity_map"]), 15 * 15)
        self.assertEqual({r["parameter"] for r in data["sensitivity_map"] if r["selected"] == "1"},
                         {p[0] for p in made_up_study.PARAMETERS})
        self.assertEqual(len(list((self.results / "figures").glob("fig_*.png"))), 21, "every figure of the paper")
        self.assertEqual({r["start"] for r in data["updating_history"]}, {"0"}, "the start of least cost")

    def test_same_input_same_bytes(self):
        def hashes():
            return {p.name: hashlib.sha256(p.read_bytes()).hexdigest()
                    for part in ("tables", "figures") for p in (self.results / part).iterdir() if p.name != "manifest.json"}

        before = hashes()
        self.assertEqual((self.case.run("tables")[0], self.case.run("figures")[0]), (0, 0))
        self.assertEqual(hashes(), before)

    def test_page_stands_alone(self):
        page = (self.results / "report/report.html").read_text(encoding="utf-8")
        reader = Balance()
        reader.feed(page)
        self.assertEqual((reader.wrong, reader.open), ([], []))
        self.assertTrue(all(link.startswith(("#", "data:image/png;base64,")) for link in reader.links))
        outside = re.search(r"url\((?!#)|@import|<script[^>]*src|https?://", re.sub(r"<script>.*?</script>", "", page, flags=re.S))
        self.assertIsNone(outside and outside.group())
        self.assertEqual(page.count('class="paper-table"'), len(TABLES))
        drawn = [f for f in FIGURES if all(step in made_up_study.STEPS for step in f.NEEDS)]
        self.assertEqual(page.count("src=\"data:image/png"), len(drawn) + 1, "the figures, and the sheet of mode shapes for print")
        for token in made_up_study.STEPS:
            self.assertIn(f"<strong>{token}</strong>", page)

    def test_page_tells_bounds_and_trust_region(self):
        """Four of nine end on a bound. Reach sqrt(2 0.05^2 + 5 0.15^2 + 2 0.3^2) = 0.545, the box's diagonal twice that."""
        text = " ".join(re.sub(r"<[^>]+>", " ", (self.results / "report/report.html").read_text(encoding="utf-8")).split())
        self.assertIn("4 of 9 parameters end on a bound here, 4 in the paper", text)
        self.assertIn("reach 0.55 from the initial values, and the box of admissible values is 1.09 from corner", text)
        self.assertIn("the region never cuts a step that stays inside the bounds", text)

    def test_tables_keep_twelve_digits_and_show_the_papers(self):
        """Mode 1 of Table 2: 0.736 Hz in the made-up paper, times 1.003 in the made-up step."""
        row = made_up_study.read_rows(self.results / "tables/table_02.csv")[0]
        self.assertEqual(row, {"mode": "1", "f_N_Hz": "0.738208", "f_N_Hz_paper": "0.736", "f_N_Hz_kind": "calibrated"})
        self.assertIn("1 & 0.738 (0.736)", (self.results / "tables/table_02.tex").read_text(encoding="utf-8"))
        with (self.results / "tables/table_09.csv").open(encoding="utf-8", newline="") as lines:
            cells = [r[column] for r in csv.DictReader(lines) for column in ("f_N_Hz", "error_pct")]
        digits = [c.replace("-", "").replace(".", "").lstrip("0") for c in cells]
        self.assertTrue(all(len(d) <= 12 for d in digits))
        self.assertEqual(shown("-0.004", "1.15"), "0.00", "no negative zero")
        self.assertEqual(shown(1141.95, "1140"), "1142")


if __name__ == "__main__":
    unittest.main()
