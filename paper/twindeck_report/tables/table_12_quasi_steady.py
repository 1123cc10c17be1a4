"""Table 12 with the aerodynamic set `quasi_steady`, of which only the lift slope was fitted, to row A."""
import pandas as pd

from ..ladder import set_level
from ..study import Study
from .table_12 import critical

TITLE = "Critical velocity and frequency with quasi-steady derivatives (synthetic; only the lift slope fitted, to row A)"


def note(study: Study) -> str:
    level = set_level(study, "quasi_steady")
    return "" if level is None else f"; lift slope multiplied by {level:.4f}"


def build(study: Study) -> pd.DataFrame:
    return critical(study, "quasi_steady")
