"""Table 4: identified modes as published. The frequencies without dampers are those that the study's features hold (what the
updating is fitted to); the other columns are carried over from the paper until a campaign has been identified."""
import pandas as pd

from ..errors import InputError
from ..study import Study

TITLE = "Identified frequencies and damping ratios, as published"


def build(study: Study) -> pd.DataFrame:
    source = study.data / "features/rows.csv"
    rows = study.read_csv(source, ["type", "mode", "condition", "value"])
    frequencies = rows[rows["type"] == "frequency_Hz"].drop_duplicates("mode").set_index("mode")["value"]
    frequencies.index = frequencies.index.astype(int)
    table = study.paper_table(4)
    lacking = [m for m in table["mode"] if int(m) not in frequencies.index]
    if lacking:
        raise InputError(f"{source}: no frequency_Hz of mode {lacking[0]}, a row of Table 4")
    ours = {"mode": [int(m) for m in table["mode"]],
            "f_X_without_dampers_Hz": [float(frequencies[int(m)]) for m in table["mode"]]}
    for column in table.columns[2:]:
        ours[column] = table[column].astype(float)
    return pd.DataFrame(ours)[list(table.columns)]
