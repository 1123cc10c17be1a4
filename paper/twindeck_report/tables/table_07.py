"""Table 7: refined model against the measurement, in the paper's pairs."""
import pandas as pd

from ..study import Study
from .comparison import compared

TITLE = "Measured and refined frequencies"


def build(study: Study) -> pd.DataFrame:
    rows = compared(study, "s4_refinement/comparison.csv", "refined", study.paper_table(7)["experimental_mode"])
    return pd.DataFrame({"experimental_mode": rows["experimental_mode"], "numerical_mode": rows["numerical_mode"],
                         "f_X_Hz": rows["measured_Hz"], "f_N_Hz": rows["computed_Hz"], "error_pct": rows["error_pct"]})
