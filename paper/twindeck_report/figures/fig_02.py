"""Fig. 2: free bodies of both decks, and the axial forces that their curvature puts into the chords under dead load."""
from ..deck_section import CHORDS, DECKS, chord_forces, mean_forces, sections
from ..study import Study
from .style import ACCENT, INK, PALE, WARN, plt

NAME = "fig_02"
CAPTION = ("Left: free bodies of both decks at mid-length, chords and stay anchorages at the model's places (centre of the arcs to the left); e is "
           "the eccentricity of the weight W to the stay. Right: axial force along the chords under dead load and stay pulls, tension positive. "
           "Section 2.1 puts the foot deck's bottom chord in tension and the cycle deck's in compression. With the stays on the edges next to the mast, "
           "as in our model, the signs are the opposite: the arrows H are drawn as ours.")
NEEDS = ("s1_model",)
COLOURS = {"bottom": INK, "top inner": ACCENT, "top outer": WARN}
STATED = {"foot": "tension", "cycle": "compression"}  # section 2.1, of the bottom chord


def draw(study: Study):
    forces, places = chord_forces(study), sections(study)
    mean = mean_forces(forces)
    figure, axes = plt.subplots(2, 2, figsize=(10.4, 6.0), width_ratios=(1, 1.9))
    figure.subplots_adjust(0.01, 0.08, 0.985, 0.95, wspace=0.14, hspace=0.3)
    for (section, along), deck in zip(axes, DECKS):
        _section(section, deck, places[deck], mean.loc[deck])
        rows = forces[forces["deck"] == deck]
        for chord in CHORDS:
            part = rows[rows["chord"] == chord]
            along.plot(part["station_m"], part["axial_force_N"] / 1e6, color=COLOURS[chord], linewidth=1.3 if chord == "bottom" else 0.9, label=chord)
        along.axhline(0, color=INK, linewidth=0.7)
        along.set_ylabel("axial force (MN)")
        along.set_title(f"{deck} deck, bottom: {_sign(mean.at[deck, 'bottom'])} ({STATED[deck]} in section 2.1)", loc="left", fontsize=9)
    axes[1, 1].legend(frameon=False, fontsize=8, ncols=3, loc="center", bbox_to_anchor=(0.5, 0.62))
    axes[1, 1].set_xlabel("station along the deck from mid-length (m)")
    return figure, forces


def _sign(force: float) -> str:
    return "tension" if force > 0 else "compression"


def _section(axes, deck, places, mean):
    """The triangle of chords with weight, stay and the radial forces that balance their couple."""
    corners = [places[c] for c in ("top inner", "top outer", "bottom")]
    axes.plot(*zip(*corners, corners[0]), color=PALE, linewidth=1.5, zorder=1)
    for chord in CHORDS:
        axes.plot(*places[chord], "o", color=COLOURS[chord], markersize=8, zorder=3)
    stay, depth = places["stay"][0], places["bottom"][1]
    head = stay + (1.2 if stay > 0 else -1.2)  # the mast stands between the decks, on the side of the stays
    axes.plot([stay, head], [0, 1.9], color=INK, linewidth=1.4)
    axes.text(head, 2.0, "stay", ha="center", fontsize=9)
    _arrow(axes, (0, 1.9), (0, 0.25), INK)
    axes.text(0.12, 1.5, f"W$_{deck[0]}$", fontsize=10)
    axes.annotate("", (0, 0.42), xytext=(stay, 0.42), arrowprops={"arrowstyle": "<->", "color": INK, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0})
    axes.text(stay / 2, 0.48, f"e$_{deck[0]}$ = {abs(stay):.2f} m", ha="center", va="bottom", fontsize=8)
    # A chord in tension along an arc is pushed outwards by what holds it, one in compression inwards: force per length -N / R.
    x, z = places["bottom"]
    outwards = 1.0 if mean["bottom"] > 0 else -1.0
    _arrow(axes, (x + 0.2 * outwards, z), (x + 1.3 * outwards, z), COLOURS["bottom"])
    axes.text(x + 0.9 * outwards, z - 0.12, "H$_{2,%s}$" % deck[0], ha="center", va="top", fontsize=10)
    axes.text(0.5, -0.02, f"{deck} deck", transform=axes.transAxes, ha="center", va="top", fontsize=10)
    axes.set_xlim(-3.8, 3.8)
    axes.set_ylim(min(depth, -1.5) - 0.6, 2.5)
    axes.set_aspect("equal")
    axes.set_axis_off()


def _arrow(axes, start, end, colour):
    axes.annotate("", end, xytext=start, arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0})
