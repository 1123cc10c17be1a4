"""What the report says of the paper's conclusions. Oracle: a made-up study of which it is known what it reproduces."""
import re
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

import made_up_study  # noqa: E402
from made_up_case import CheckCase  # noqa: E402


class Conclusions(CheckCase):
    def told(self):
        """{the paper's statement: (verdict, why)} of the report's first table."""
        self.assertEqual(self.run_command("report")[0], 0)
        page = (self.results / "report/report.html").read_text(encoding="utf-8")
        part = page[page.index('id="conclusions"'):page.index('class="tiles"')]
        rows = re.findall(r"<tr><td>(.*?) <span.*?</td><td[^>]*>(.*?)</td><td>(.*?)</td></tr>", part, re.S)
        return {statement: (verdict, why) for statement, verdict, why in rows}

    def test_reproduced_not_reproduced_and_not_to_be_tested(self):
        told = self.told()
        verdicts = {statement: verdict for statement, (verdict, _) in told.items()}
        self.assertEqual(len(told), 10)
        self.assertEqual(verdicts["Updating brings the model closer to the measurement."], "reproduced")
        # mode 1 of the made-up bridge has 1.5 % left at the design wind
        damping = told["With dampers every mode has more than 2 % damping up to 40.4 m/s."]
        self.assertEqual(damping[0], "not reproduced")
        self.assertIn("least 1.50 % in mode 1, 1 of 2 modes below 2 %", damping[1])
        self.assertEqual(verdicts["Vertical accelerations of the damped bridge stay below 0.7 m/s²."], "reproduced")
        lateral = told["Lateral accelerations of the damped bridge stay below 0.1 m/s², so that lock-in is avoided."]
        self.assertEqual(lateral[0], "not reproduced")
        self.assertIn("0.200 m/s²", lateral[1])
        self.assertEqual(sum(v == "cannot be tested" for v in verdicts.values()), 5)

    def test_another_order_is_not_reproduced(self):
        self.edit(self.results / "s7_aerodynamics/critical.csv", f"off,0.5,1,{1.002 * 22.40},", "off,0.5,1,21.7,")
        made_up_study.write_manifest(self.results / "s7_aerodynamics")
        self.assertEqual(self.run_command("tables")[0], 0)
        order = next(v for s, v in self.told().items() if s.startswith("Critical speeds rank"))
        self.assertEqual(order[0], "not reproduced")
        self.assertIn("H 21.7 &gt; D 21.84 is not so", order[1])

    def test_left_out_pairs_stand_beside_no_updating(self):
        """Made up: 6 % without updating, 2 % fitted, 7 and eight times 3 % predicted."""
        self.told()
        text = " ".join(re.sub(r"<[^>]+>", " ", (self.results / "report/report.html").read_text(encoding="utf-8")).split())
        self.assertIn("mean of the absolute errors 6.00 % 2.00 % 3.44 %", text)
        self.assertIn("Left out, 8 of 9 pairs are nearer to the measurement than without updating.", text)
        self.assertIn("Updating predicts better than the model as it was, by 2.56 points", text)
        self.assertIn("0.01000 without updating, 0.00600 with the paper's values of Table 8, 0.00400 with ours", text)


class Power(CheckCase):
    def test_the_page_shows_the_last_measurement_where_there_is_one(self):
        report = self.results / "report/report.html"
        self.assertEqual(self.run_command("report")[0], 0)
        self.assertNotIn("Power of the check", report.read_text(encoding="utf-8"))
        made_up_study.write_rows(self.results.parent / "check_power/power.csv",
                                 ["perturbation", "caught", "paper", "ratchet", "cells", "margin", "why", "file", "steps", "seconds"],
                                 [["softer steel", "yes", "yes", "yes", "table_02 row 1 column f_N_Hz; a; b; c", "2.5", "", "", "", "1"],
                                  ["shorter ramp", "no", "no", "no", "", "0.4", "No cell depends on it.", "", "", "1"]])
        self.assertEqual(self.run_command("report")[0], 0)
        text = " ".join(re.sub(r"<[^>]+>", " ", report.read_text(encoding="utf-8")).split())
        self.assertIn("1 of 2 changed inputs are caught by a number that does not print them (50 %), 1 by the paper gate alone (50 %).", text)
        self.assertIn("softer steel yes yes 4 2.5 table_02 row 1 column f_N_Hz; a; b and 1 more", text)
        self.assertIn("shorter ramp no no 0 0.4 No cell depends on it.", text)


if __name__ == "__main__":
    unittest.main()
