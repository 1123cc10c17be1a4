"""Fig. 18: a schematic in place of the photograph of the section models in the wind tunnel."""
import pandas as pd
from matplotlib.patches import Polygon

from ..deck_section import CHORDS, sections
from ..study import Study
from .style import ACCENT, INK, PALE, plt
from .wind import nodes

NAME = "fig_18"
CAPTION = ("SCHEMATIC, not the paper's photograph (which is not available): the two decks' sections as models of scale 1:5 would show them. Chords lie "
           "where the model has them at mid-length, widths B are those computed with; the outlines of hulls and railings are drawn freely.")
NEEDS = ("s1_model", "s7_aerodynamics")
SCALE = 5  # of the tunnel's models, section 5.1


def draw(study: Study):
    chords = nodes(study).groupby("deck", sort=False)["chord_m"].first()
    places = sections(study)
    deepest = min(p["bottom"][1] for p in places.values())
    figure, axes = plt.subplots(1, len(chords), figsize=(4.8 * len(chords), 3.3), squeeze=False)
    figure.subplots_adjust(0.02, 0.02, 0.98, 0.86, wspace=0.04)
    for place, (deck, chord) in zip(axes[0], chords.items()):
        _deck(place, deck, chord, places[deck], deepest)
    figure.text(0.5, 0.95, "schematic", ha="center", color=ACCENT, fontsize=9)
    rows = [{"deck": deck, "part": part, "across_m": places[deck][part][0], "up_m": places[deck][part][1], "chord_m": chord}
            for deck, chord in chords.items() for part in (*CHORDS, "stay")]
    return figure, pd.DataFrame(rows)


def _deck(axes, deck, chord, places, deepest):
    half = chord / 2
    # mirrored, so that the wind from the sea comes from the left, as in Fig. 17
    inner, outer, bottom = ((-places[c][0], places[c][1]) for c in ("top inner", "top outer", "bottom"))
    left, right = sorted((inner[0], outer[0]))
    hull = [(-half, 0.1), (left, 0.3), (right, 0.3), (half, 0.1), (0.45 * half, 0.6 * bottom[1]), (-0.45 * half, 0.6 * bottom[1])]
    axes.add_patch(Polygon(hull, facecolor="#eef2f6", edgecolor=INK, linewidth=1.0))
    for corner in (inner, outer):
        axes.plot(*zip(corner, bottom), color=INK, linewidth=1.3)
        axes.plot([corner[0]] * 2, [0.3, 1.35], color=PALE, linewidth=1.2)
        axes.plot(*corner, "o", color=INK, markersize=5)
    axes.plot([inner[0], outer[0]], [0.1, 0.1], color=INK, linewidth=3)
    axes.plot(*bottom, "o", color=INK, markersize=7)
    level = bottom[1] - 0.45
    axes.annotate("", (half, level), xytext=(-half, level), arrowprops={"arrowstyle": "<->", "color": INK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0})
    axes.text(0, level - 0.12, f"B = {chord:.1f} m, in the tunnel {chord / SCALE:.2f} m", ha="center", va="top", fontsize=9)
    axes.annotate("", (-half - 0.15, 0.1), xytext=(-half - 1.3, 0.1), arrowprops={"arrowstyle": "-|>", "color": ACCENT, "linewidth": 1.4})
    axes.text(-half - 1.1, 0.3, "V", color=ACCENT)
    axes.set_title(f"{deck} deck", fontsize=10)
    axes.set_xlim(-4.2, 3.4)
    axes.set_ylim(deepest - 1.0, 1.6)
    axes.set_aspect("equal")
    axes.set_axis_off()
