"""Supports, springs and dampers of a model folder as marks at its nodes, with words for each."""
from ..study import Study
from .numbers import physical

DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")
PLANE = 0.5  # share of the nodes: what more of them have held alike is a plane model's plane, not a support


def marks(study: Study, folder: str) -> list:
    """[{kind: support | spring | turning, at: [x, y, z], words}], one a node and kind; empty where the model has no such files."""
    if not (study.results / folder / "nodes.csv").is_file():
        return []
    nodes = {_name(r["node"]): [float(r[c]) for c in ("x_m", "y_m", "z_m")]
             for r in study.step_csv(f"{folder}/nodes.csv", ["node", "x_m", "y_m", "z_m"]).to_dict("records")}
    found = {}
    for kind, node, words in (*_supports(study, folder, len(nodes)), *_springs(study, folder)):
        if node in nodes:
            found.setdefault((kind, node), []).append(words)
    return [{"kind": kind, "at": nodes[node], "words": "; ".join(dict.fromkeys(words))} for (kind, node), words in found.items()]


def _supports(study: Study, folder: str, nodes: int) -> list:
    if not (study.results / folder / "supports.csv").is_file():
        return []
    table = study.step_csv(f"{folder}/supports.csv", ["support", "node"])
    held = [(str(r["support"]), _name(r["node"]), [d for d in DIRECTIONS if r.get(d) == 1]) for r in table.to_dict("records")]
    plane = {d for d in DIRECTIONS if sum(d in each for _, _, each in held) > PLANE * nodes}
    return [("support", node, f"support {name}: holds {', '.join(d for d in each if d not in plane)}") for name, node, each in held
            if any(d not in plane for d in each)]


def _springs(study: Study, folder: str) -> list:
    if not (study.results / folder / "springs.csv").is_file():
        return []
    table = study.step_csv(f"{folder}/springs.csv", ["spring", "node"])
    return [("turning" if r.get("quantity") == "rotation" else "spring", _name(r["node"]), f"{r['spring']}: {_constants(r)}")
            for r in table.to_dict("records") if r.get("active", 1) != 0]


def by_node(found: list) -> list:
    """The marks of a node as one, for a drawing that has one point a node: `spring` where there is any."""
    merged = {}
    for mark in found:
        merged.setdefault(tuple(mark["at"]), []).append(mark)
    return [{"kind": "support" if all(m["kind"] == "support" for m in each) else "spring", "at": list(at), "words": "; ".join(m["words"] for m in each)}
            for at, each in merged.items()]


def _constants(row: dict) -> str:
    turning = row.get("quantity") == "rotation"
    parts = []
    for key, unit in (("stiffness_N_m", "N m/rad" if turning else "N/m"), ("damping_N_s_m", "N s/m"), ("friction_N", "N")):
        value = row.get(key)
        if value is not None and value == value and value != 0:
            parts.append({"N s/m": "damper ", "N": "friction "}.get(unit, "spring ") + physical(value, unit))
    return (", ".join(parts) or "spring") + (", turning" if turning else "")


def _name(node) -> str:
    return str(int(node)) if isinstance(node, float) and node == int(node) else str(node)
