"""Table 9: updated model against the measurement, in the paper's pairs."""
import pandas as pd

from ..study import Study
from .comparison import compared

TITLE = "Measured and updated frequencies"


def build(study: Study) -> pd.DataFrame:
    rows = compared(study, "s6_updating/comparison.csv", "after", study.paper_table(9)["experimental_mode"])
    return pd.DataFrame({"experimental_mode": rows["experimental_mode"], "numerical_mode": rows["numerical_mode"],
                         "f_X_Hz": rows["measured_Hz"], "f_N_Hz": rows["computed_Hz"], "error_pct": rows["error_pct"]})
