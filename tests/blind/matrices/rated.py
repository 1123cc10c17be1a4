"""How an answer of step 9 is held against what was hidden.

The hidden cause is found where the set of an effect holds an entry of its family at its place: the same part or spring; any degree of freedom of the joint, or of a joint
within a tenth of the bridge's length; the same channels.

    right     an effect has found the cause, and every effect has
    wrong     an effect has not (on a sound bridge: any name or set)
    unknown, none   the verdict
"""
import numpy as np

NEAR = 0.1  # of the bridge's length
FAMILIES = {
    "part": ("stiffness",), "spring": ("stiffness",), "mass": ("mass", "osc"), "oscillator": ("osc",), "temperature": ("tempE",),
    "gain": ("gain",), "polarity": ("pol",), "swap": ("swap",),
}


def joint_of(bridge, location):
    """None: the location is no node."""
    kind, _, name = location.partition(":")
    if kind != "node":
        return None
    return int(name[1:]) if name.startswith("j") else int(bridge.joint_of[int(name[1:]) - 1])


def is_found(cause, entry, bridge):
    family, _, location = entry.partition("@")
    if family not in FAMILIES[cause.kind]:
        return False
    if cause.kind in ("mass", "oscillator"):
        joint = joint_of(bridge, location)
        return joint is not None and float(np.linalg.norm(bridge.place[joint] - bridge.place[int(cause.place)])) <= NEAR * bridge.length
    return cause.kind == "temperature" or set(location.partition(":")[2].split(",")) == set(cause.place.split(","))


def entries_of(effect):
    return [f"{effect['cause']}@{effect['location']}", *effect.get("cluster", [])]


def rate(answer, cause, bridge):
    if answer["verdict"] in ("none", "unknown"):
        return answer["verdict"]
    found = [cause is not None and any(is_found(cause, entry, bridge) for entry in entries_of(effect)) for effect in answer["effects"]]
    return "right" if found and all(found) else "wrong"


def rank_of_truth(ranking, cause, bridge):
    """Where the first entry that finds the cause stands in the ranking, counted from 1; 0: nowhere. @param ranking  "family@location" in order"""
    return next((i for i, entry in enumerate(ranking, 1) if is_found(cause, entry, bridge)), 0) if cause is not None else 0


def is_beside(cause, answer):
    """Whether an answer holds a part of the deck next to the hidden one: told apart, and not right by itself."""
    if cause is None or cause.kind != "part" or not cause.place.startswith("Conc"):
        return False
    near = {f"group:Conc{int(cause.place[4:]) + step}" for step in (-1, 1)}
    return any(entry.partition("@")[2] in near for effect in answer["effects"] for entry in entries_of(effect))


def in_words(answer):
    return "; ".join(
        f"{e['cause']}@{e['location']}[{len(e.get('cluster', []))}] p {e['probability']:.2f}"
        + "".join(f" {p['name']}={p['value']:.3g}({p['low']:.3g},{p['high']:.3g})" for p in e["parameters"][:1]) for e in answer["effects"]
    )
