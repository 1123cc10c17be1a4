"""What the model says of a deck's cross-section: chords about the middle of the deck, and where its stays take hold."""
from dataclasses import dataclass

import numpy as np
import pandas as pd

from .errors import InputError
from .study import Study

DECKS = ("foot", "cycle")
STAY_LETTER = {"foot": "E", "cycle": "W"}  # NE1 … SE8 carry the foot deck, NW1 … SW7 the cycle deck
CHORDS = ("bottom", "top inner", "top outer")


@dataclass(frozen=True)
class Circle:
    x_m: float
    y_m: float
    radius_m: float

    def radius_of(self, points) -> np.ndarray:
        return np.hypot(points["x_m"] - self.x_m, points["y_m"] - self.y_m)

    def station_of(self, points) -> np.ndarray:
        """Arc length from the middle of the deck along this circle, towards +X."""
        return self.radius_m * np.arctan2(points["x_m"] - self.x_m, points["y_m"] - self.y_m)


def circle_through(points) -> Circle:
    """Least squares of x² + y² = 2 a x + 2 b y + c, which is linear in the centre (a, b)."""
    x, y = points["x_m"].to_numpy(float), points["y_m"].to_numpy(float)
    a, b, c = np.linalg.lstsq(np.column_stack([2 * x, 2 * y, np.ones(len(x))]), x * x + y * y, rcond=None)[0]
    return Circle(a, b, float(np.sqrt(c + a * a + b * b)))


def deck_axis(bottom, top) -> Circle:
    """The circle midway between a deck's two top chords. Its centre is the bottom chord's: a fit through two circles at once would
    not find their common centre."""
    centre = circle_through(bottom)
    radii = centre.radius_of(top)
    return Circle(centre.x_m, centre.y_m, 0.5 * float(radii.min() + radii.max()))


def axis_of(members: pd.DataFrame, deck: str) -> Circle:
    return deck_axis(*(members[members["group"] == f"{deck}_{level}_chord"] for level in ("bottom", "top")))


def chord_forces(study: Study, folder: str = "s1_model") -> pd.DataFrame:
    """deck, chord, station_m, radius_m, z_m, axial_force_N of every piece of a chord under dead load and stay pulls; tension positive."""
    name = f"{folder}/member_forces.csv"
    members = study.step_csv(name, ["element", "group", "x_m", "y_m", "z_m", "axial_force_N"])
    parts = []
    for deck in DECKS:
        bottom, top = (members[members["group"] == f"{deck}_{level}_chord"] for level in ("bottom", "top"))
        if bottom.empty or top.empty:
            raise InputError(f"{study.results / name}: no members of the groups {deck}_bottom_chord and {deck}_top_chord")
        axis = deck_axis(bottom, top)
        for chord, rows in (("bottom", bottom), ("top inner", top[axis.radius_of(top) < axis.radius_m]),
                            ("top outer", top[axis.radius_of(top) >= axis.radius_m])):
            parts.append(pd.DataFrame({"deck": deck, "chord": chord, "station_m": axis.station_of(rows), "radius_m": axis.radius_of(rows),
                                       "z_m": rows["z_m"], "axial_force_N": rows["axial_force_N"]}).sort_values("station_m"))
    return pd.concat(parts, ignore_index=True)


def mean_forces(forces: pd.DataFrame) -> pd.DataFrame:
    """Mean axial force by deck (rows) and chord (columns) over the middle half of each deck, away from its ends [N]."""
    reach = forces.groupby("deck")["station_m"].transform(lambda s: s.abs().max())
    middle = forces[forces["station_m"].abs() <= 0.5 * reach]
    return middle.pivot_table(index="deck", columns="chord", values="axial_force_N")


def sections(study: Study, folder: str = "s1_model") -> dict:
    """{deck: {part: (across, up)}} about the mid-length of each deck: the three chords and the stay's anchorage, `across` from the
    axis of the top chords (outwards positive) and `up` from them [m]."""
    forces = chord_forces(study, folder)
    anchors = stay_anchors(study, f"{folder}/model")
    members = study.step_csv(f"{folder}/member_forces.csv")
    found = {}
    for deck in DECKS:
        rows = forces[(forces["deck"] == deck) & (forces["station_m"].abs() < 12.0)]
        axis = axis_of(members, deck)
        top = rows[rows["chord"] != "bottom"]["z_m"].mean()
        places = {chord: (part["radius_m"].mean() - axis.radius_m, part["z_m"].mean() - top) for chord, part in rows.groupby("chord")}
        own = anchors[anchors["stay"].str[1:2] == STAY_LETTER[deck]]
        places["stay"] = (float(np.mean(axis.radius_of(own)) - axis.radius_m), 0.0)
        found[deck] = places
    return found


def stay_anchors(study: Study, folder: str) -> pd.DataFrame:
    """stay, x_m, y_m, z_m of each stay's lower end."""
    nodes = study.step_csv(f"{folder}/nodes.csv", ["node", "x_m", "y_m", "z_m"]).set_index("node")
    elements = study.step_csv(f"{folder}/elements.csv", ["type", "name", "node1", "node2"])
    stays = elements[elements["type"] == "stay"]
    ends = nodes.loc[stays["node1"].astype(int)].reset_index(drop=True)
    others = nodes.loc[stays["node2"].astype(int)].reset_index(drop=True)
    lower = ends.where(ends["z_m"] <= others["z_m"], others)
    lower.insert(0, "stay", stays["name"].to_numpy())
    return lower
