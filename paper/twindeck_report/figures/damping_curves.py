"""Total damping over the wind speed, from s7_aerodynamics/damping.csv."""
import pandas as pd

from ..study import Study

COLUMNS = ["set", "model", "dampers", "structural_damping_pct", "mode", "V_m_s", "frequency_Hz", "damping_ratio_pct"]


def damping(study: Study, aerodynamic_set: str, dampers: str) -> pd.DataFrame:
    table = study.step_csv("s7_aerodynamics/damping.csv", COLUMNS)
    return table[(table["set"] == aerodynamic_set) & (table["dampers"] == dampers)]


def critical(study: Study, aerodynamic_set: str) -> pd.DataFrame:
    """Rows without dampers, the study's structural damping first."""
    table = study.step_csv("s7_aerodynamics/critical.csv", ["set", "model", "dampers", "structural_damping_pct", "V_cr_m_s", "mode"])
    return table[(table["set"] == aerodynamic_set) & (table["dampers"] == "off")]
