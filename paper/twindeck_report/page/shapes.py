"""Everything that the 3D view of mode shapes shows, as one JSON object: meshes, the models' modes, the identified modes."""
import base64

import numpy as np

from ..study import Study
from .drawing import read_drawing
from .marks import by_node, marks
from .measured import partners, read_measured

MODELS = (("s6_updating", "Updated model"), ("s4_refinement", "Refined model"), ("s1_model", "Model as designed"))
MOST_BYTES = 4_000_000  # of shapes before base64, all models together: the page stays small enough to be sent by mail


def packed(values: np.ndarray, kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype=np.dtype(kind).newbyteorder("<")).tobytes()).decode("ascii")


def shape_data(study: Study, settings: dict) -> dict | None:
    """None when there is neither a model with elements nor a measured shape whose sensors have places."""
    meshes, sets, first = [], [], None
    models = [m for m in MODELS if m[0] in study.steps() and (study.results / m[0] / "shapes.csv").is_file()]
    if any(token == "s6_updating" for token, _ in models):
        models = [m for m in models if m[0] != "s4_refinement"]
    for token, title in models:
        drawing = read_drawing(study, f"{token}/model")
        if drawing is None:
            continue
        modes, shapes = _model_modes(study, token, drawing, MOST_BYTES // len(models))
        if not modes:
            continue
        meshes.append({**mesh_data(drawing), "marks": by_node(marks(study, f"{token}/model"))})
        sets.append(
            {
                "id": token,
                "title": title,
                "kind": "model",
                "mesh": len(meshes) - 1,
                "modes": [{**mode, "shape": packed(np.round(32767 * shape), "i2")} for mode, shape in zip(modes, shapes)],
            }
        )
        first = first or (drawing, shapes)
    measured = read_measured(study, settings)
    if measured is not None and len(measured.points) > 1:
        virtual = "s0_campaign" in study.steps()
        sets.insert(0, _measured_set(measured, first, "Identified, virtual campaign" if virtual else "Identified"))
    if not sets:
        return None
    return {"meshes": meshes, "sets": sets}


def mesh_data(drawing) -> dict:
    return {"points": packed(drawing.points, "f4"), "lines": packed(drawing.lines, "u4"), "faces": packed(drawing.faces, "u4")}


def _model_modes(study: Study, token: str, drawing, budget: int):
    table = study.step_csv(f"{token}/shapes.csv", ["mode", "point", "direction", "value"])
    table = table[table["direction"].isin(["x", "y", "z"])]
    listed = study.step_csv(f"{token}/modes.csv", ["mode", "frequency_Hz"])
    most = max(1, budget // max(1, 6 * len(drawing.ids)))
    index = {name: i for i, name in enumerate(drawing.ids)}
    modes, shapes = [], []
    for row in listed.head(most).to_dict("records"):
        part = table[table["mode"] == row["mode"]]
        at = part["point"].astype(str).map(index)
        here = at.notna()
        shape = np.zeros((len(drawing.ids), 3))
        shape[at[here].astype(int), part["direction"][here].map({"x": 0, "y": 1, "z": 2})] = part["value"][here]
        largest = np.linalg.norm(shape, axis=1).max(initial=0.0)
        if largest > 0.0:
            modes.append({"label": str(int(row["mode"])), "frequency": _rounded(row["frequency_Hz"]), "damping": None})
            shapes.append(shape / largest)
    return modes, shapes


def _measured_set(measured, first, title: str) -> dict:
    pairs = partners(measured, first[0].points, first[1]) if first else []
    modes = []
    for i, ((label, frequency, damping), shape) in enumerate(zip(measured.modes, measured.shapes)):
        mode = {
            "label": label,
            "frequency": _rounded(frequency),
            "damping": _rounded(damping),
            "real": packed(shape.real, "f4"),
            "imag": packed(shape.imag, "f4"),
        }
        if pairs:
            mode["partner"], mode["mac"], mode["factor"] = pairs[i][0], round(pairs[i][1], 4), pairs[i][2]
        modes.append(mode)
    # the first mesh lies under the sensors only if they stand on it
    return {
        "id": "measured",
        "title": title,
        "kind": "points",
        "mesh": 0 if pairs else None,
        "points": packed(measured.positions, "f4"),
        "names": measured.points,
        "lines": packed(np.array(measured.lines).reshape(-1, 2), "u4"),
        "modes": modes,
    }


def _rounded(value):
    return None if value is None or value != value else float(f"{value:.6g}")
