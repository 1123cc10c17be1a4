"""Published numbers stand twice: as printed (data/ponte_del_mare/paper) and as rows and claims of the diagnosis. Oracle: the printed tables.
"""
import csv
import math
import pathlib
import unittest

DATA = pathlib.Path(__file__).resolve().parents[2] / "data/ponte_del_mare"


def table(name):
    with open(DATA / name, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


class PublishedEvidence(unittest.TestCase):
    def test_rows_are_table_4(self):
        rows = {(r["type"], r["mode"], r["condition"]): r for r in table("features/rows.csv")}
        for printed in table("paper/table_04.csv"):
            for state in ("without", "with"):
                frequency = rows.pop(("frequency_Hz", printed["mode"], f"tests_{state}_dampers"))
                damping = rows.pop(("damping_ratio_pct", printed["mode"], f"tests_{state}_dampers"))
                self.assertEqual(float(frequency["value"]), float(printed[f"f_X_{state}_dampers_Hz"]))
                self.assertEqual(float(damping["value"]), float(printed[f"zeta_{state}_dampers_pct"]))
                self.assertAlmostEqual(float(frequency["std"]), math.hypot(0.0005 / math.sqrt(3.0), 0.005 * float(frequency["value"])), places=9)
                self.assertAlmostEqual(float(damping["std"]), 0.15 * float(damping["value"]), places=9)
        self.assertEqual(list(rows), [("frequency_Hz", "11", "tests_without_dampers")])  # 11X of Table 9

    def test_claims_are_tables_8_9_10_and_13(self):
        claims = {(c["kind"], c["name"], c["record"]): float(c["value"]) for c in table("features/claims.csv")}
        for printed in table("paper/table_08.csv"):
            self.assertEqual(claims.pop(("parameter_change_pct", printed["parameter"], "")), float(printed["change_pct"]))
        mac = {r["numerical_mode"]: r for r in table("paper/table_10.csv")}
        for printed in table("paper/table_09.csv"):
            pair = f"{printed['experimental_mode']}-{printed['numerical_mode']}"
            self.assertEqual(claims.pop(("frequency_error_pct", pair, "")), float(printed["error_pct"]))
            self.assertEqual(claims.pop(("mac", pair, "")), float(mac[printed["numerical_mode"]][f"MAC_{printed['experimental_mode']}"]))
        for printed in table("paper/table_13.csv"):
            for column, value in printed.items():
                if column != "accelerometer":
                    self.assertEqual(claims.pop(("rms_error_pct", printed["accelerometer"], column.replace("_err_pct", ""))), float(value))
        self.assertEqual(claims, {})


if __name__ == "__main__":
    unittest.main()
