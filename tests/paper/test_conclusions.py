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
        self.assertEqual({v: list(verdicts.values()).count(v) for v in set(verdicts.values())}, {"reproduced": 10, "not reproduced": 6, "cannot be tested": 25})
        self.assertEqual(verdicts["Updating brings the model closer to the measurement."], "reproduced")
        # mode 1 of the made-up bridge has 1.5 % left at the design wind
        damping = told["With dampers every mode has more than 2 % damping up to 40.4 m/s."]
        self.assertEqual(damping[0], "not reproduced")
        self.assertIn("least 1.50 % in mode 1, 1 of 2 modes below 2 %", damping[1])
        self.assertEqual(verdicts["Vertical accelerations of the damped bridge stay below 0.7 m/s²."], "reproduced")
        lateral = told["Lateral accelerations of the damped bridge stay below 0.1 m/s², so that lock-in is avoided."]
        self.assertEqual(lateral[0], "not reproduced")
        self.assertIn("0.200 m/s²", lateral[1])
        # the made-up moduli fall by 0.1 % in the mean (9.5, -15, 5 and -5 and their like in print), densities by 27
        self.assertIn("moduli -1.4 %, densities -27.0 % in the mean", told["An average increase of stiffness and a decrease of densities shift the frequencies up."][1])

    def test_a_mode_that_a_setup_misses_is_named(self):
        path = self.results / "s2_sensors/blind_test.csv"
        rows = made_up_study.read_rows(path)
        missed = [r for r in rows if r["setup"] == "DC1"][2]
        missed["found"] = "0"
        made_up_study.write_rows(path, list(rows[0]), [list(r.values()) for r in rows])
        made_up_study.write_manifest(self.results / "s2_sensors")
        self.assertEqual(self.run_command("tables")[0], 0)
        verdict, why = next(v for s, v in self.told().items() if s.startswith("In the blind test"))
        self.assertEqual(verdict, "not reproduced")
        self.assertIn(f"DC1 misses mode {missed['mode']}.", why)

    def test_the_list_is_written_for_a_spreadsheet_and_summed_up(self):
        code, out, _ = self.run_command("verify")
        self.assertEqual(code, 0)
        self.assertIn("41 statements of the paper: 10 reproduced, 6 not reproduced, 25 cannot be tested", out)
        rows = made_up_study.read_rows(self.results / "report/conclusions.csv")
        self.assertEqual((len(rows), list(rows[0])), (41, ["statement", "where", "verdict", "why"]))

    def test_another_order_is_not_reproduced(self):
        self.edit(self.results / "s7_aerodynamics/critical.csv", f"off,0.5,1,{1.002 * 22.40},", "off,0.5,1,21.7,")
        made_up_study.write_manifest(self.results / "s7_aerodynamics")
        self.assertEqual(self.run_command("tables")[0], 0)
        order = next(v for s, v in self.told().items() if s.startswith("Critical speeds rank"))
        self.assertEqual(order[0], "not reproduced")
        self.assertIn("H 21.7 &gt; D 21.84 is not so", order[1])

    def decide(self, table, columns, rows, beginning):
        """What the report tells of a statement once a step has written this table."""
        made_up_study.write_rows(self.results / table, columns, rows)
        made_up_study.write_manifest((self.results / table).parent)
        self.assertEqual(self.run_command("tables")[0], 0)
        return next(v for s, v in self.told().items() if s.startswith(beginning))

    def test_free_decays_beside_ambient_vibration(self):
        columns = ["condition", "setup", "mode", "frequency_Hz", "ambient_frequency_Hz", "mac"]
        alike, far, unlike = ["c", "FD1", 1, 1.01, 1.0, 0.95], ["c", "FD1", 2, 1.03, 1.0, 0.95], ["c", "FD1", 3, 1.0, 1.0, 0.85]
        none = ["c", "FD1", 4, 1.0, "", ""]
        verdict, why = self.decide("s3_identification/decays.csv", columns, [alike, alike], "Free decays")
        self.assertEqual((verdict, "2 of 2 modes" in why), ("reproduced", True))
        verdict, why = self.decide("s3_identification/decays.csv", columns, [alike, far, unlike, none], "Free decays")
        self.assertEqual((verdict, "1 of 4 modes" in why), ("not reproduced", True))

    def test_which_deck_gallops_and_where_static_wind_differs(self):
        path = self.results / "s7_aerodynamics/critical.csv"
        rows = made_up_study.read_rows(path)
        for deck, expected in (("foot", "reproduced"), ("cycle", "not reproduced")):
            told = self.decide("s7_aerodynamics/critical.csv", [*rows[0], "deck", "deck_share"], [[*r.values(), deck, 0.9] for r in rows], "What gallops")
            self.assertEqual((told[0], f"the {deck} deck" in told[1]), (expected, True))
        columns = ["set", "model", "deck", "node", "station_m", "x_m", "y_m", "z_m"]
        for middle, expected in ((3, "reproduced"), (1, "not reproduced")):
            static = [["standin", model, deck, n, 10.0 * n, 0.0, 0.001 * (model == "H") * (2.0 if (deck, n) == ("foot", middle) else 1.0), 0.0]
                      for model in "GH" for deck in ("foot", "cycle") for n in range(1, 6)]
            self.assertEqual(self.decide("s7_aerodynamics/static.csv", columns, static, "The static displacements")[0], expected)

    def test_wind_along_y_and_the_static_part(self):
        """Made up: 1.002 times the printed speeds."""
        told = self.told()
        self.assertEqual(next(v for s, v in told.items() if s.startswith("With wind along Y"))[0], "reproduced")
        path = self.results / "s7_aerodynamics/critical.csv"
        rows = made_up_study.read_rows(path)
        slow = next(r for r in rows if r["model"] == "G" and r["set"] == "standin")
        slow["V_cr_m_s"] = "15.0"
        made_up_study.write_rows(path, list(rows[0]), [list(r.values()) for r in rows])
        made_up_study.write_manifest(self.results / "s7_aerodynamics")
        self.assertEqual(self.run_command("tables")[0], 0)
        told = self.told()
        for beginning, words in (("With wind along Y", "A 20.04, G 15.00"), ("The rule of the static load", "G 15.00, I ")):
            verdict, why = next(v for s, v in told.items() if s.startswith(beginning))
            self.assertEqual((verdict, words in why), ("not reproduced", True), why)

    def test_a_couple_that_a_setup_merges_is_named(self):
        columns = ["setup", "mode", "frequency_Hz", "found", "identified_frequency_Hz"]
        for lost, expected in ((None, "reproduced"), (("DC1", 9), "not reproduced"), (("DC1", 5), "reproduced")):
            rows = [[s, m, 1.0 + 0.1 * m, int((s, m) != lost), 1.0 + 0.1 * m] for s in ("ST1", "DC1") for m in range(1, 11)]
            verdict, why = self.decide("s2_sensors/blind_test.csv", columns, rows, "Each of the six setups")
            self.assertEqual((verdict, "DC1 misses mode 9." in why), (expected, expected != "reproduced"), why)

    def test_left_out_pairs_stand_beside_no_updating(self):
        """Made up: 6 % without updating, 2 % fitted, 7 and eight times 3 % predicted."""
        self.told()
        text = " ".join(re.sub(r"<[^>]+>", " ", (self.results / "report/report.html").read_text(encoding="utf-8")).split())
        self.assertIn("mean of the absolute errors 6.00 % 3.44 % 2.00 %", text)
        self.assertIn("Left out, 8 of 9 pairs are nearer to the measurement than without updating.", text)
        self.assertIn("The updating predicts: pairs that are left out of it are 3.44 % off in the mean, without any updating 6.00 %.", text)

    def test_an_update_that_predicts_worse_than_none_stands_beside_the_regularised_one(self):
        """Made up: left out, pairs are 9 % off; held to the ranges, 5 %."""
        folder = self.results / "s6_updating"
        rows = made_up_study.read_rows(folder / "leave_one_out.csv")
        for name, error in (("leave_one_out", 9.0), ("leave_one_out_regularised", -5.0)):
            made_up_study.write_rows(folder / f"{name}.csv", list(rows[0]), [list({**r, "error_predicted_pct": error}.values()) for r in rows])
        made_up_study.write_rows(folder / "regularised.csv", ["parameter"], [["rho_1"]])
        made_up_study.write_manifest(folder)
        self.assertEqual(self.run_command("tables")[0], 0)
        self.told()
        text = " ".join(re.sub(r"<[^>]+>", " ", (self.results / "report/report.html").read_text(encoding="utf-8")).split())
        self.assertIn("The updating does not predict: pairs that are left out of it are 9.00 % off in the mean, without any updating 6.00 %.", text)
        self.assertIn("the model's error estimated) it is 5.00 %:", text)
        self.assertIn("mean of the absolute errors 6.00 % 9.00 % 5.00 % 2.00 %", text)
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
