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


def shape_data(study: Study, settings: dict, causes: list = ()) -> dict | None:
    """None when there is neither a model with elements nor a measured shape whose sensors have places. `causes`: [{words, spots}] to mark on the models."""
    meshes, sets, first = [], [], None
    marked = [{"kind": "cause", "at": [float(x) for x in spot], "words": cause["words"]} for cause in causes for spot in cause["spots"]]
    models = _models(study)
    for token, title in models:
        drawing = read_drawing(study, f"{token}/model")
        if drawing is None:
            continue
        modes, shapes = _model_modes(study, token, drawing, MOST_BYTES // len(models))
        if not modes:
            continue
        meshes.append({**mesh_data(drawing), "marks": by_node(marks(study, f"{token}/model")) + marked})
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
    title = "Identified, virtual campaign" if "s0_campaign" in study.steps() else "Identified"
    identified = [(read_measured(study, settings, step), words) for step, words in _conditions(study)]
    sets[:0] = [_measured_set(found, first, title + words, i) for i, (found, words) in enumerate(identified) if found is not None and len(found.points) > 1]
    if not sets:
        return None
    return {"meshes": meshes, "sets": sets}


def _models(study: Study) -> list:
    """The models that have shapes. The refined one stands between the updated and the designed one only where it alone has the updated one's nodes:
    there the page can colour what updating changed."""
    models = [m for m in MODELS if m[0] in study.steps() and (study.results / m[0] / "shapes.csv").is_file()]
    tokens = [token for token, _ in models]
    if "s6_updating" not in tokens:
        return models
    between = "s4_refinement" in tokens and _same_nodes(study, "s4_refinement") and not _same_nodes(study, "s1_model")
    return [(token, "Model before updating" if token == "s4_refinement" else title) for token, title in models if token != "s4_refinement" or between]


def _same_nodes(study: Study, token: str) -> bool:
    names = [f"{t}/model/nodes.csv" for t in (token, "s6_updating")]
    return all((study.results / name).is_file() for name in names) and study.step_csv(names[0]).equals(study.step_csv(names[1]))


def _conditions(study: Study) -> list:
    """(folder of step 3's results, words behind the title) of each condition; one alone has no words."""
    others = sorted(p.parent.name for p in (study.results / "s3_identification/conditions").glob("*/shapes.csv"))
    if "s3_identification" not in study.steps() or not others:
        return [("s3_identification", "")]
    poles = study.results / "s3_identification/poles.csv"
    first = study.step_csv("s3_identification/poles.csv")["condition"].iloc[0] if poles.is_file() and "condition" in study.step_csv("s3_identification/poles.csv") else "first"
    return [("s3_identification", f", {first}".replace("_", " ")), *((f"s3_identification/conditions/{name}", f", {name}".replace("_", " ")) for name in others)]


def mesh_data(drawing) -> dict:
    return {"points": packed(drawing.points, "f4"), "lines": packed(drawing.lines, "u4"), "faces": packed(drawing.faces, "u4"),
            "approach": packed(np.flatnonzero(drawing.approach), "u4") if drawing.approach.any() and not drawing.approach.all() else None}


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


def _measured_set(measured, first, title: str, number: int) -> dict:
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
        "id": f"measured_{number}" if number else "measured",
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
