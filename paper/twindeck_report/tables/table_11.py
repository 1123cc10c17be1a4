"""Table 11: the models of skew wind in words, generated from the rules that step 7 computed with (s7_aerodynamics/rules.csv)."""
import pandas as pd

from ..errors import InputError
from ..study import Study

TITLE = "Static and dynamic wind loads of the simulations"
COLUMNS = ["deployment", "deck", "model", "group", "description", "statics", "lookup_cos_power", "block_inverse_cos_power_force",
           "block_inverse_cos_power_cross", "block_inverse_cos_power_moment", "axes"]
PLAIN, SKEW, OBLIQUE = (0, 0, 0), (2, 2, 2), (1, 2, 3)  # powers of 1/cos(theta): forces, across to alpha, moment due to alpha


def build(study: Study) -> pd.DataFrame:
    source = study.results / "s7_aerodynamics/rules.csv"
    rules = study.read_csv(source, COLUMNS)
    rules = rules[(rules["deployment"] == rules["model"]) & rules["deck"].isna()].set_index("model")
    rows = []
    for printed in study.paper_table(11).to_dict("records"):
        model = printed["ns"]
        if model not in rules.index:
            raise InputError(f"{source}: no model {model}, a row of Table 11")
        rows.append({"ns": model, **words(rules.loc[model])})
    return pd.DataFrame(rows)


def words(rule) -> dict:
    """The cells of one row from one rule."""
    powers = tuple(int(rule[f"block_inverse_cos_power_{part}"]) for part in ("force", "cross", "moment"))
    oblique = rule["statics"] == "oblique_strip"
    # K_perp is the cosine rule's name of the number that the oblique strip calls K'
    k = "K" if int(rule["lookup_cos_power"]) == 0 else "K_perp" if powers == PLAIN and not oblique else "K'"
    number = str(rule["description"]).partition("NS #")[2][:1]
    return {"group": rule["group"], "ns_number_in_table12": number, "static_coefficients": static_coefficients(rule["statics"]),
            "static_chord": "B'" if oblique else "B", "static_influence_length": "L'" if oblique else "L",
            "flutter_derivatives": derivatives(k, powers, rule["axes"]), "reduced_velocity": reduced_velocity(k),
            "matrix27_orientation": {"deck": "normal to deck X axis", "wind": "along Y (wind direction)"}[rule["axes"]]}


def static_coefficients(statics: str) -> str:
    if statics == "cosine":
        return "C_k(alpha,theta) = C_k(alpha,0)*cos^2(theta), k=D,L,M"
    return "C_k(alpha,0), k=D,L,M"


def derivatives(k: str, powers: tuple, axes: str) -> str:
    if powers not in (PLAIN, SKEW, OBLIQUE):
        raise InputError(f"rules.csv: powers {powers}: no words for them; expected {PLAIN}, {SKEW} or {OBLIQUE}")
    factor = {PLAIN: "", SKEW: "/cos^2(theta)", OBLIQUE: " on B', L' in place of B, L"}[powers]
    prime = "'" if powers == SKEW and axes == "deck" else ""  # so printed for D alone
    return "; ".join(f"{x}_i*{prime} = {x}_i*(alpha,0,{k}){factor}" for x in "HA")


def reduced_velocity(k: str) -> str:
    return {"K": "V_red = V/(f*B); K = 2*pi/V_red",
            "K_perp": "V_perp = U*cos(theta); V_red_perp = U*cos(theta)/(f*B); K_perp = 2*pi/V_red_perp",
            "K'": "V_red' = V/(f*B') = V*cos(theta)/(f*B); K' = 2*pi/V_red'"}[k]
