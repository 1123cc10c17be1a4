"""A model folder as points and lines to draw, and a mode's displacements at its points."""
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..study import Study


@dataclass(frozen=True)
class Mesh:
    ids: np.ndarray  # (n,) node ids
    points: np.ndarray  # (n x 3) [m]
    lines: np.ndarray  # (m x 2) positions in `points`: bars, beams, stays, edges of shells


def read_mesh(study: Study, folder: str) -> Mesh:
    nodes = study.step_csv(f"{folder}/nodes.csv", ["node", "x_m", "y_m", "z_m"])
    elements = study.step_csv(f"{folder}/elements.csv", ["element", "node1", "node2", "node3", "node4"])
    position = {int(n): i for i, n in enumerate(nodes["node"])}
    lines = set()
    for corners in elements[["node1", "node2", "node3", "node4"]].to_numpy(dtype=float):
        corners = [int(c) for c in corners if not np.isnan(c)]
        edges = zip(corners, corners[1:] + corners[:1]) if len(corners) > 2 else [corners]
        for a, b in edges:
            if a not in position or b not in position:
                unknown = a if a not in position else b
                raise InputError(f"{study.results / folder}/elements.csv: node {unknown} is not in nodes.csv")
            lines.add(tuple(sorted((position[a], position[b]))))
    return Mesh(nodes["node"].to_numpy(), nodes[["x_m", "y_m", "z_m"]].to_numpy(), np.array(sorted(lines)))


def displacements(study: Study, name: str, mode: int, mesh: Mesh) -> np.ndarray:
    """(n x 3) translations of a mode at the mesh's nodes; directions that shapes.csv does not hold are zero."""
    shapes = study.step_csv(name, ["mode", "point", "direction", "value"])
    chosen = shapes[(shapes["mode"] == mode) & shapes["direction"].isin(["x", "y", "z"])]
    if chosen.empty:
        raise InputError(f"{study.results / name}: no mode {mode}")
    table = chosen.pivot(index="point", columns="direction", values="value")
    return table.reindex(index=mesh.ids, columns=["x", "y", "z"]).fillna(0.0).to_numpy()
