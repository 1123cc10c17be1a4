"""Table 10: MAC of the updated model's modes and those identified on the virtual bridge. No measured shape of the real one is public."""
import pandas as pd

from ..campaign_mac import mac_table
from ..study import Study

TITLE = "MAC of updated and identified shapes, on the virtual bridge"


def build(study: Study) -> pd.DataFrame:
    study = study.campaign()
    printed = study.paper_table(10)
    columns = [c for c in printed.columns if c.startswith("MAC_")]
    rows = list(printed["numerical_mode"])
    found = mac_table(study, "s6_updating", rows, [c.removeprefix("MAC_") for c in columns])
    found.columns = columns
    return found.rename_axis("numerical_mode").reset_index()
