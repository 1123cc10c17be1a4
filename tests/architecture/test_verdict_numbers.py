"""How many numbers and rules shape a verdict of step 9 (verdict_numbers.py). One more has to bring its figures, with and without it, on fresh seeds
(docs/diagnosis.md); the aim is 25 numbers and 6 rules.

Oracle: the counts held here, and sources written here whose numbers are known.
"""
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import verdict_numbers  # noqa: E402

NUMBERS, RULES = 42, 7


class VerdictNumbers(unittest.TestCase):
    def test_no_number_and_no_rule_comes_or_goes_unseen(self):
        for title, found, held in (("numbers", verdict_numbers.numbers(), NUMBERS), ("rules", verdict_numbers.rules(), RULES)):
            with self.subTest(title):
                self.assertEqual(len(found), held, f"{title} that shape a verdict: {found}; hold {len(found)} here if that is meant")

    def test_each_name_and_each_entry_of_a_list_counts(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "law_made_up.cpp").write_text("constexpr double kOne = 1.0, kTwo = 2.0;  // why\nconst double kMany[] = {0.0, 1.5, 3.0};\n"
                                                "constexpr double kUnitOfClasses = 0.01;\n  double local = 4.0;\n  out_.verdict = Verdict::unknown;\n"
                                                "  if (out_.verdict == Verdict::none) return;\n")
        (folder / "diagnose.hpp").write_text("struct DiagnoseOptions {\n  double static_odds = -13.0;\n  int bootstrap = 2000;\n};\n")
        self.assertEqual([name for _, name in verdict_numbers.numbers(folder)], ["kOne", "kTwo", "kMany", "kMany", "kMany", "static_odds"])
        self.assertEqual(len(verdict_numbers.rules(folder)), 1)


if __name__ == "__main__":
    unittest.main()
