"""The sensor layout: the model from the side and a little above, with its supports and springs, and an arrow a channel."""
import html

import numpy as np

from ..study import Study
from .drawing import read_drawing
from .marks import marks
from .measured import read_measured
from .picture import WIDTH, Projection, drawn_model, model_folder

ARROW = 26.0  # [px]
MOST_NAMES, FEW_POINTS = 40, 12
LETTER = 5.6  # [px] width of a letter of the names, on the safe side


def layout(study: Study, settings: dict) -> dict | None:
    """{svg, drawn (whether a model is), channels, points, supports, springs}; None where there is neither a drawn model nor a sensor with a place."""
    folder = model_folder(study)
    drawing = read_drawing(study, folder) if folder else None
    held = marks(study, folder) if drawing is not None else []
    measured = read_measured(study, settings)
    if drawing is None and measured is None:
        return None
    placed = measured.channels if measured is not None else None
    points = np.vstack([part for part in (drawing.points if drawing is not None else None, measured.positions if measured is not None else None) if part is not None])
    place = Projection(points)
    body = drawn_model(drawing, place) if drawing is not None else ""
    for mark in held:
        body += _mark(mark, *place(mark["at"])[0])
    body += _sensors(placed, place) if placed is not None else ""
    svg = place.svg(body, "layout", "Sensors, supports and springs on the model")
    return {"svg": svg, "drawn": drawing is not None, "channels": 0 if placed is None else len(placed), "points": 0 if measured is None else len(measured.points),
            "supports": sum(m["kind"] == "support" for m in held), "springs": len({tuple(m["at"]) for m in held if m["kind"] != "support"})}


def _mark(mark: dict, x: float, y: float) -> str:
    if mark["kind"] == "support":
        shape = f'<path class="support" d="M{x:.1f} {y:.1f}l-6 10h12z"/>'
    elif mark["kind"] == "turning":  # three quarters of a circle around the node
        shape = f'<path class="spring" d="M{x - 9:.1f} {y:.1f}a9 9 0 1 1 9 9"/>'
    else:  # a zigzag to the left
        shape = f'<path class="spring" d="M{x:.1f} {y:.1f}h-4l-2 -5l-3 10l-3 -10l-3 10l-2 -5h-4"/>'
    return f'<g><title>{html.escape(mark["words"])}</title>{shape}</g>'


def _sensors(channels, place) -> str:
    """An arrow a channel along its direction, and the points' names where there is room."""
    body, points, taken = "", [], []
    reach = ARROW if channels["point"].nunique() <= FEW_POINTS else 0.6 * ARROW
    for point, rows in channels.groupby("point", sort=False):
        x, y = place(rows[["x_m", "y_m", "z_m"]].to_numpy(float)[:1])[0]
        points.append((str(point), x, y))
        taken.append((x - 3, y - 3, x + 3, y + 3))
        names = ", ".join(rows["channel"])
        body += f'<g class="sensor"><title>{html.escape(f"{point}: {names}")}</title>'
        for d in rows[["dx", "dy", "dz"]].to_numpy(float):
            dx, dy = reach * (d @ place.across), -reach * (d @ place.up)
            body += f'<path d="M{x:.1f} {y:.1f}l{dx:.1f} {dy:.1f}{_head(dx, dy)}"/>'
        body += f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3"/></g>'
    return body + "".join(_named(name, x, y, taken) for name, x, y in points if len(points) <= MOST_NAMES)


def _head(dx: float, dy: float) -> str:
    """Two strokes back from the tip; none where the arrow points at the reader."""
    length = float(np.hypot(dx, dy))
    if length < 5.0:
        return ""
    ux, uy = dx / length, dy / length
    left, right = (-5 * ux + 3 * uy, -5 * uy - 3 * ux), (-5 * ux - 3 * uy, -5 * uy + 3 * ux)
    return f"l{left[0]:.1f} {left[1]:.1f}m{-left[0]:.1f} {-left[1]:.1f}l{right[0]:.1f} {right[1]:.1f}"


def _named(name: str, x: float, y: float, taken: list) -> str:
    """The name beside its point, where it lies on no other name; nothing where it would."""
    wide = LETTER * len(name)
    for ox, oy in ((7, -6), (-7 - wide, -6), (7, 14), (-7 - wide, 14), (7, 4), (-7 - wide, 4)):
        box = (x + ox, y + oy - 9, x + ox + wide, y + oy + 2)
        if box[0] > 0 and box[2] < WIDTH and not any(box[0] < t[2] and t[0] < box[2] and box[1] < t[3] and t[1] < box[3] for t in taken):
            taken.append(box)
            return f'<text x="{box[0]:.1f}" y="{y + oy:.1f}">{html.escape(name)}</text>'
    return ""
