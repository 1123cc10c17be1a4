"""Fig. 21: which rule holds where in the hybrid deployment of Table 14."""
import numpy as np

from ..study import Study
from .style import ACCENT, INK, PALE, WARN, plt

NAME = "fig_21"
CAPTION = ("Hybrid deployment of Table 14 in plan: aerodynamic nodes where the wind counts as normal to the deck (model A), and towards the "
           "ends, where static coefficients follow the cosine rule and derivatives skew-wind theory (model D). Right: the factors of each "
           "node over the yaw angle, with the switching angles.")
NEEDS = ("s8_validation",)
COLOURS = {"A": ACCENT, "D": WARN}
MARKERS = {"foot": "o", "cycle": "s"}
COLUMNS = ["deck", "node", "station_m", "x_m", "y_m", "yaw_deg", "model", "static_factor", "block_factor"]


def draw(study: Study):
    study = study.campaign()
    nodes = study.step_csv("s8_validation/hybrid_nodes.csv", COLUMNS)
    zones = study.step_csv("s8_validation/hybrid.csv", ["deck", "theta_from_deg", "theta_to_deg", "zone"])
    switch = {deck: rows["theta_to_deg"].max() for deck, rows in zones[zones["zone"] == "middle"].groupby("deck")}
    figure, (plan, factors) = plt.subplots(1, 2, figsize=(10.4, 4.2), width_ratios=(1.7, 1))
    figure.subplots_adjust(0.06, 0.12, 0.98, 0.94, wspace=0.16)
    for deck, rows in nodes.groupby("deck", sort=False):
        plan.plot(rows["x_m"], rows["y_m"], color=PALE, linewidth=5, zorder=1, solid_capstyle="round")
        for model, part in rows.groupby("model"):
            colour = COLOURS.get(model, INK)
            plan.scatter(part["x_m"], part["y_m"], color=colour, marker=MARKERS.get(deck, "^"), s=16, zorder=2)
            for name, style in (("static_factor", "none"), ("block_factor", colour)):
                factors.scatter(part["yaw_deg"], part[name], facecolors=style, edgecolors=colour, marker=MARKERS.get(deck, "^"), s=16)
        _marks(plan, rows, switch.get(deck))
    top = nodes["y_m"].max()
    for x in (-25.0, 0.0, 25.0):
        plan.annotate("", (x, top + 5), xytext=(x, top + 14), arrowprops={"arrowstyle": "-|>", "color": INK, "linewidth": 1.2})
    plan.text(29, top + 8, "wind", fontsize=9)
    plan.set_aspect("equal")
    plan.set_xlabel("X (m)")
    plan.set_ylabel("Y (m)")
    plan.set_ylim(top=top + 17)
    for model, text in (("A", "normal wind (A)"), ("D", "cosine rule and skew wind (D)")):
        plan.scatter([], [], color=COLOURS[model], s=16, label=text)
    plan.legend(frameon=False, fontsize=8, loc="lower center")
    factors.axhline(1.0, color=PALE, linewidth=0.8, zorder=0)
    for deck, angle in switch.items():
        for side in (-angle, angle):
            factors.axvline(side, color=PALE, linewidth=0.8, linestyle=(0, (4, 3)), zorder=0)
    factors.scatter([], [], facecolors="none", edgecolors=INK, s=16, label="on static coefficients")
    factors.scatter([], [], color=INK, s=16, label="on derivatives")
    factors.legend(frameon=False, fontsize=8)
    factors.set_xlabel("yaw θ (degrees)")
    factors.set_ylabel("factor")
    return figure, nodes[COLUMNS]


def _marks(axes, rows, angle):
    """Lines across the deck where the rule changes."""
    if angle is None:
        return
    yaw = rows["yaw_deg"].to_numpy()
    order = np.argsort(yaw)
    for side in (-angle, angle):
        if not yaw.min() < side < yaw.max():
            continue
        x, y = (np.interp(side, yaw[order], rows[c].to_numpy()[order]) for c in ("x_m", "y_m"))
        axes.plot(x, y, marker="|", color=INK, markersize=14, zorder=3)
        axes.annotate(f"{side:+.0f}°", (x, y), xytext=(0, 9), textcoords="offset points", fontsize=8, ha="center")
