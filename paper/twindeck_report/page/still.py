"""Mode shapes that stand still: for print, and for readers whose browser runs no scripts."""
import base64
import io

import numpy as np

from ..figures.style import ACCENT, PALE, WARN, plt

MOST, SWAY = 6, 0.06  # pictures; largest displacement as a share of the structure's length
LINES = 4000  # more than these are thinned out: the picture is small


def stills(data: dict) -> str | None:
    """A sheet of the first modes of the first set, as base64 PNG: the model's if there is one."""
    chosen = next((s for s in data["sets"] if s["kind"] == "model"), data["sets"][0])
    count = min(MOST, len(chosen["modes"]))
    if count == 0:
        return None
    points, lines = _geometry(data, chosen)
    axis, up = view(points)
    length = np.ptp(points, axis=0).max() or 1.0
    columns = min(3, count)
    figure, axes = plt.subplots(
        (count + columns - 1) // columns, columns, figsize=(9.0, 2.3 * ((count + columns - 1) // columns)), squeeze=False
    )
    for axes_, mode in zip(axes.flat, chosen["modes"]):
        if chosen["kind"] == "model":
            shape = np.frombuffer(base64.b64decode(mode["shape"]), "<i2").reshape(-1, 3) / 32767.0
        else:
            shape = np.frombuffer(base64.b64decode(mode["real"]), "<f4").reshape(-1, 3).astype(float)
        moved = points + SWAY * length * shape
        for where, colour, width in ((points, PALE, 0.3), (moved, ACCENT, 0.35)):
            flat = np.column_stack([where @ axis, where @ up])
            axes_.plot(*_segments(flat, lines), color=colour, linewidth=width)
            if chosen["kind"] == "points":
                axes_.plot(*flat.T, ".", color=colour if where is points else WARN, markersize=3)
        axes_.set_aspect("equal")
        _frame(axes_, np.column_stack([points @ axis, points @ up]), SWAY * length)
        axes_.axis("off")
        axes_.set_title(f"mode {mode['label']}, {mode['frequency']:.3f} Hz", fontsize=9)
    for axes_ in list(axes.flat)[count:]:
        axes_.axis("off")
    figure.tight_layout()
    out = io.BytesIO()
    figure.savefig(out, format="png", dpi=110, metadata={"Software": None})
    plt.close(figure)
    return base64.b64encode(out.getvalue()).decode("ascii")


def _frame(axes_, flat, margin: float) -> None:
    """Limits that hold the whole structure, its approach ramps too."""
    axes_.set_xlim(flat[:, 0].min() - margin, flat[:, 0].max() + margin)
    axes_.set_ylim(flat[:, 1].min() - margin, flat[:, 1].max() + margin)


def _geometry(data, chosen):
    source = data["meshes"][chosen["mesh"]] if chosen["kind"] == "model" else chosen
    points = np.frombuffer(base64.b64decode(source["points"]), "<f4").reshape(-1, 3).astype(float)
    lines = np.frombuffer(base64.b64decode(source["lines"]), "<u4").reshape(-1, 2).astype(int)
    if chosen["kind"] == "model":
        faces = np.frombuffer(base64.b64decode(source["faces"]), "<u4").reshape(-1, 3).astype(int)
        lines = np.vstack([lines, faces[:, :2]]) if len(faces) else lines
    return points, lines[:: max(1, len(lines) // LINES)]


def view(points):
    """Axes of a view from the side and a little above, across the structure's longest direction in plan."""
    centred = points[:, :2] - points[:, :2].mean(axis=0)
    _, vectors = np.linalg.eigh(centred.T @ centred)
    along = vectors[:, -1] * (1.0 if vectors[np.abs(vectors[:, -1]).argmax(), -1] > 0 else -1.0)
    turn, lift = np.radians(25.0), np.radians(28.0)
    a = np.array([along[0] * np.cos(turn) - along[1] * np.sin(turn), along[0] * np.sin(turn) + along[1] * np.cos(turn), 0.0])
    away = np.array([-a[1], a[0], 0.0])
    return a, np.sin(lift) * away + np.cos(lift) * np.array([0.0, 0.0, 1.0])


def _segments(flat, lines):
    """All lines as one broken line: much faster than one object each."""
    gap = np.full(len(lines), np.nan)
    return [np.column_stack([flat[lines[:, 0], k], flat[lines[:, 1], k], gap]).ravel() for k in (0, 1)]
