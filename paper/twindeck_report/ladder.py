"""Row H of Table 12 in two readings: as Table 11 prints it (derivatives unchanged), which is compared, and with the derivatives' block on
the oblique strip too, an inference of ours from the printed speeds. Those of C, H and G form a geometric ladder, C G = H², as factors 1,
1/cos and 1/cos² on the block give."""
import pandas as pd

from .cells import number
from .study import Study

CRITICAL = ["set", "model", "dampers", "structural_damping_pct", "V_cr_m_s"]
LITERAL, OBLIQUE = "H", "H_oblique"


def as_assumed(critical: pd.DataFrame, aerodynamic_set: str) -> pd.DataFrame:
    """Rows of critical.csv of one set without dampers, with the structural damping that the paper assumes, which step 7 takes for the first row;
    rows of model A at the damping that was identified come later."""
    rows = critical[(critical["set"] == aerodynamic_set) & (critical["dampers"] == "off")]
    return rows[rows["structural_damping_pct"] == rows["structural_damping_pct"].iloc[0]] if len(rows) else rows


def critical_speeds(study: Study, aerodynamic_set: str = "standin") -> pd.Series:
    """Speed by model without dampers, with the structural damping that the paper assumes; empty without step 7."""
    if "s7_aerodynamics" not in study.steps() or not (study.results / "s7_aerodynamics/critical.csv").is_file():
        return pd.Series(dtype=float)
    table = as_assumed(study.step_csv("s7_aerodynamics/critical.csv", CRITICAL), aerodynamic_set)
    return table.set_index("model")["V_cr_m_s"].dropna()


def ladder(study: Study) -> dict | None:
    """Printed speeds, ours with either reading, and what each makes of C G = H²; None where step 7 did not compute both readings."""
    table = critical_speeds(study)
    if not {"C", "G", LITERAL, OBLIQUE} <= set(table.index):
        return None
    printed = {r["ns"]: number(r["V_cr_m_per_s"]) for r in study.paper_table(12).to_dict("records")}
    product = float(table["C"] * table["G"])
    rows = [("printed", printed["H"], printed["C"] * printed["G"]), ("as printed in Table 11: derivatives unchanged", float(table[LITERAL]), product),
            ("derivatives on the oblique strip (1/cos)", float(table[OBLIQUE]), product)]
    return {"rows": [{"reading": words, "H": h, "CG": cg, "HH": h * h, "apart": 100.0 * (h * h / cg - 1.0)} for words, h, cg in rows]}


def set_level(study: Study, name: str) -> float | None:
    """What step 7 multiplied an aerodynamic set with to meet row A: all self-excited forces of the stand-in set, the lift slope of the
    quasi-steady one."""
    if "s7_aerodynamics" not in study.steps() or not (study.results / "s7_aerodynamics/sets.csv").is_file():
        return None
    table = study.step_csv("s7_aerodynamics/sets.csv", ["set", "level"]).set_index("set")["level"]
    return float(table[name]) if name in table.index else None
