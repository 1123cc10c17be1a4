"""Claims of sections 5 and 6: aerodynamics, stability, wind events."""
import math

import numpy as np

from ..ladder import CRITICAL, as_assumed
from ..study import Study
from .identification import AS_SET
from .results import ROUNDING, SYNTHETIC, entry, exact, from_table, quantity, relative, rounding, setting, table



def _critical(study: Study):
    """Stand-in set without dampers, with the assumed structural damping: one row a model of Table 12."""
    rows = table(study, "s7_aerodynamics/critical.csv", CRITICAL)
    if rows is None:
        return None
    rows = as_assumed(rows, "standin")
    return rows[rows["V_cr_m_s"].notna() & rows["model"].isin(list("ACDGHI"))].set_index("model")


def _of_model(model: str, column: str):
    def compute(study: Study):
        rows = _critical(study)
        return None if rows is None or model not in rows.index or column not in rows else float(rows.at[model, column])
    return compute


def _extreme(which: str):
    def compute(study: Study):
        rows = _critical(study)
        return None if rows is None or rows.empty else float(getattr(rows["V_cr_m_s"], which)())
    return compute


def _reduced_speed(study: Study):
    """V / (f B) of the foot deck at the critical speed of model A."""
    rows, nodes = _critical(study), table(study, "s7_aerodynamics/nodes.csv", ["deck", "chord_m"])
    if rows is None or nodes is None or "A" not in rows.index or "f_cr_Hz" not in rows:
        return None
    return float(rows.at["A", "V_cr_m_s"] / rows.at["A", "f_cr_Hz"] / nodes[nodes["deck"] == "foot"]["chord_m"].iloc[0])


def _zero_crossing(study: Study):
    """Where mode 1's total damping passes through zero in the data of Fig. 20, between two speeds by a line."""
    rows = table(study, "s7_aerodynamics/damping.csv", ["set", "dampers", "structural_damping_pct", "mode", "V_m_s", "damping_ratio_pct"])
    if rows is None:
        return None
    rows = rows[(rows["set"] == "standin") & (rows["dampers"] == "off") & (rows["mode"] == 1)]
    rows = rows[rows["structural_damping_pct"] == rows["structural_damping_pct"].min()]
    points = list(zip(rows["V_m_s"], rows["damping_ratio_pct"]))
    for (v0, x0), (v1, x1) in zip(points, points[1:]):
        if x0 > 0 >= x1:
            return float(v0 + (v1 - v0) * x0 / (x0 - x1))
    return None


def _h1_sign(rows):
    """At an angle of attack of zero and the reduced velocity nearest to 8, where the paper's instability lies."""
    own = rows[(rows["set"] == "standin") & (rows["deck"] == "foot") & (rows["angle_of_attack_deg"] == 0)]
    return np.sign(own.iloc[(own["V_over_fB"] - 8.0).abs().argmin()]["h1"]) if len(own) else None


def _lift_slope_sign(rows):
    own = rows[(rows["set"] == "standin") & (rows["deck"] == "foot") & rows["angle_of_attack_deg"].between(-5, 5)]
    return np.sign(np.polyfit(own["angle_of_attack_deg"], own["C_L"], 1)[0]) if len(own) > 2 else None


def _peak(direction: str):
    """Largest acceleration over events and runs of the paper's three deployments [m/s²]."""
    def pick(rows):
        own = rows[(rows["direction"] == direction) & rows["run"].isin(["NS1", "NS2", "NS3"])]["peak_m_s2"]
        return own.max() if len(own) else None
    return from_table("s8_validation/comfort.csv", ["run", "direction", "peak_m_s2"], pick)


def _peak_of_august(rows):
    """Of the foot deck, vertical, over the paper's three deployments [m/s²]."""
    own = rows[(rows["event"] == "August") & (rows["direction"] == "vertical") & (rows["deck"] == "foot") & rows["run"].isin(["NS1", "NS2", "NS3"])]
    return own["peak_m_s2"].max() if len(own) else None


def _largest_august(rows):
    """Largest error of August but for M7 in NS 2, M1 and M8, which the text sets apart."""
    own = rows[(rows["event"] == "August") & (rows["direction"] == "z") & rows["run"].isin(["NS1", "NS2", "NS3"]) & ~rows["channel"].isin(["M1", "M8"])]
    own = own[~((own["channel"] == "M7") & (own["run"] == "NS2"))]["error_pct"].abs()
    return own.max() if own.notna().any() else None


def _printed_profile(study: Study):
    """Friction velocity that the printed design speed needs at the deck's height with the roughness taken: V k / ln(z / z0)."""
    height, speed = setting("s8_validation", "height")(study), setting("s7_aerodynamics", "design_speed")(study)
    path = study.data.parent / "wind/turbulence_sets.csv"
    if height is None or speed is None or not path.is_file():
        return None
    roughness = study.read_csv(path, ["set", "roughness_m"]).set_index("set").at["printed", "roughness_m"]
    return 0.4 * speed / math.log(height / roughness)


NODES = ("s7_aerodynamics/nodes.csv", ["deck", "yaw_deg"])
RATIO = "The range of the ratio over Table 12 and on a prototype's structure."
SIGN = "A sign; the stand-in set was made to have it: shown."
EVENTS = "Wind events of the virtual bridge, not the paper's records: shown beside the paper's."

COMPUTED = {
    "aeroelastic_elements": (from_table(*NODES, len), exact, "One self-excited block with a stiffness and a damping part at each aerodynamic node."),
    "aeroelastic_damping_elements": (from_table(*NODES, len), exact, "One self-excited block with a stiffness and a damping part at each node."),
    "aerodynamic_nodes_per_deck": (setting("s7_aerodynamics", "nodes_per_deck"), exact, AS_SET),
    "design_wind_speed": (setting("s7_aerodynamics", "design_speed"), rounding, AS_SET),
    "structural_damping_ratio": (setting("s7_aerodynamics", "structural_damping", 100.0), rounding, AS_SET),
    "h1_sign": (from_table("s7_aerodynamics/galloping.csv", ["set", "deck", "angle_of_attack_deg", "V_over_fB", "h1"], _h1_sign), None, SIGN),
    "lift_slope_sign": (from_table("s7_aerodynamics/polars.csv", ["set", "deck", "angle_of_attack_deg", "C_L"], _lift_slope_sign), None, SIGN),
    "galloping_speed_fig_20": (_zero_crossing, lambda text: 1.0, "'About 24 m/s': the speed is fitted; the data step by 1 m/s."),
    "least_damping_with_dampers": (quantity("s7_aerodynamics", "least_damping_with_dampers_standin"), None,
                                   "Positions of the dampers are reconstructed and the aerodynamic set is synthetic."),
    "event_2009_12_25_acceleration": (from_table("s8_validation/comfort.csv", ["event", "run", "direction", "deck", "peak_m_s2"], _peak_of_august), None,
                                      "Largest mean peak of the foot deck in our least event, 16.46 m/s at the decks: less wind than every reading of 28.0 m/s "
                                      "at the mast's top. Aerodynamic data are synthetic: shown beside the paper's."),
    "comfort_limit_vertical": (setting("s8_validation", "comfort_vertical"), rounding, AS_SET),
    "comfort_limit_lateral": (setting("s8_validation", "comfort_lateral"), rounding, AS_SET),
    "acceleration_below_vertical_limit": (_peak("vertical"), None, EVENTS + " Largest peak of both events; the text says that it stays below the limit."),
    "acceleration_below_lateral_limit": (_peak("lateral"), None, EVENTS + " Largest peak of both events; the text says that it stays below the limit."),
    "friction_velocity": (_printed_profile, relative(0.01), "The roughness length was set so that this and the design speed go together "
                          "(1 % for its two digits)."),
    "air_density": (setting("s7_aerodynamics", "density"), rounding, AS_SET),
    "eq_7_displacement": (quantity("s7_aerodynamics", "static_displacement_G_H", 1e3), None, SYNTHETIC),
    "eq_7_rotation": (quantity("s7_aerodynamics", "static_rotation_G_H"), None, SYNTHETIC),
    "f_cr_over_f1_orthogonal_wind": (_of_model("A", "f_cr_over_f1"), lambda text: 0.007, RATIO),
    "f_cr_over_f1_cosine_rule": (_of_model("C", "f_cr_over_f1"), lambda text: 0.007, RATIO),
    "f_cr_over_f1_cosine_and_skew": (_of_model("D", "f_cr_over_f1"), lambda text: 0.007, RATIO),
    "f_cr_over_f1_wind_Y": (_of_model("G", "f_cr_over_f1"), lambda text: 0.007, RATIO),
    "f_cr_over_f1_wind_Y_2": (_of_model("H", "f_cr_over_f1"), lambda text: 0.007, RATIO),
    "f_cr_over_f1_wind_Y_3": (_of_model("I", "f_cr_over_f1"), lambda text: 0.007, RATIO),
    "critical_speed_least_model_A": (_extreme("min"), relative(0.01), "The least of the six models; its level was fitted to this speed: 1 %."),
    "critical_speed_largest_model_C": (_extreme("max"), relative(0.05), "The largest of the six models; as in Table 12."),
    "critical_speed_model_G": (_of_model("G", "V_cr_m_s"), relative(0.05), "As in Table 12."),
    "yaw_near_the_ends": (from_table(*NODES, lambda rows: rows["yaw_deg"].abs().max()), lambda text: 2.0,
                          "At the outermost aerodynamic node; the ends of its strip lie 1.8 degrees further out (Table 14)."),
    "reduced_velocity_low": (_reduced_speed, None, "V/(fB) of the foot deck at the critical speed of model A, with an assumed chord: shown beside the range."),
    "reduced_velocity_high": (_reduced_speed, None, "V/(fB) of the foot deck at the critical speed of model A, with an assumed chord: shown beside the range."),
    "event_august_speed": (entry("s8_validation", "event", "August", "speed"), rounding, ROUNDING),
    "event_april_speed": (entry("s8_validation", "event", "April", "speed"), rounding, ROUNDING),
    "event_august_duration": (setting("s8_validation", "duration"), relative(0.03), "Ten minutes stand for both printed intervals."),
    "event_april_duration": (setting("s8_validation", "duration"), relative(0.03), "Ten minutes stand for both printed intervals."),
    "august_largest_error": (lambda study: from_table("s8_validation/rms.csv", ["event", "run", "channel", "direction", "error_pct"],
                                                      _largest_august)(study.campaign()), None, EVENTS),
}
