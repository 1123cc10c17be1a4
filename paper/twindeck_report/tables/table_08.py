"""Table 8: what the updating did to the parameters, in the paper's units."""
import pandas as pd

from ..errors import InputError
from ..study import Study

TITLE = "Changes of the updated parameters"
PAPER_UNIT = {("Pa", "MPa"): 1e-6}  # (ours, the paper's) -> factor; equal units need none


def build(study: Study) -> pd.DataFrame:
    source = study.results / "s6_updating/parameters.csv"
    ours = study.read_csv(source, ["parameter", "unit", "initial_value", "final_value", "change_pct"]).set_index("parameter")
    rows = []
    for printed in study.paper_table(8).to_dict("records"):
        name, unit = printed["parameter"], printed["unit"]
        if name not in ours.index:
            raise InputError(f"{source}: no parameter {name}, a row of Table 8")
        row = ours.loc[name]
        factor = 1.0 if row["unit"] == unit else PAPER_UNIT.get((row["unit"], unit))
        if factor is None:
            raise InputError(f"{source}: {name}: unit {row['unit']!r} cannot be shown in the paper's {unit!r}")
        rows.append({"parameter": name, "unit": unit, "initial_value": row["initial_value"] * factor,
                     "final_value": row["final_value"] * factor, "change_pct": row["change_pct"]})
    return pd.DataFrame(rows)
