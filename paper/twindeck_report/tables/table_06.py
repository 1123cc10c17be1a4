"""Table 6: preliminary model against the measurement, paired by order."""
import pandas as pd

from ..study import Study
from .comparison import compared

TITLE = "Measured and preliminary frequencies"


def build(study: Study) -> pd.DataFrame:
    modes = [int(m) for m in study.paper_table(6)["mode"]]
    rows = compared(study, "s4_refinement/comparison.csv", "initial", [f"{m}X" for m in modes])
    return pd.DataFrame({"mode": modes, "f_X_Hz": rows["measured_Hz"], "f_N_Hz": rows["computed_Hz"],
                         "error_pct": rows["error_pct"]})
