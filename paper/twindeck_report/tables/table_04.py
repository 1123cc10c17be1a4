"""Table 4: modes identified from the virtual campaign. Without dampers its truth was set to the paper's measurement, so that the
paper's numbers must come back; with dampers the virtual bridge has a truth of its own. Rows that were not found are empty."""
import pandas as pd

from ..identified import WITH, WITHOUT, modes_of, with_dampers, without_dampers
from ..study import Study

TITLE = "Identified frequencies and damping ratios, on the virtual bridge"


def build(study: Study) -> pd.DataFrame:
    table = study.paper_table(4)
    ours = {"mode": [int(m) for m in table["mode"]]}
    for words, condition, rows in (("without", WITHOUT, without_dampers(study)), ("with", WITH, with_dampers(study))):
        modes = modes_of(study, condition)
        for column, source in ((f"f_X_{words}_dampers_Hz", "frequency_Hz"), (f"zeta_{words}_dampers_pct", "damping_ratio_pct")):
            ours[column] = [float(modes.at[rows[m], source]) if m in rows else float("nan") for m in ours["mode"]]
    return pd.DataFrame(ours)[list(table.columns)]
