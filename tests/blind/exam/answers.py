"""What an answer of step 9 says about the faces of the frame, and how it is rated. The truth is frame.PATTERNS, what counts of it losses.csv.

A place is a set of faces (storey, face). An effect of the answer offers the places of its set, the leader's first. A place is right where each of its
faces lost braces, or is the mirror image of one that did and the sensors do not tell the two.

rating     a damaged frame                                                          a sound one
complete   each visible face is in a right place of an effect whose set holds at
           most four places; every effect has a right place
half       as complete, but a visible face is missing or a set holds more
wrong      an effect without a right place                                          a name or a set
unknown    the verdict                                                              the verdict
none       the verdict: missed                                                      the verdict: right
"""
import csv
import re

MOST_PLACES = 4  # a set that an inspector can go through
ADDED = ("tie", "prop")                   # springs between floors: one that stands before and not after is a loss
LOSSES = ("stiffness", "lost", "joint", *ADDED)  # causes that can say that a face lost stiffness
OPPOSITE = {"x0": "x2", "x2": "x0", "y0": "y2", "y2": "y0"}


def read_losses(path):
    """(case, pattern) -> rows of losses.csv"""
    out = {}
    with open(path, newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            out.setdefault((int(row["case"]), int(row["pattern"])), []).append(row)
    return out


class Faces:
    """Faces that the places of a model folder stand for."""

    def __init__(self, model):
        self.group_of, self.nodes = {}, {}
        with open(model / "elements.csv", newline="", encoding="utf-8") as stream:
            for row in csv.DictReader(stream):
                self.group_of[row["element"]] = row["group"]
        with open(model / "nodes.csv", newline="", encoding="utf-8") as stream:
            for row in csv.DictReader(stream):
                self.nodes[row["node"]] = tuple(float(row[k]) for k in ("x_m", "y_m", "z_m"))

    def of_group(self, name):
        found = re.fullmatch(r"braces_(\d)_([xy][02])", name)
        return {(int(found[1]), found[2])} if found else None

    def of_tie(self, names):
        """Two nodes of neighbouring floors on one face; one node: to the ground, from floor 1."""
        at = [self.nodes[name] for name in names if name in self.nodes]
        if len(at) != len(names):
            return None
        floors = sorted(round(z / 0.9) for *_, z in at)
        if len(floors) == 1:
            floors = [0] + floors
        if floors[1] - floors[0] != 1:
            return None
        for axis, name in ((0, "x"), (1, "y")):
            for value, side in ((0.0, "0"), (2.5, "2")):
                if all(abs(point[axis] - value) < 1e-6 for point in at):
                    return {(floors[1], name + side)}
        return None

    def of(self, location):
        """None: the place is none of the faces."""
        kind, _, names = location.partition(":")
        names = names.split(",")
        if kind in ("node", "nodes"):
            return self.of_tie(names)
        parts = [self.of_group(self.group_of.get(name, "") if kind == "element" else name) for name in names]
        return set().union(*parts) if parts and all(parts) else None


def is_loss(effect):
    """Whether the leader says that stiffness was lost from before to after."""
    if effect["cause"] not in LOSSES:
        return False
    if effect["cause"] in ADDED:
        return effect.get("state", "") == "before"
    factors = [p["value"] for p in effect["parameters"] if p["name"] in ("factor", "stiffness_factor")]
    return not factors or (factors[0] < 1.0) == (effect.get("state", "") != "before")


def places(effect, faces):
    """Places of an effect's set, the leader's first: sets of faces, None for any other place. "Something else" counts as a place."""
    entries = [f"{effect['cause']}@{effect['location']}"] + [entry for entry in effect.get("cluster", [])]
    out = {}
    for entry in entries:
        cause, _, location = entry.partition("@")
        out.setdefault(location, faces.of(location) if cause in LOSSES else None)
    return list(out.values())


def rate(answer, rows, faces):
    """(rating, detail) of an answer. @param rows  those of losses.csv for this pair; empty for a sound one"""
    verdict = answer["verdict"]
    if verdict in ("none", "unknown"):
        return verdict, ""
    lost = {(int(row["storey"]), row["face"]) for row in rows}
    allowed = lost | {(int(row["storey"]), OPPOSITE[row["face"]]) for row in rows if row["face_told"] == "0"}
    visible = {(int(row["storey"]), row["face"]) for row in rows if row["visible"] == "1"}
    told = {(int(row["storey"]), row["face"]) for row in rows if row["face_told"] == "1"}
    covered, wide = set(), False
    for effect in answer["effects"]:
        offered = places(effect, faces)
        right = [place for place in offered if place and place <= allowed]
        if not right or not is_loss(effect):
            return "wrong", f"{effect['cause']}@{effect['location']}"
        if len(offered) > MOST_PLACES:
            wide = True
        for storey, face in set().union(*right):
            covered.add((storey, face))
            if (storey, face) not in told and (storey, OPPOSITE[face]) in lost:
                covered.add((storey, OPPOSITE[face]))
    missing = visible - covered
    if missing or wide:
        return "half", "set of more than four places" if not missing else "missing " + " ".join(f"{s}_{f}" for s, f in sorted(missing))
    return "complete", ""
