"""The structure from the side and a little above, as SVG: for the sensors and supports, and with the diagnosed place marked for the first screen."""
import html

import numpy as np

from ..study import Study
from .drawing import read_drawing
from .measured import read_measured
from .places import place_of, places
from .still import view

WIDTH, MARGIN = 480, 34  # of the view box: legible on a telephone
TALLEST = 0.85  # height of the structure at most, in widths of the picture
MODELS = ("s6_updating", "s4_refinement", "s1_model")
MOST_LINES = 5000
MOST_SPOTS = 12  # rings on one picture; a cause at more points is a group, whose parts are coloured
SAME_PLACE_M = 1e-3  # [m] apart: rounding of coordinates
FIRST_TALLEST = 0.6  # of the first screen's picture, in its widths: the table of states stands below it on the same screen


class Projection:
    """Points [m] to pixels of the view box."""

    def __init__(self, points, tallest: float = TALLEST):
        self.across, self.up = view(points)
        flat = self._flat(points)
        self.low, self.extent = flat.min(axis=0), np.maximum(np.ptp(flat, axis=0), 1e-9)
        self.scale = min((WIDTH - 2 * MARGIN) / self.extent[0], tallest * WIDTH / self.extent[1])
        self.height = 2 * MARGIN + self.scale * self.extent[1]

    def _flat(self, where):
        where = np.atleast_2d(np.asarray(where, float))
        return np.column_stack([where @ self.across, -(where @ self.up)])

    def __call__(self, where):
        return np.array([(WIDTH - self.scale * self.extent[0]) / 2, MARGIN]) + self.scale * (self._flat(where) - self.low)

    def svg(self, body: str, kind: str, label: str) -> str:
        return (f'<svg class="{kind}" viewBox="0 0 {WIDTH} {self.height:.0f}" width="{WIDTH}" height="{self.height:.0f}" role="img" '
                f'aria-label="{html.escape(label)}">{body}</svg>')


def model_folder(study: Study) -> str | None:
    """The latest model that has elements to draw."""
    return next((f"{t}/model" for t in MODELS if t in study.steps() and (study.results / t / "model/elements.csv").is_file()), None)


def drawn_model(drawing, place, shown=None) -> str:
    """`shown`: (n) which nodes are drawn; all of them by default."""
    at = place(drawing.points)
    kept, faces = drawing.lines, drawing.faces[:MOST_LINES]
    if shown is not None:
        kept, faces = (parts[shown[parts].all(axis=1)] for parts in (kept, faces))
    body = "".join(f"M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}L{c[0]:.1f} {c[1]:.1f}z" for a, b, c in at[faces]) if len(faces) else ""
    lines = _lines(at, kept[:: max(1, len(kept) // MOST_LINES)])
    return (f'<path class="plate" d="{body}"/>' if body else "") + f'<path class="member" d="{lines}"/>'


def _lines(at, lines) -> str:
    return "".join(f"M{at[i][0]:.1f} {at[i][1]:.1f}L{at[j][0]:.1f} {at[j][1]:.1f}" for i, j in lines)


def marked(study: Study, settings: dict, told: dict | None) -> dict | None:
    """{svg, marks: [words of each marked place], unplaced: [words of causes without a place], guessed: no cause is named there, a change would explain most};
    None where there is nothing to draw."""
    folder = model_folder(study)
    drawing = read_drawing(study, folder) if folder else None
    measured = read_measured(study, settings) if drawing is None else None
    if drawing is None and measured is None:
        return None
    found = causes(study, settings, folder, told)
    if drawing is not None:
        shown = _without_approaches(drawing, found)
        place = Projection(drawing.points[shown], FIRST_TALLEST)
        body = drawn_model(drawing, place, shown)
    else:
        place = Projection(measured.positions, FIRST_TALLEST)
        at = place(measured.positions)
        body = f'<path class="member" d="{_lines(at, measured.lines)}"/>' + "".join(f'<circle class="dot" cx="{x:.1f}" cy="{y:.1f}" r="3"/>' for x, y in at)
    for number, cause in enumerate((c for c in found if c["spots"] or c["nodes"]), 1):
        body += _mark(cause, drawing, place, number if len(found) > 1 else None)
    return {"svg": place.svg(body, "layout first", "The structure" + (", the place marked" if found else "")),
            "guessed": bool(found) and not (told["effects"] and told["verdict"] != "unknown"), "marks": [c["words"] for c in found if c["spots"] or c["nodes"]], "unplaced": [c["words"] for c in found if not c["spots"] and not c["nodes"]]}


def _without_approaches(drawing, found: list) -> np.ndarray:
    """Which nodes the picture shows: all where a cause lies on an approach, or where there is nothing else."""
    away = drawing.approach
    on = any(away[i] for cause in found for i in cause["nodes"])
    near = any(np.linalg.norm(drawing.points[away] - spot, axis=1).min(initial=np.inf) < SAME_PLACE_M for cause in found for spot in cause["spots"])
    return np.ones_like(away) if on or near or away.all() else ~away


def causes(study: Study, settings: dict, folder, told: dict | None) -> list:
    """Places of the causes; where none is named, of the highest score, if the verdict is that something is missing."""
    if told is None or told["verdict"] == "none":
        return []
    effects = told["effects"] if told["verdict"] != "unknown" else []
    entries = [{"location": where, "words": told or where, "score": -i, "place": e.get("place") or {}}
               for i, e in enumerate(effects) for where, told in (place_of(e),)]
    entries = entries or [{**e, "place": {}} for e in sorted(told.get("localisation", []), key=lambda e: -e["score"])[:1]]
    at = places(study, settings, folder, entries)
    for entry, one in zip(entries, at):
        where = [entry["place"].get(axis) for axis in ("x_m", "y_m", "z_m")]
        if not one["spots"] and not one["nodes"] and all(v is not None for v in where):
            one["spots"] = [where]
    return at


def _mark(cause: dict, drawing, place, number) -> str:
    """A group's parts in red; a ring around a point, with a number where there are several causes."""
    body, anchor = "", None
    if cause["nodes"] and drawing is not None:
        at, held = place(drawing.points), set(cause["nodes"])
        body += f'<path class="marked" d="{_lines(at, [e for e in drawing.lines if e[0] in held and e[1] in held])}"/>'
        faces = [f for f in drawing.faces[:MOST_LINES] if all(i in held for i in f)]
        body += '<path class="marked plate" d="' + "".join("M" + "L".join(f"{at[i][0]:.1f} {at[i][1]:.1f}" for i in f) + "z" for f in faces) + '"/>'
        anchor = at[sorted(held)].mean(axis=0)
    if cause["spots"] and not (cause["nodes"] and len(cause["spots"]) > 1):  # the parts of a group are coloured
        at = place(np.array(cause["spots"][:MOST_SPOTS]))
        body += "".join(f'<circle class="ring" cx="{x:.1f}" cy="{y:.1f}" r="13"/><circle class="spot" cx="{x:.1f}" cy="{y:.1f}" r="4.5"/>' for x, y in at)
        anchor = at[0]
    if number is not None and anchor is not None:
        body += f'<text class="which" x="{anchor[0] + 15:.1f}" y="{anchor[1] - 11:.1f}">{number}</text>'
    return f'<g><title>{html.escape(cause["words"])}</title>{body}</g>'
