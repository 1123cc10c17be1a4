"""Fig. 17: motions, forces and angles of a section, and the angle of attack along the decks."""
import numpy as np
from matplotlib.patches import Arc, Polygon

from ..study import Study
from .style import ACCENT, INK, PALE, WARN, plt
from .wind import nodes

NAME = "fig_17"
CAPTION = ("Left: motions y (downwind), z (up), α (nose-up) of a section and the forces D, L, M along them; the angle of attack is the sum of "
           "β₁, the deck's own, and β₂, the wind's (drawn large). Right: angle of attack along the decks from their shape under dead load.")
NEEDS = ("s7_aerodynamics",)
COLOURS = (ACCENT, WARN)


def draw(study: Study):
    frame = nodes(study)
    figure, (section, along) = plt.subplots(1, 2, figsize=(10.4, 3.9), width_ratios=(1, 1.35))
    figure.subplots_adjust(0.01, 0.14, 0.98, 0.94, wspace=0.12)
    _section(section)
    for (name, deck), colour in zip(frame.groupby("deck", sort=False), COLOURS):
        along.plot(deck["station_m"], deck["angle_of_attack_deg"], color=colour, marker="o", markersize=2.5, linewidth=1.2, label=f"{name} deck")
    along.axhline(0, color=PALE, linewidth=0.8)
    along.set_xlabel("station along the deck from mid-length (m)")
    along.set_ylabel("angle of attack (degrees)")
    along.legend(frameon=False, fontsize=8)
    return figure, frame[["deck", "node", "station_m", "yaw_deg", "angle_of_attack_deg"]]


def _section(axes):
    tilt = np.radians(7.0)
    turn = np.array([[np.cos(tilt), np.sin(tilt)], [-np.sin(tilt), np.cos(tilt)]])  # nose (left) up
    outline = np.array([[-2.25, 0.0], [-1.7, 0.22], [1.7, 0.22], [2.25, 0.0], [0.6, -1.1], [-0.6, -1.1]]) @ turn.T
    axes.add_patch(Polygon(outline, facecolor="#f0f3f6", edgecolor=INK, linewidth=1.2))
    axes.plot([-3.6, 3.6], [0, 0], color=PALE, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.plot(*np.array([[-3.4, 0], [3.4, 0]]).dot(turn.T).T, color=INK, linewidth=0.8, linestyle=(0, (4, 3)))
    for tip, text, colour in (((1.9, 0), "y, D", INK), ((0, 1.9), "z, L", INK)):
        axes.annotate("", tip, xytext=(0, 0), arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.3})
        axes.text(tip[0] + 0.12, tip[1] + 0.12, text, fontsize=10)
    axes.add_patch(Arc((0, 0), 1.7, 1.7, theta1=60, theta2=170, color=INK, linewidth=1.1))
    axes.annotate("", (0.36, 0.77), xytext=(0.30, 0.795), arrowprops={"arrowstyle": "-|>", "color": INK})
    axes.text(-0.75, 0.95, "α, M", fontsize=10, ha="center")
    direction = np.array([np.cos(np.radians(6)), np.sin(np.radians(6))])
    end = np.array([-2.6, -0.28])
    axes.annotate("", end, xytext=end - 1.7 * direction, arrowprops={"arrowstyle": "-|>", "color": ACCENT, "linewidth": 1.5})
    axes.text(*(end - 1.75 * direction + [0, -0.35]), "V", color=ACCENT, fontsize=11)
    axes.text(-3.75, 0.45, "β₁", fontsize=10)
    axes.text(-3.75, -0.2, "β₂", fontsize=10, color=ACCENT)
    axes.set_xlim(-4.6, 3.8)
    axes.set_ylim(-2.0, 2.5)
    axes.set_aspect("equal")
    axes.set_axis_off()
