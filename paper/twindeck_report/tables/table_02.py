"""Table 2: frequencies of the preliminary model."""
import pandas as pd

from ..errors import InputError
from ..study import Study

TITLE = "Frequencies of the preliminary model"


def build(study: Study) -> pd.DataFrame:
    source = study.results / "s1_model/modes.csv"
    ours = study.read_csv(source, ["mode", "frequency_Hz"]).set_index("mode")["frequency_Hz"]
    modes = [int(m) for m in study.paper_table(2)["mode"]]
    lacking = [m for m in modes if m not in ours.index]
    if lacking:
        raise InputError(f"{source}: no mode {lacking[0]}, a row of Table 2; compute at least {max(modes)} modes")
    return pd.DataFrame({"mode": modes, "f_N_Hz": [float(ours[m]) for m in modes]})
