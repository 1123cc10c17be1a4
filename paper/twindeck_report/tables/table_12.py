"""Table 12: critical wind speed and frequency of each model, with the aerodynamic set `standin`."""
import pandas as pd

from ..errors import InputError
from ..ladder import as_assumed, set_level
from ..study import Study

TITLE = "Critical velocity and frequency of the simulations (synthetic aerodynamic set standin, fitted to this table)"
NAMES = ["set", "model", "group", "description", "dampers", "structural_damping_pct", "V_cr_m_s", "f_cr_Hz"]


def build(study: Study) -> pd.DataFrame:
    return critical(study, "standin")


def note(study: Study) -> str:
    level = set_level(study, "standin")
    return "" if level is None else f"; all its self-excited forces multiplied by {level:.4f}, so that row A is met"


def critical(study: Study, aerodynamic_set: str) -> pd.DataFrame:
    """Rows of the paper's table for one aerodynamic set: without dampers, with the structural damping that the paper assumes."""
    source = study.results / "s7_aerodynamics/critical.csv"
    table = as_assumed(study.read_csv(source, NAMES), aerodynamic_set).set_index("model")
    rows = []
    for printed in study.paper_table(12).to_dict("records"):
        model = printed["ns"]
        if model not in table.index:
            raise InputError(f"{source}: set {aerodynamic_set}: no model {model}, a row of Table 12")
        row = table.loc[model]
        text = {name: "" if pd.isna(row[name]) else row[name] for name in ("group", "description")}
        rows.append({"ns": model, **text, "V_cr_m_per_s": row["V_cr_m_s"], "f_cr_Hz": row["f_cr_Hz"]})
    return pd.DataFrame(rows)
