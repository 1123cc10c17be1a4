"""Fig. 15: a schematic in place of the photograph of a stay's sleeve with its rings, and what the sleeves do to the stays."""
from matplotlib.patches import Rectangle

from ..study import Study
from .style import ACCENT, GOOD, INK, PALE, WARN, plt

NAME = "fig_15"
CAPTION = ("Left: SCHEMATIC, not the paper's photograph (which is not available): antivandalism sleeve about a stay with two half rings of damping rubber "
           "at its end and two of Teflon that touch the cable; sizes are free. Right: frequencies with over without sleeves and damping ratios, identified "
           "from the records of single stays of the virtual campaign (Table 5); bars: one standard deviation.")
NEEDS = ("s3_identification",)
CASES = (("without_sleeves", "without", PALE), ("with_sleeves", "with", ACCENT))


def draw(study: Study):
    stays = study.step_csv("s3_identification/stays.csv", ["stay", "condition", "harmonic", "frequency_Hz", "damping_ratio_pct", "damping_ratio_std_pct"])
    stays = stays[stays["condition"].isin([case for case, *_ in CASES])]
    names = list(dict.fromkeys(stays["stay"]))
    figure, (sleeve, ratio, damping) = plt.subplots(1, 3, figsize=(10.4, 3.6), width_ratios=(0.8, 1, 1.3))
    figure.subplots_adjust(0.01, 0.15, 0.985, 0.9, wspace=0.3)
    _sleeve(sleeve)
    table = stays.pivot(index=["stay", "harmonic"], columns="condition", values="frequency_Hz")
    for name, colour, marker in zip(names, (WARN, ACCENT, GOOD, INK), "os^D"):
        if all(case in table.columns for case, *_ in CASES):
            rows = table.loc[name]
            ratio.plot(rows.index, rows["with_sleeves"] / rows["without_sleeves"], color=colour, marker=marker, markersize=4, linewidth=1, label=name)
    ratio.axhline(1, color=PALE, linewidth=0.8)
    ratio.set_xlabel("harmonic")
    ratio.set_title("frequency with / without sleeves", loc="left", fontsize=9)
    ratio.legend(frameon=False, fontsize=8)
    width = 0.38
    for side, (case, label, colour) in zip((-0.5, 0.5), CASES):
        rows = stays[stays["condition"] == case]
        x = [names.index(n) * 6 + h + side * width for n, h in zip(rows["stay"], rows["harmonic"])]
        damping.bar(x, rows["damping_ratio_pct"], width, yerr=rows["damping_ratio_std_pct"], color=colour, error_kw={"elinewidth": 0.7, "ecolor": INK},
                    label=f"{label} sleeves")
    damping.set_xticks([6 * i + 3 for i in range(len(names))], names)
    damping.tick_params(bottom=False)
    damping.set_title("damping ratio (%), harmonics 1 to 5", loc="left", fontsize=9)
    damping.legend(frameon=False, fontsize=8)
    return figure, stays


def _sleeve(axes):
    axes.add_patch(Rectangle((-0.22, -1.0), 0.44, 6.4, facecolor="#d9dee5", edgecolor=INK, linewidth=1.0))
    for x in (-1.0, 0.9):
        axes.add_patch(Rectangle((x, 0.4), 0.1, 4.2, facecolor=INK, edgecolor=INK))
    for z, colour, label in ((0.45, GOOD, "damping rubber,\ntwo half rings"), (4.0, ACCENT, "Teflon,\ntwo half rings")):
        for x in (-0.9, 0.22):
            axes.add_patch(Rectangle((x, z), 0.68, 0.55, facecolor=colour, edgecolor=INK, linewidth=0.8))
        axes.text(1.2, z + 0.28, label, va="center", fontsize=8, color=colour)
    axes.text(1.2, 2.5, "sleeve", va="center", fontsize=8)
    axes.text(0.0, 5.5, "stay", ha="center", fontsize=8)
    axes.text(0.0, -1.5, "schematic", ha="center", color=ACCENT, fontsize=9)
    axes.set_xlim(-1.6, 3.6)
    axes.set_ylim(-1.7, 6.0)
    axes.set_aspect("equal")
    axes.set_axis_off()
