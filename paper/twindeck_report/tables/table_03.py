"""Table 3: scores R_k of the six setups on the preliminary model."""
import pandas as pd

from ..errors import InputError
from ..study import Study

TITLE = "Scores R_k of the setups (Eq. 1): laid out by us, the paper's places are not public"


def build(study: Study) -> pd.DataFrame:
    source = "s2_sensors/setups.csv"
    scores = study.step_csv(source, ["setup", "R_k"]).set_index("setup")["R_k"]
    rows = []
    for printed in study.paper_table(3).to_dict("records"):
        name = printed["abbreviation"]
        if name not in scores.index:
            raise InputError(f"{study.path_of(source)}: no setup {name}, a row of Table 3")
        rows.append({"setup": printed["setup"], "abbreviation": name, "R_k": float(scores[name])})
    return pd.DataFrame(rows)
