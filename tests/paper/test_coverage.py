"""No printed number is left out. Oracle: the paper itself, whose tables hold 379 numbers beside the names of their rows (counted by
hand, table by table, below), and whose text states numbers in ten of its sections."""
import re
import sys
import unittest
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "paper"))

from twindeck_report.claims import COMPUTED  # noqa: E402
from twindeck_report.coverage import lacking, printed_numbers  # noqa: E402
from twindeck_report.study import Study  # noqa: E402
from twindeck_report.tables import TABLES, paper_number  # noqa: E402
from twindeck_report.tolerances import KINDS, read_tolerances  # noqa: E402

# rows x columns of numbers; Table 1: units twice, c, and k with its tolerance for A and B (units "2+2" is no number); Table 11: NS #1-3
PRINTED = {"table_01": 2 + 3 + 3 + 2 + 2, "table_02": 9, "table_03": 6, "table_04": 10 * 4, "table_05": 6 * 7, "table_06": 10 * 3,
           "table_07": 10 * 3, "table_08": 9 * 3, "table_09": 9 * 3, "table_10": 9 * 9, "table_11": 3, "table_12": 6 * 2,
           "table_13": 8 * 6, "table_14": 6 * 2}


class Coverage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        data = REPOSITORY / "data/ponte_del_mare"
        cls.study = Study("ponte_del_mare", REPOSITORY / "results/none", data, REPOSITORY / "workflows/ponte_del_mare")
        cls.tolerances = read_tolerances(cls.study)
        cls.claims = cls.study.read_csv(data / "paper/claims.csv", text=True).to_dict("records")

    def test_every_printed_number_has_a_rule(self):
        found = {table: len(cells) for table, cells in printed_numbers(self.study, self.tolerances).items()}
        self.assertEqual(found, PRINTED)
        self.assertEqual(sum(found.values()), 379)
        self.assertEqual(lacking(self.study, self.tolerances), [])

    def test_fourteen_tables(self):
        self.assertEqual(sorted({paper_number(n) for n in TABLES}), list(range(1, 15)))

    def test_every_claim_is_computed_or_says_why_not(self):
        names = [claim["claim"] for claim in self.claims]
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual(set(COMPUTED) - set(names), set(), "computed, but no statement of the paper")
        for claim in self.claims:
            self.assertNotEqual(claim["claim"] in COMPUTED, bool(claim["why_not"]), claim["claim"])
            self.assertIn(claim["kind"], KINDS)
            self.assertTrue(claim["source"], claim["claim"])

    def test_claims_of_every_section_that_states_numbers(self):
        cited = {match for claim in self.claims for match in re.findall(r"section (\d(?:\.\d)?)", claim["source"])}
        self.assertLessEqual({"1.1", "2.1", "2.2", "3.1", "3.2", "4.1", "4.2", "5.1", "5.2", "6"}, cited)


if __name__ == "__main__":
    unittest.main()
