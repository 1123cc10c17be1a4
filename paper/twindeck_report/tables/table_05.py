"""Table 5: stays, identified from virtual records of single accelerometers; the damping ratio is the mean over the harmonics."""
import pandas as pd

from ..errors import InputError
from ..study import Study

TITLE = "Frequencies and damping ratios of stays, on the virtual bridge"


def build(study: Study) -> pd.DataFrame:
    source, fits = "s3_identification/stays.csv", "s3_identification/stay_tensions.csv"
    found = study.step_csv(source, ["stay", "condition", "harmonic", "frequency_Hz", "damping_ratio_pct"])
    lengths = study.step_csv(fits, ["stay", "condition", "length_m"]).set_index(["condition", "stay"])["length_m"]
    rows = []
    for printed in study.paper_table(5).to_dict("records"):
        case, cable = printed["case"], printed["cable"]
        own = found[(found["condition"] == case) & (found["stay"] == cable)].set_index("harmonic")
        if own.empty or (case, cable) not in lengths.index:
            raise InputError(f"{study.path_of(source)}: no record of {cable}, condition {case}, a row of Table 5")
        row = {"case": case, "cable": cable, "L_m": float(lengths[(case, cable)])}
        for n in range(1, 6):
            row[f"f{n}_Hz"] = float(own.at[n, "frequency_Hz"]) if n in own.index else float("nan")
        row["damping_ratio_pct"] = float(own["damping_ratio_pct"].mean())
        rows.append(row)
    return pd.DataFrame(rows)
