"""Claims of section 2: the structure, its dampers and its model."""
import numpy as np

from ..deck_section import axis_of, chord_forces, mean_forces
from ..study import Study
from .results import COUNT, ROUNDING, exact, from_table, quantity, relative, rounding, table

MEMBERS = ("s1_model/member_forces.csv", ["group", "x_m", "y_m", "z_m", "length_m"])
APPROXIMATE = "'Approximately' in the text; ours is measured on the model's top chords, between which the axis runs."


def _top_chord(deck: str, measure):
    def pick(rows):
        top = rows[rows["group"] == f"{deck}_top_chord"]
        return measure(top) if len(top) else None
    return from_table(*MEMBERS, pick)


def _radius(deck: str):
    def pick(rows):
        return axis_of(rows, deck).radius_m if (rows["group"] == f"{deck}_bottom_chord").any() else None
    return from_table(*MEMBERS, pick)


def _length(deck: str):
    return _top_chord(deck, lambda top: top["length_m"].sum() / 2)


def _inclination(study: Study):
    """Of the mast's line from foot to head against the vertical [degrees]."""
    rows = table(study, *MEMBERS)
    mast = None if rows is None else rows[rows["group"] == "mast_steel"].sort_values("z_m")
    if mast is None or len(mast) < 2:
        return None
    way = mast.iloc[-1][["x_m", "y_m", "z_m"]].to_numpy(float) - mast.iloc[0][["x_m", "y_m", "z_m"]].to_numpy(float)
    return float(np.degrees(np.arctan2(np.hypot(way[0], way[1]), way[2])))


def _sign(deck: str, level: str):
    """+1 tension, -1 compression: mean axial force over the middle half of the deck, top chords together."""
    def compute(study: Study):
        rows = table(study, *MEMBERS)
        if rows is None or not (rows["group"] == f"{deck}_{level}_chord").any():
            return None
        forces = mean_forces(chord_forces(study)).loc[deck]
        return float(np.sign(forces["bottom"] if level == "bottom" else forces["top inner"] + forces["top outer"]))
    return compute


def _sides(group: str):
    """How many ends of the bridge (signs of x) a group of members stands at."""
    return from_table(*MEMBERS, lambda rows: np.sign(rows[rows["group"] == group]["x_m"]).nunique() or None)


ELEMENTS = ("s1_model/model/elements.csv", ["type", "name", "group"])


def _groups(prefix: str):
    return from_table(*ELEMENTS, lambda rows: rows[rows["group"].str.startswith(prefix)]["group"].nunique() or None)


def _end_blocks(study: Study):
    """Ends of the bridge (signs of x) with solid elements, in the refined model."""
    elements = table(study, "s4_refinement/model/elements.csv", ["type", "node1"])
    nodes = table(study, "s4_refinement/model/nodes.csv", ["node", "x_m"])
    if elements is None or nodes is None or not (elements["type"] == "solid").any():
        return None
    at = nodes.set_index("node").loc[elements[elements["type"] == "solid"]["node1"], "x_m"]
    return float(np.sign(at).nunique())


def _diameter(size: int):
    return from_table("s1_model/stays.csv", ["group"], lambda rows: size if (rows["group"] == f"stay_{size}").any() else None)


def _tenth(rows):
    tenth = rows[rows["mode"] == 10]["frequency_Hz"]
    return tenth.iloc[0] if len(tenth) else None


CURVATURE = "A sign: which chords pull and which push under dead load (Fig. 2)."

TOP = "Top chords change sign along the deck and differ between its edges (Fig. 2): that of the mean over the middle half is shown."

COMPUTED = {
    "foot_deck_radius": (_radius("foot"), relative(0.02), APPROXIMATE),
    "cycle_deck_radius": (_radius("cycle"), relative(0.02), APPROXIMATE),
    "foot_deck_length": (_length("foot"), relative(0.02), APPROXIMATE),
    "cycle_deck_length": (_length("cycle"), relative(0.02), APPROXIMATE),
    "mast_inclination": (_inclination, lambda text: 1.0, "'About' in the text: a degree."),
    "ground_cables": (from_table("s1_model/stays.csv", ["stay"], lambda rows: rows["stay"].isin(["BN", "BS"]).sum()), exact, COUNT),
    "access_ramps": (_sides("ramp"), exact, COUNT),
    "foot_bottom_chord_sign": (_sign("foot", "bottom"), exact, CURVATURE),
    "cycle_bottom_chord_sign": (_sign("cycle", "bottom"), exact, CURVATURE),
    "foot_top_chord_sign": (_sign("foot", "top"), None, TOP),
    "cycle_top_chord_sign": (_sign("cycle", "top"), None, TOP),
    "damper_devices": (from_table("s1_model/dampers.csv", ["damper"], len), exact, COUNT),
    "damper_types": (from_table("s1_model/dampers.csv", ["damper"], lambda rows: rows["damper"].str[:1].nunique()), exact, COUNT),
    "monitoring_accelerometers": (from_table("s2_sensors/layout.csv", ["setup", "channel"], lambda rows: (rows["setup"] == "M").sum() or None), exact, COUNT),
    "degrees_of_freedom": (quantity("s1_model", "degrees_of_freedom"), None, "Another mesh: shown beside the paper's."),
    "elements_per_cable": (from_table(*ELEMENTS, lambda rows: rows[rows["type"] == "stay"]["name"].value_counts().max()), exact, COUNT),
    "preliminary_f10": (from_table("s1_model/modes.csv", ["mode", "frequency_Hz"], _tenth), relative(0.05),
                        "As in Table 2: section sizes of ours were fitted to the preliminary frequencies."),
    "concrete_thicknesses_foot": (_groups("slab_foot_"), exact, COUNT),
    "end_blocks": (_end_blocks, exact, COUNT),
    "stay_diameter_small": (_diameter(44), rounding, ROUNDING),
    "stay_diameter_middle": (_diameter(60), rounding, ROUNDING),
    "stay_diameter_large": (_diameter(75), rounding, ROUNDING),
}
