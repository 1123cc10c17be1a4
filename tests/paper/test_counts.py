"""What the counts say. Oracle: cells made here, counted by hand."""
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "paper"))

import pandas as pd  # noqa: E402

from twindeck_report.compare import Cell  # noqa: E402
from twindeck_report.counts import count, mark_repetitions  # noqa: E402
from twindeck_report.simplest import SIMPLEST  # noqa: E402


def cell(row, kind, ours, paper="1.0", verdict="inside", simplest=""):
    made = Cell("t", row, "c", paper, ours, 0.0, 1.0, verdict == "inside", kind, "because", verdict=verdict)
    made.simplest = simplest
    return made


class Counts(unittest.TestCase):
    def test_the_predicted_numbers_come_first_in_few_words(self):
        found = count([cell("1", "predicted", "1.1"), cell("2", "predicted", "9.0", verdict="known"), cell("3", "calibrated", "1.2")], [])
        self.assertEqual(found.told, "Of 2 numbers computed without a fit to the paper, 1 agree with it; 1 does not, for reasons that are stated.")
        self.assertLessEqual(len(f"Paper check passed. {found.told}".split()), 25)
        self.assertEqual(list(found.kinds), ["predicted", "calibrated"])
        failing = count([cell("1", "predicted", "9.0", verdict="outside")], [])
        self.assertNotIn("stated", failing.told)
        self.assertEqual(count([cell("3", "calibrated", "1.2")], []).told, "No number is computed without a fit to the paper.")

    def test_a_recovered_number_counts_where_it_is_closer_than_the_simplest_rule(self):
        closer, further, alike = (cell(str(i), "recovered", ours, simplest=rule) for i, (ours, rule) in
                                  enumerate((("1.01", "1.02"), ("1.02", "1.01"), ("0.99", "1.01"))))
        found = count([closer, further, alike], []).kinds["recovered"]
        self.assertEqual((found.compared, found.inside, found.closer), (3, 3, 1))
        self.assertIn("recovered 3 of 3 inside, 1 of them closer than the simplest rule", found.told)

    def test_a_number_that_agrees_in_all_digits_counts_once(self):
        cells = [cell("1", "calibrated", "26.5012345678"), cell("2", "calibrated", "26.5012345678"), cell("3", "calibrated", "26.5012345679"),
                 cell("4", "predicted", "-1"), cell("5", "predicted", "-1")]
        mark_repetitions(cells, [])
        self.assertEqual([c.repeats for c in cells], ["", cells[0].name, "", "", ""])
        found = count(cells, [])
        self.assertEqual((found.independent, found.repetitions), (4, 1))


class SimplestRules(unittest.TestCase):
    """Oracles: a spectrum with two peaks, one of them the sum of two channels; a string's harmonics; a mean of three."""

    def test_the_peak_of_the_mean_spectrum_that_is_nearest_to_the_printed_frequency(self):
        psd = pd.DataFrame([(channel, f, value) for channel, values in (("a", (1, 5, 1, 1, 1)), ("b", (1, 1, 1, 4, 1)))
                            for f, value in zip((1.0, 1.1, 1.2, 1.3, 1.4), values)], columns=["channel", "frequency_Hz", "psd_m2_s3"])
        study = SimpleNamespace(step_csv=lambda name, columns: psd)
        paper = pd.DataFrame({"f": ["1.18", "1.45"]}, index=["1", "2"])
        self.assertEqual(SIMPLEST["peak"](study, "t", "f", paper, None), {"1": 1.1, "2": 1.3})

    def test_a_taut_string_through_another_harmonic(self):
        ours = pd.DataFrame({"f2_Hz": ["2.0"], "f3_Hz": ["3.3"]}, index=["a"])
        paper = pd.DataFrame({"f1_Hz": ["1"]}, index=["a"])
        found = {n: SIMPLEST["taut_string"](None, "t", f"f{n}_Hz", paper, ours)["a"] for n in (1, 2, 5)}
        self.assertEqual((found[1], found[5]), (1.0, 5.0))
        self.assertAlmostEqual(found[2], 2.2)

    def test_one_value_for_all(self):
        paper = pd.DataFrame({"z": ["1.0", "2.0", "6.0", ""]}, index=list("abcd"))
        self.assertEqual(SIMPLEST["one_value"](None, "t", "z", paper, None)["d"], 3.0)


class Words(unittest.TestCase):
    def test_a_claim_of_the_text_repeats_a_cell(self):
        claim = SimpleNamespace(independent=True, ours=26.5012345678, repeats="", name="speed")
        first = cell("1", "calibrated", "26.5012345678")
        mark_repetitions([first], [claim])
        self.assertEqual(claim.repeats, first.name)


if __name__ == "__main__":
    unittest.main()
