"""Fig. 18: a schematic in place of the photograph of the section models in the wind tunnel."""
import numpy as np
import pandas as pd
from matplotlib.patches import Polygon

from ..study import Study
from .style import ACCENT, INK, PALE, plt
from .wind import nodes

NAME = "fig_18"
CAPTION = ("SCHEMATIC, not the paper's photograph (which is not available): the two decks' sections as section models would show them. "
           "Chords B are those computed with; the outlines of hulls and trusses are drawn freely.")
NEEDS = ("s7_aerodynamics",)


def draw(study: Study):
    frame = nodes(study)
    chords = frame.groupby("deck", sort=False)["chord_m"].first()
    figure, axes = plt.subplots(1, len(chords), figsize=(4.6 * len(chords), 2.9), squeeze=False)
    figure.subplots_adjust(0.03, 0.1, 0.97, 0.86, wspace=0.1)
    for place, (deck, chord) in zip(axes[0], chords.items()):
        _deck(place, deck, chord)
    figure.text(0.5, 0.95, "schematic", ha="center", color=ACCENT, fontsize=9)
    return figure, pd.DataFrame({"deck": chords.index, "chord_m": chords.to_numpy()})


def _deck(axes, deck, chord):
    half, track = chord / 2, 0.36 * chord
    hull = np.array([[-half, 0.0], [-track, 0.25], [track, 0.25], [half, 0.0], [0.3 * chord, -0.9], [-0.3 * chord, -0.9]])
    axes.add_patch(Polygon(hull, facecolor="#eef2f6", edgecolor=INK, linewidth=1.2))
    for side in (-track, track):
        axes.plot([side, 0], [0.1, -1.6], color=INK, linewidth=1.4)
        axes.plot([side, side], [0.25, 1.3], color=PALE, linewidth=1.2)
    axes.plot([-track, track], [0.1, 0.1], color=INK, linewidth=3)
    axes.plot([0], [-1.6], "o", color=INK, markersize=7)
    axes.annotate("", (half, -2.3), xytext=(-half, -2.3), arrowprops={"arrowstyle": "<->", "color": INK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0})
    axes.text(0, -2.6, f"B = {chord:.1f} m", ha="center", va="top", fontsize=9)
    axes.annotate("", (-half - 0.15, 0.0), xytext=(-half - 1.2, 0.0), arrowprops={"arrowstyle": "-|>", "color": ACCENT, "linewidth": 1.4})
    axes.text(-half - 1.25, 0.2, "V", color=ACCENT)
    axes.set_title(f"{deck} deck", fontsize=10)
    axes.set_xlim(-4.2, 3.2)
    axes.set_ylim(-3.3, 1.7)
    axes.set_aspect("equal")
    axes.set_axis_off()
