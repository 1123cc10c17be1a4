"""Table 14: the hybrid deployment of coefficients and derivatives by yaw, generated from the rules that steps 7 and 8 computed with."""
import pandas as pd

from ..cells import number
from ..errors import InputError
from ..study import Study

TITLE = "Expressions for steady-state coefficients and flutter derivatives of the hybrid deployment"
COLUMNS = ["deck", "theta_from_deg", "theta_to_deg", "zone", "model", "statics", "lookup_cos_power", "block_inverse_cos_power"]


def build(study: Study) -> pd.DataFrame:
    source = study.results / "s8_validation/hybrid.csv"
    zones = study.read_csv(source, COLUMNS)
    rows = []
    for printed in study.paper_table(14).to_dict("records"):
        rows.append(_row(_zone(zones, printed, source), printed))
    return pd.DataFrame(rows)


def _zone(zones, printed, source):
    """Ours that holds the middle of the paper's interval."""
    middle = 0.5 * (number(printed["theta_from_deg"]) + number(printed["theta_to_deg"]))
    inside = zones[(zones["deck"] == printed["deck"]) & (zones["theta_from_deg"] <= middle) & (middle <= zones["theta_to_deg"])]
    if len(inside) != 1:
        raise InputError(f"{source}: {len(inside)} zones of the {printed['deck']} deck hold {middle:.1f} degrees, expected one (Table 14)")
    return inside.iloc[0]


def _row(zone, printed) -> dict:
    """The interval is the row's name, as printed; its ends are ours: the yaw at our end stays, and the switching angles."""
    k = "K'" if int(zone["lookup_cos_power"]) else "K"
    factor = "/cos^2(theta)" if int(zone["block_inverse_cos_power"]) == 2 else ""
    static = "C_D,L,M(alpha,0)" + ("*cos^2(theta)" if zone["statics"] == "cosine" else "")
    return {"deck": zone["deck"], "theta_from_deg": zone["theta_from_deg"], "theta_to_deg": zone["theta_to_deg"],
            "interval": printed["interval"], "static_polar": static,
            "flutter_derivatives": "; ".join(f"{x}_i* = {x}_i*(alpha,0,{k}){factor}" for x in "AH")}
