"""Table 1: damper constants, from the model's springs whose group starts with `damper`."""
import pandas as pd

from ..errors import InputError
from ..study import Study

TITLE = "Damper constants, one device"
TYPES = {"viscous": "Viscous", "series": "Elastic-viscous", "parallel": "Elastic-viscous"}


def build(study: Study) -> pd.DataFrame:
    source = study.results / "s1_model/dampers.csv"
    columns = ["damper", "group", "damping_N_s_m", "stiffness_N_m", "arrangement"]
    dampers = study.read_csv(source, columns)
    rows = []
    for printed in study.paper_table(1).to_dict("records"):
        letter = printed["damper"]
        devices = dampers[dampers["damper"].str.startswith(letter)]
        if devices.empty:
            raise InputError(f"{source}: no damper whose name starts with {letter}, a row of Table 1")
        if len(devices[columns[2:]].drop_duplicates()) > 1:
            raise InputError(f"{source}: dampers {letter} differ among each other; Table 1 gives one set of constants a type")
        device = devices.iloc[0]
        if device["arrangement"] not in TYPES:
            raise InputError(f"{source}: arrangement {device['arrangement']!r}; expected one of {', '.join(TYPES)}")
        elastic = device["arrangement"] != "viscous"
        rows.append({
            "damper": letter,
            "type": TYPES[device["arrangement"]],
            "units_text": printed["units_text"],
            "units_count": len(devices),
            "damping_constant_kNs_per_m": device["damping_N_s_m"] / 1e3,
            "spring_stiffness_kN_per_m": device["stiffness_N_m"] / 1e3 if elastic else None,
            # a manufacturing tolerance enters no computation of ours: carried over
            "spring_tolerance_pct": float(printed["spring_tolerance_pct"]) if printed["spring_tolerance_pct"] else None,
        })
    return pd.DataFrame(rows)
