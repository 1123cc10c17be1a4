"""Plan of the model with sensors on it."""
import numpy as np

from .style import INK, PALE

COLOURS = {"vertical": "#0b5fa5", "radial": "#b3261e", "both": "#5b3a8c"}
DECKS = ("slab", "chord", "deck")  # words in the names of the groups that make up a deck
MARGIN = 6.0  # [m] around the decks


def draw_plan(axes, mesh, margin=MARGIN):
    """The whole bridge, cut off a little beyond its decks: cables to the ground would halve the scale."""
    x, y = (np.hstack([mesh.points[mesh.lines][:, :, i], np.full((len(mesh.lines), 1), np.nan)]).ravel() for i in (0, 1))
    axes.plot(x, y, color=PALE, linewidth=0.3, zorder=1)
    axes.set_aspect("equal")
    lower, upper = mesh.extent(*DECKS)
    axes.set_xlim(lower[0] - margin, upper[0] + margin)
    axes.set_ylim(lower[1] - margin, upper[1] + margin)
    axes.set_xlabel("X (m)")
    axes.spines["left"].set_color(INK)
    axes.tick_params(labelsize=8)


def draw_sensors(axes, layout, names=False):
    """One mark a point: which directions are measured there. Names stand off the bridge's middle, so that they do not meet."""
    middle = layout["y_m"].mean() if len(layout) else 0.0
    for point, rows in layout.groupby("point", sort=False):
        directions = set(rows["direction"])
        colour = COLOURS["both"] if len(directions) > 1 else COLOURS[directions.pop()]
        row = rows.iloc[0]
        axes.plot(row["x_m"], row["y_m"], "o", color=colour, markersize=5.5, markeredgecolor="white", markeredgewidth=0.6, zorder=3)
        if names:
            below = row["y_m"] < middle and any((layout["y_m"] > row["y_m"]) & (np.abs(layout["x_m"] - row["x_m"]) < 12.0))
            axes.annotate(" / ".join(rows["channel"]), (row["x_m"], row["y_m"]), xytext=(0, -14 if below else 7), ha="center",
                          textcoords="offset points", fontsize=9, zorder=4)


def legend(axes):
    for label, colour in (("vertical", COLOURS["vertical"]), ("radial", COLOURS["radial"]), ("vertical and radial", COLOURS["both"])):
        axes.plot([], [], "o", color=colour, markersize=5.5, label=label)
    axes.legend(frameon=False, fontsize=8, loc="lower center")


def layout_of(study, setup):
    table = study.step_csv("s2_sensors/layout.csv", ["setup", "channel", "point", "direction", "x_m", "y_m", "z_m"])
    return table[table["setup"] == setup]
