"""States side by side. Oracle: shapes that are unit vectors of four channels, so that two are alike with MAC 1 or 0, mixed ones by (a . b)^2; a mode missed
in one state, which shifts the numbers of those above it."""
import sys
import unittest
from math import cos, radians, sin
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "paper"))

from twindeck_report.page import telling  # noqa: E402
from twindeck_report.page.telling import Telling, Told  # noqa: E402

CHANNELS = ("a", "b", "c", "d")
UNIT = [{c: complex(i == j) for j, c in enumerate(CHANNELS)} for i in range(4)]


def row(mode, state, measured):
    return Told(str(mode), state, measured, measured, measured, weight=measured)


def shown(rows, shapes):
    found = telling.table(Telling(rows, "before", "after", shapes=shapes))
    return [(r["mode"], [(c[0], c[3]) for c in r["cells"]]) for r in found["rows"]], found["notes"]


class SideBySide(unittest.TestCase):
    def test_a_missed_mode_does_not_shift_the_others(self):
        """Modes at 2, 3, 4, 5 Hz in January; July misses that at 3 Hz and lies 1 % lower."""
        rows = [row(i + 1, "january", f) for i, f in enumerate((2.0, 3.0, 4.0, 5.0))] + [row(i + 1, "july", f) for i, f in enumerate((1.98, 3.96, 4.95))]
        shapes = {(str(i + 1), "january"): UNIT[i] for i in range(4)} | {(str(i + 1), "july"): UNIT[j] for i, j in enumerate((0, 2, 3))}
        found, notes = shown(rows, shapes)
        self.assertEqual(found, [("1", [("2.000", ""), ("1.980", "")]), ("2", [("3.000", ""), ("", "")]), ("3", [("4.000", ""), ("3.960", "2")]), ("4", [("5.000", ""), ("4.950", "3")])])
        self.assertEqual(notes, "No mode of july is mode 2 of january (MAC 0.00 with its mode 2, 0.00 at most); mode 2 of july is mode 3 of january by its shape (MAC 1.00); "
                                "mode 3 of july is mode 4 of january by its shape (MAC 1.00).")

    def test_a_mode_of_one_state_has_a_row_of_its_own(self):
        rows = [row(1, "january", 2.0), row(2, "january", 3.0), row(1, "july", 2.0), row(2, "july", 2.5)]
        shapes = {("1", "january"): UNIT[0], ("2", "january"): UNIT[1], ("1", "july"): UNIT[0], ("2", "july"): UNIT[2]}
        self.assertEqual(shown(rows, shapes)[0], [("1", [("2.000", ""), ("2.000", "")]), ("2", [("3.000", ""), ("", "")]), ("2 (july)", [("", ""), ("2.500", "")])])

    def test_close_modes_that_mix_stay_in_one_row_and_are_told(self):
        """Turned by 50 degrees in the plane of both: MAC cos(50)^2 = 0.41 with the mode of the same name."""
        c, s = cos(radians(50.0)), sin(radians(50.0))
        turned = {"a": c, "b": s, "c": 0.0, "d": 0.0}
        rows = [row(1, "january", 2.0), row(1, "july", 2.0)]
        found, notes = shown(rows, {("1", "january"): UNIT[0], ("1", "july"): turned})
        self.assertEqual(found, [("1", [("2.000", ""), ("2.000", "")])])
        self.assertEqual(notes, "The shapes of mode 1 in january and july are little alike (MAC 0.41).")

    def test_a_phase_or_a_factor_does_not_matter_and_a_changed_frequency_neither(self):
        """Another state of a structure may shift a mode by 20 %; its shape tells that it is the same."""
        rows = [row(1, "january", 2.0), row(2, "january", 2.4), row(1, "july", 2.4), row(2, "july", 2.9)]
        shapes = {(m, s): {c: (1j if s == "july" else 1.0) * (3.0 if s == "july" else 1.0) * v for c, v in UNIT[int(m)].items()} for m in "12" for s in ("january", "july")}
        found, notes = shown(rows, shapes)
        self.assertEqual(found, [("1", [("2.000", ""), ("2.400", "")]), ("2", [("2.400", ""), ("2.900", "")])])
        self.assertEqual(notes, "")

    def test_without_shapes_names_stand_and_a_doubt_is_told(self):
        for measured, doubt in ((3.9, ""), (5.2, "Mode 1 may be another one in july than in january: its frequency is 30 % off, and no shapes tell.")):
            found, notes = shown([row(1, "january", 4.0), row(1, "july", measured)], {})
            self.assertEqual(len(found), 1)
            self.assertEqual(notes, doubt)
        two = {("1", s): {"a": 1.0, "b": float(s == "july")} for s in ("january", "july")}
        self.assertEqual(len(shown([row(1, "january", 4.0), row(1, "july", 5.2)], two)[0]), 1, "two channels tell nothing")


if __name__ == "__main__":
    unittest.main()
