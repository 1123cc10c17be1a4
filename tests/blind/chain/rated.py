"""How an answer of step 9 is held against what was hidden.

A hidden cause is found where the set of an effect holds an entry of its family at its place: the same group, spring, node or channel, or a part whose middle lies within a
tenth of the structure's length. A parameter's group of springs is the place of causes that together are all of its springs. Causes whose effect is below six are not asked for; to name one is right all the same.

    right     every visible cause is found, and every effect has found one
    part      two causes, one found, and every effect has found one
    wrong     an effect has found none (on a sound structure: any name or set)
    unknown, none   the verdict
"""
import csv
import pathlib
import tomllib

import numpy as np

VISIBLE_SIGMA = 6.0
NEAR = 0.1  # of the structure's length
FAMILIES = {
    "stiffness": ("stiffness", "joint", "lost"), "mass": ("mass", "osc"), "bearing": ("brg", "lost", "stiffness", "foundation"),
    "temperature": ("tempE",), "polarity": ("pol",), "gain": ("gain",), "swap": ("swap",),
}


class Places:
    """Middles and groups of the locations of a model folder."""

    def __init__(self, model):
        def rows(name):
            path = pathlib.Path(model) / name
            if not path.is_file():
                return []
            with open(path, newline="", encoding="utf-8") as stream:
                return list(csv.DictReader(stream))

        self.nodes = {r["node"]: np.array([float(r["x_m"]), float(r["z_m"])]) for r in rows("nodes.csv")}
        self.elements = {r["element"]: (r["group"], [r["node1"], r["node2"]]) for r in rows("elements.csv")}
        self.springs = {r["spring"]: r["node"] for r in rows("springs.csv")}
        self.supports = {r["support"]: r["node"] for r in rows("supports.csv")}
        with open(pathlib.Path(model) / "model.toml", "rb") as stream:
            self.parameters = {p["name"]: set(p["of"]) for p in tomllib.load(stream).get("parameter", [])}

    def middle(self, location):
        """None: the location is nowhere (global, a mode, a channel)."""
        kind, _, names = location.partition(":")
        nodes = []
        for name in names.split(","):
            if kind in ("node", "nodes"):
                nodes += [name] if name in self.nodes else []
            elif kind == "element" and name in self.elements:
                nodes += self.elements[name][1]
            elif kind in ("group", "groups"):
                nodes += [n for group, ends in self.elements.values() if group == name for n in ends]
                nodes += [self.springs[name]] if name in self.springs else []
            elif kind in ("support", "damper"):
                nodes += [n for table in (self.springs, self.supports) for s, n in table.items() if s == name]
        return np.mean([self.nodes[n] for n in nodes], axis=0) if nodes else None

    def names(self, location):
        """Names that a location answers to: itself, and the group of an element."""
        kind, _, names = location.partition(":")
        return {names} | set(names.split(",")) | ({self.elements[names][0]} if kind == "element" and names in self.elements else set())


def is_found(cause, entry, places, length, hidden):
    """hidden: places of all causes"""
    family, _, location = entry.partition("@")
    if family not in FAMILIES[cause.kind]:
        return False
    group = places.parameters.get(location.partition(":")[2], set()) & set(places.springs)
    if cause.kind == "bearing" and cause.place in group:
        return group <= hidden
    if cause.kind == "temperature" or cause.place in places.names(location):
        return True
    if cause.kind in ("polarity", "gain", "swap"):
        return location.partition(":")[2] == cause.place
    kind = {"stiffness": "group", "mass": "node", "bearing": "group"}[cause.kind]
    here, there = places.middle(location), places.middle(f"{kind}:{cause.place}")
    return here is not None and there is not None and float(np.linalg.norm(here - there)) <= NEAR * length


def rate(answer, causes, places, length):
    """(rating, causes found among the visible)"""
    visible = [cause for cause in causes if cause.sigma >= VISIBLE_SIGMA]
    if answer["verdict"] in ("none", "unknown"):
        return answer["verdict"], 0
    found, hidden = set(), {cause.place for cause in causes}
    for effect in answer["effects"]:
        entries = [f"{effect['cause']}@{effect['location']}", *effect.get("cluster", [])]
        here = {i for i, cause in enumerate(causes) if any(is_found(cause, entry, places, length, hidden) for entry in entries)}
        if not here:
            return "wrong", 0
        found |= here
    count = sum(any(causes[i] is cause for i in found) for cause in visible)
    return ("right" if count == len(visible) else "part"), count
