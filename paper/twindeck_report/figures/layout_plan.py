"""Plan of the model with sensors on it."""
import numpy as np

from .style import INK, PALE

COLOURS = {"vertical": "#0b5fa5", "radial": "#b3261e", "both": "#5b3a8c"}


def draw_plan(axes, mesh):
    x, y = (np.hstack([mesh.points[mesh.lines][:, :, i], np.full((len(mesh.lines), 1), np.nan)]).ravel() for i in (0, 1))
    axes.plot(x, y, color=PALE, linewidth=0.3, zorder=1)
    axes.set_aspect("equal")
    axes.set_xlabel("X (m)")
    axes.spines["left"].set_color(INK)
    axes.tick_params(labelsize=8)


def draw_sensors(axes, layout, names=False):
    """One mark a point: which directions are measured there."""
    for point, rows in layout.groupby("point", sort=False):
        directions = set(rows["direction"])
        colour = COLOURS["both"] if len(directions) > 1 else COLOURS[directions.pop()]
        row = rows.iloc[0]
        axes.plot(row["x_m"], row["y_m"], "o", color=colour, markersize=5.5, markeredgecolor="white", markeredgewidth=0.6, zorder=3)
        if names:
            axes.annotate(" / ".join(rows["channel"]), (row["x_m"], row["y_m"]), xytext=(5, 6), textcoords="offset points", fontsize=8)


def legend(axes):
    for label, colour in (("vertical", COLOURS["vertical"]), ("radial", COLOURS["radial"]), ("vertical and radial", COLOURS["both"])):
        axes.plot([], [], "o", color=colour, markersize=5.5, label=label)
    axes.legend(frameon=False, fontsize=8, loc="upper right")


def layout_of(study, setup):
    table = study.step_csv("s2_sensors/layout.csv", ["setup", "channel", "point", "direction", "x_m", "y_m", "z_m"])
    return table[table["setup"] == setup]
