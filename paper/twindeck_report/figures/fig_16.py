"""Fig. 16: characteristic parameters of the strips that take the wind, and the yaw angle."""
import numpy as np
from matplotlib.patches import Polygon

from ..study import Study
from .style import ACCENT, INK, PALE, WARN, plt
from .wind import NODE_COLUMNS, nodes, tangents

NAME = "fig_16"
CAPTION = ("Aerodynamic nodes in plan with the strips that they stand for, coloured by the yaw angle of the wind to the deck's normal. "
           "Right: one strip with chord B and influence length L, and the oblique strip of the wind with B' = B/cos and L' = L cos of the "
           "yaw. Chords are assumed (4.5 and 5.0 m, with hulls).")
NEEDS = ("s7_aerodynamics",)
EXAMPLE = 3  # node of the first deck drawn large


def draw(study: Study):
    frame = nodes(study)
    figure, (plan, strip) = plt.subplots(1, 2, figsize=(10.4, 4.4), width_ratios=(1.9, 1))
    figure.subplots_adjust(0.06, 0.11, 0.98, 0.95, wspace=0.08)
    limit = frame["yaw_deg"].abs().max()
    colour = plt.cm.coolwarm
    for _, deck in frame.groupby("deck", sort=False):
        for corners, yaw in zip(_strips(deck), deck["yaw_deg"]):
            plan.add_patch(Polygon(corners, facecolor=colour(0.5 + 0.5 * yaw / limit), edgecolor=INK, linewidth=0.5))
        plan.plot(deck["x_m"], deck["y_m"], ".", color=INK, markersize=2.5)
        last = deck.iloc[-1]
        plan.annotate(f"{last['deck']}, {last['yaw_deg']:+.1f}°", (last["x_m"], last["y_m"]), xytext=(14, -8), textcoords="offset points", fontsize=8)
    top = frame["y_m"].max()
    for x in (-25.0, 0.0, 25.0):
        plan.annotate("", (x, top + 6), xytext=(x, top + 16), arrowprops={"arrowstyle": "-|>", "color": ACCENT, "linewidth": 1.3})
    plan.text(30, top + 10, "wind from the sea", color=ACCENT, fontsize=9, va="center")
    plan.set_aspect("equal")
    plan.autoscale_view()
    plan.set_ylim(top=top + 18)
    plan.set_xlim(right=1.35 * frame["x_m"].max())
    plan.set_xlabel("X (m)")
    plan.set_ylabel("Y (m)")
    mapping = plt.cm.ScalarMappable(plt.Normalize(-limit, limit), colour)
    bar = figure.colorbar(mapping, ax=plan, orientation="horizontal", fraction=0.04, pad=0.16)
    bar.set_label("yaw θ (degrees)")
    bar.outline.set_visible(False)
    _one_strip(strip, frame.iloc[EXAMPLE])
    return figure, frame[NODE_COLUMNS]


def _strips(deck):
    """Corners of each strip in plan: B across, L along."""
    along = tangents(deck)
    across = along @ np.array([[0.0, 1.0], [-1.0, 0.0]])
    centre = deck[["x_m", "y_m"]].to_numpy()
    half_l, half_b = 0.5 * deck["length_m"].to_numpy()[:, None], 0.5 * deck["chord_m"].to_numpy()[:, None]
    return np.stack([centre - half_l * along - half_b * across, centre + half_l * along - half_b * across,
                     centre + half_l * along + half_b * across, centre - half_l * along + half_b * across], axis=1)


def _one_strip(axes, node):
    """The strip with its deck along the x axis of the drawing."""
    b, length, yaw = node["chord_m"], node["length_m"], np.radians(abs(node["yaw_deg"]))
    reach = 1.5 * max(length, b * np.tan(yaw))
    for side in (-b / 2, b / 2):
        axes.plot([-reach, reach], [side, side], color=INK, linewidth=1.0)
    axes.add_patch(Polygon([(-length / 2, -b / 2), (length / 2, -b / 2), (length / 2, b / 2), (-length / 2, b / 2)], facecolor=PALE, alpha=0.6,
                           edgecolor=INK, linewidth=0.8))
    shift = b * np.tan(yaw) / 2
    axes.add_patch(Polygon([(-length / 2 + shift, -b / 2), (length / 2 + shift, -b / 2), (length / 2 - shift, b / 2), (-length / 2 - shift, b / 2)],
                           facecolor=ACCENT, alpha=0.18, edgecolor=ACCENT, linewidth=0.9))
    direction = np.array([np.sin(yaw), -np.cos(yaw)])
    tail = np.array([-shift, b / 2]) - 2.4 * direction
    axes.annotate("", tail + 2.2 * direction, xytext=tail, arrowprops={"arrowstyle": "-|>", "color": ACCENT, "linewidth": 1.4})
    axes.text(*(tail + [0.2, 0.3]), "V", color=ACCENT)
    axes.plot([0, 0], [-b / 2 - 0.4, b / 2 + 2.4], color=WARN, linewidth=0.8, linestyle=(0, (4, 3)))
    axes.text(0.1, b / 2 + 1.5, "normal", fontsize=8, color=WARN)
    _dimension(axes, (reach * 0.9, -b / 2), (reach * 0.9, b / 2), f"B = {b:.1f} m", INK)
    _dimension(axes, (-length / 2, -b / 2 - 0.8), (length / 2, -b / 2 - 0.8), f"L = {length:.2f} m", INK)
    axes.text(0, -b / 2 - 2.4, f"θ = {node['yaw_deg']:+.1f}°\nB' = B/cos θ = {node['oblique_chord_m']:.2f} m\n"
              f"L' = L cos θ = {node['oblique_length_m']:.2f} m", color=ACCENT, fontsize=9, ha="center", va="top")
    axes.set_xlim(-reach, reach * 1.25)
    axes.set_ylim(-b / 2 - 6.5, b / 2 + 3.2)
    axes.set_aspect("equal")
    axes.set_axis_off()


def _dimension(axes, start, end, text, colour):
    axes.annotate("", end, xytext=start, arrowprops={"arrowstyle": "<->", "color": colour, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0})
    middle = (np.array(start) + np.array(end)) / 2
    axes.text(*middle, text, fontsize=8, ha="center", va="center", rotation=90 if start[0] == end[0] else 0,
              bbox={"facecolor": "white", "edgecolor": "none", "pad": 1})
