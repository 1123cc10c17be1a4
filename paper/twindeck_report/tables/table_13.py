"""Table 13: errors of simulated RMS accelerations against two wind events, here those of the virtual bridge."""
import pandas as pd

from ..claims.results import setting
from ..errors import InputError
from ..study import Study

TITLE = "Percentage errors on the RMS of acceleration (measured side: wind events of the virtual bridge, so no claim of agreement"
COLUMNS = ["event", "run", "channel", "direction", "error_pct", "error_low_pct", "error_high_pct"]
RUNS = {"NS1": "NS1_normal_wind", "NS2": "NS2_cosine_and_skew", "NS3": "NS3_windY_NS2"}  # ours -> the paper's columns
EVENTS = ("August", "April")


def note(study: Study) -> str:
    seeds = setting("s8_validation", "seeds")(study.campaign())
    return f"; mean of {seeds:.0f} samples of turbulence)" if seeds else ")"


def build(study: Study) -> pd.DataFrame:
    found = errors(study)
    rows = []
    for accelerometer in study.paper_table(13)["accelerometer"]:
        row = {"accelerometer": accelerometer}
        for run, name in RUNS.items():
            for event in EVENTS:
                if (event, run, accelerometer) not in found.index:
                    raise InputError(f"{study.campaign().results / 's8_validation/rms.csv'}: no row {event}, {run}, {accelerometer}, a cell of Table 13")
                row[f"{name}_{event}_err_pct"] = found.loc[(event, run, accelerometer), "error_pct"]
        rows.append(row)
    return pd.DataFrame(rows)


def errors(study: Study) -> pd.DataFrame:
    """Vertical errors by event, run and channel; empty where the step had no measured side."""
    table = study.campaign().step_csv("s8_validation/rms.csv", COLUMNS)
    return table[table["direction"] == "z"].set_index(["event", "run", "channel"]).sort_index()
