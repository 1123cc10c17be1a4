"""A model folder as points and lines to draw, and a mode's displacements at its points."""
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..page.drawing import APPROACHES
from ..study import Study

CORNERS = ["node1", "node2", "node3", "node4"]


@dataclass(frozen=True)
class Mesh:
    ids: np.ndarray  # (n,) node ids
    points: np.ndarray  # (n x 3) [m]
    lines: np.ndarray  # (m x 2) positions in `points`: bars, beams, stays, edges of shells
    groups: np.ndarray  # (m,) group of the line's element (of the first one, where several share an edge)

    def part(self, *words) -> np.ndarray:
        """Lines whose group holds one of the words."""
        return self.lines[[any(word in group for word in words) for group in self.groups]]

    def extent(self, *words) -> tuple:
        """(lower corner, upper corner) of the lines of a part, of everything if the model has no such part."""
        lines = self.part(*words) if words else self.lines
        points = self.points[np.unique(lines if len(lines) else self.lines)]
        return points.min(axis=0), points.max(axis=0)


def read_mesh(study: Study, folder: str) -> Mesh:
    """The bridge without its approaches, and the nodes that it uses."""
    nodes = study.step_csv(f"{folder}/nodes.csv", ["node", "x_m", "y_m", "z_m"])
    elements = study.step_csv(f"{folder}/elements.csv", ["element", "group", *CORNERS])
    elements = elements[~elements["group"].isin(APPROACHES)]
    position = {int(n): i for i, n in enumerate(nodes["node"])}
    groups = {}
    for group, corners in zip(elements["group"].astype(str), elements[CORNERS].to_numpy(dtype=float)):
        corners = [int(c) for c in corners if not np.isnan(c)]
        edges = zip(corners, corners[1:] + corners[:1]) if len(corners) > 2 else [corners]
        for a, b in edges:
            if a not in position or b not in position:
                unknown = a if a not in position else b
                raise InputError(f"{study.results / folder}/elements.csv: node {unknown} is not in nodes.csv")
            groups.setdefault(tuple(sorted((position[a], position[b]))), group)
    lines = sorted(groups)
    used, renumbered = np.unique(np.array(lines), return_inverse=True)
    return Mesh(nodes["node"].to_numpy()[used], nodes[["x_m", "y_m", "z_m"]].to_numpy()[used], renumbered.reshape(-1, 2),
                np.array([groups[line] for line in lines]))


def displacements(study: Study, name: str, mode: int, mesh: Mesh) -> np.ndarray:
    """(n x 3) translations of a mode at the mesh's nodes; directions that shapes.csv does not hold are zero."""
    shapes = study.step_csv(name, ["mode", "point", "direction", "value"])
    chosen = shapes[(shapes["mode"] == mode) & shapes["direction"].isin(["x", "y", "z"])]
    if chosen.empty:
        raise InputError(f"{study.results / name}: no mode {mode}")
    table = chosen.pivot(index="point", columns="direction", values="value")
    return table.reindex(index=mesh.ids, columns=["x", "y", "z"]).fillna(0.0).to_numpy()
