"""Where a channel sat, by its name and the model: A3_z measured at the point A3 along z, N12x at node 12 along x."""
import re
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

DIRECTIONS = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "vertical": (0, 0, 1), "vert": (0, 0, 1), "up": (0, 0, 1), "down": (0, 0, -1)}
BY_NAME = re.compile(r"(?P<point>.*?)(?:[ _.:/]+(?P<sign>[+-]?)|(?P<plus>\+)|(?<=\d))(?P<axis>" + "|".join(DIRECTIONS) + ")", re.IGNORECASE)
NODE = re.compile(r"(?:n|node|knoten|grid)[ _.]*(\d+)", re.IGNORECASE)
TOLERANCE_M = 0.5  # from a sensor to its node: `sensor_tolerance` of step 4, whose default this is


@dataclass(frozen=True)
class Nodes:
    x_m: dict  # id (text) -> (x, y, z)
    named: dict  # name of a point in small letters -> id

    def of(self, name: str) -> str | None:
        """The node that a name means: a named point, or N12, node 12, 12 for node 12. None: no node of the model is meant."""
        text = name.strip()
        found = NODE.fullmatch(text)
        node = self.named.get(text.lower()) or (found[1] if found else text)
        return node if node in self.x_m else None

    def nearest(self, place) -> tuple:
        """(id, distance in metres) of the node nearest to `place` (three numbers)"""
        return min(((node, sum((a - b) ** 2 for a, b in zip(x, place)) ** 0.5) for node, x in self.x_m.items()), key=lambda at: at[1])


def nodes_of(folder: Path) -> Nodes | None:
    """Nodes of a model folder as step 1 writes it; None where it has none (a model of matrices)."""
    if not (folder / "nodes.csv").is_file():
        return None
    table = pd.read_csv(folder / "nodes.csv", dtype={"node": str})
    named = pd.read_csv(folder / "points.csv", dtype=str) if (folder / "points.csv").is_file() else pd.DataFrame({"point": [], "node": []})
    return Nodes({n: (x, y, z) for n, x, y, z in table[["node", "x_m", "y_m", "z_m"]].itertuples(index=False)}, {p.lower(): n for p, n in zip(named["point"], named["node"])})


def split_name(name: str) -> tuple:
    """(point, direction) of a channel's name; "" where it does not tell the direction. A lone hyphen (A3-z) may be a minus: no direction is read."""
    found = BY_NAME.fullmatch(name.strip())
    return (found["point"], (found["sign"] or "") + found["axis"].lower()) if found and found["point"] else (name.strip(), "")


def along(direction: str) -> dict | None:
    """dx, dy, dz of "x", "-z", "vertical", …; None for another text"""
    axis = DIRECTIONS.get(direction.lstrip("+-"))
    sign = -1 if direction.startswith("-") else 1
    return None if axis is None else dict(zip(("dx", "dy", "dz"), (str(sign * a) for a in axis)))


def completed(row: dict, name: str, nodes: Nodes | None) -> dict:
    """`row` of channels.csv with position and direction where they are empty and the model's node or the channel's name tells them.
    `row["node"]` is what a table of sensors calls the node."""
    point, direction = split_name(name)
    row = dict(row)
    asked, placed = row.pop("node", ""), all(row.get(f) for f in ("x_m", "y_m", "z_m"))
    node = nodes.of(asked or point) if nodes is not None and not placed and (asked or direction) else None
    if node is not None:
        told = (asked or point).strip()
        row |= dict(zip(("x_m", "y_m", "z_m"), (f"{v:.12g}" for v in nodes.x_m[node]))) | {"point": told if told.lower() in nodes.named else node}
    if direction and not any(row.get(f) for f in ("dx", "dy", "dz")):
        row |= along(direction)
    return row
