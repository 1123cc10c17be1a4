"""Total damping over the wind speed, from s7_aerodynamics/damping.csv."""
import pandas as pd

from ..ladder import CRITICAL, as_assumed
from ..study import Study
from .stabilisation import apart

COLUMNS = ["set", "model", "dampers", "structural_damping_pct", "mode", "V_m_s", "frequency_Hz", "damping_ratio_pct"]


def name_ends(axes, ends: dict, colours: dict, least: float) -> None:
    """Names of curves beside their last points ({name: (x, y)}), moved apart where they would meet."""
    order = sorted(ends, key=lambda name: ends[name][1])
    places = apart([ends[name][1] for name in order], least, axes.get_ylim())
    for name, y in zip(order, places):
        axes.text(ends[name][0] + 0.6, y, name, fontsize=7.5, va="center", color=colours[name])


def damping(study: Study, aerodynamic_set: str, dampers: str) -> pd.DataFrame:
    table = study.step_csv("s7_aerodynamics/damping.csv", COLUMNS)
    return table[(table["set"] == aerodynamic_set) & (table["dampers"] == dampers)]


def critical(study: Study, aerodynamic_set: str) -> pd.DataFrame:
    """Rows without dampers, with the structural damping that the paper assumes."""
    return as_assumed(study.step_csv("s7_aerodynamics/critical.csv", [*CRITICAL, "mode"]), aerodynamic_set)
