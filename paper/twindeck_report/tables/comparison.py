"""Rows of a step's comparison.csv in the order of the paper's Table 6, 7 or 9."""
import pandas as pd

from ..errors import InputError
from ..study import Study

COLUMNS = ["stage", "experimental_mode", "numerical_mode", "measured_Hz", "computed_Hz", "error_pct", "pairing"]


def compared(study: Study, name: str, stage: str, wanted) -> pd.DataFrame:
    """One row for each experimental mode of `wanted` (7X, ...). Published pairs come before pairs by MAC and by order: no
    measured shape of this bridge is public, so a MAC of ours could not decide between them."""
    source = study.results / name
    table = study.read_csv(source, COLUMNS)
    table = table[table["stage"] == stage].copy()
    rank = {"published": 0, "mac": 1, "order": 2}
    table["rank"] = table["pairing"].map(rank).fillna(3)
    table = table.sort_values("rank", kind="stable").drop_duplicates("experimental_mode").set_index("experimental_mode")
    lacking = [mode for mode in wanted if mode not in table.index]
    if lacking:
        raise InputError(f"{source}: stage {stage}: no row for {lacking[0]}, which the paper's table has")
    return table.loc[list(wanted)].reset_index()
