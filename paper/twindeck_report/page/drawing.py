"""A model folder as triangles and lines to draw in three dimensions."""
from collections import Counter
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from ..study import Study

# Groups that lead up to the bridge. They reach far beyond the decks and would leave the bridge itself a small part of a drawing.
APPROACHES = ("ramp", "ramp_pier")
# Corners of the outer faces of a solid by its number of corners: tetrahedron, wedge, hexahedron.
SOLID_FACES = {
    4: ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    6: ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    8: ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
}


@dataclass(frozen=True)
class Drawing:
    ids: tuple  # (n) names of the nodes that are drawn
    points: np.ndarray  # (n x 3) [m]
    lines: np.ndarray  # (m x 2) positions in `points`: members, and the free edges of plates
    faces: np.ndarray  # (k x 3) positions in `points`
    elements: dict  # element id -> positions of its nodes
    groups: dict  # group, material or section -> set of positions
    names: dict  # named element, e.g. a stay -> set of positions
    approach: np.ndarray  # (n) whether approaches alone touch the node: they reach far beyond the structure and would make it small


def read_drawing(study: Study, folder: str) -> Drawing | None:
    """None for a model made of matrices: it has no elements to draw."""
    if not (study.results / folder / "elements.csv").is_file():
        return None
    nodes = study.step_csv(f"{folder}/nodes.csv", ["node", "x_m", "y_m", "z_m"])
    table = study.step_csv(f"{folder}/elements.csv", ["element", "type", "node1", "node2"])
    place = {name: i for i, name in enumerate(nodes["node"].astype(str))}
    corners = [c for c in table.columns if c.startswith("node") and c[4:].isdigit()]
    faces, lines, edges, outer = [], [], Counter(), Counter()
    oriented, elements, groups, names, touched = {}, {}, {}, {}, set()
    for row in table.to_dict("records"):
        at = [_position(place, row[c], study, folder) for c in corners if row[c] == row[c]]
        kind = row["type"]
        elements[str(row["element"])] = at
        if row.get("group") not in APPROACHES:
            touched.update(at)
        for key in ("group", "material", "section"):
            if isinstance(row.get(key), str):
                groups.setdefault(row[key], set()).update(at)
        if isinstance(row.get("name"), str):
            names.setdefault(row["name"], set()).update(at)
        if kind == "shell" and len(at) >= 3:
            faces += _triangles(at[:4])
            edges.update(tuple(sorted(e)) for e in zip(at[:4], at[1:4] + at[:1]))
        elif kind == "solid" and len(at) >= 4:
            for face in SOLID_FACES[8 if len(at) in (8, 20) else 6 if len(at) in (6, 15) else 4]:
                name = tuple(sorted(at[i] for i in face))
                outer[name] += 1
                oriented[name] = [at[i] for i in face]
        elif len(at) >= 2:
            lines.append((at[0], at[1]))
    for name, count in outer.items():  # a face that two solids share lies inside
        if count == 1:
            faces += _triangles(oriented[name])
            edges.update(tuple(sorted(e)) for e in zip(oriented[name], oriented[name][1:] + oriented[name][:1]))
    lines += [edge for edge, count in edges.items() if count == 1]
    return _compressed(nodes, lines, faces, elements, groups, names, touched)


def _position(place: dict, name, study: Study, folder: str) -> int:
    text = str(int(name)) if isinstance(name, float) and name == int(name) else str(name)
    if text not in place:
        raise InputError(f"{study.results / folder}/elements.csv: node {text} is not in nodes.csv")
    return place[text]


def _triangles(corners: list) -> list:
    return [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]


def _compressed(nodes, lines, faces, elements, groups, names, touched) -> Drawing:
    """Only the nodes that a line or face touches, numbered anew."""
    used = sorted({i for part in (*lines, *faces) for i in part})
    new = {old: i for i, old in enumerate(used)}
    kept = nodes.iloc[used]

    def renumbered(sets: dict) -> dict:
        return {k: [new[i] for i in v if i in new] for k, v in sets.items()}

    def table(rows, width: int) -> np.ndarray:
        return np.array([[new[i] for i in row] for row in rows], dtype=np.int64).reshape(-1, width)

    return Drawing(
        tuple(kept["node"].astype(str)),
        kept[["x_m", "y_m", "z_m"]].to_numpy(float),
        table(sorted(set(lines)), 2),
        table(faces, 3),
        renumbered(elements),
        renumbered(groups),
        renumbered(names),
        np.array([i not in touched for i in used], dtype=bool),
    )
