"""Fig. 20: total damping as a function of the wind velocity, footbridge without dampers, orthogonal wind (model A)."""
from ..statements import design_speed
from ..study import Study
from .damping_curves import critical, damping, name_ends
from .style import INK, PALE, WARN, plt
from .wind import SYNTHETIC

NAME = "fig_20"
CAPTION = ("Total damping of the first modes over the wind velocity, without dampers, structural damping 0.5 %, wind orthogonal to the decks "
           "(model A). The paper reads instability of mode 1 at about 24 m/s; the level of the self-excited forces was fitted to 24.41 m/s. " + SYNTHETIC)
NEEDS = ("s7_aerodynamics",)
SHOWN_MODES = 6


def draw(study: Study):
    table = damping(study, "standin", "off")
    table = table[table["structural_damping_pct"] == table["structural_damping_pct"].min()]
    figure, axes = plt.subplots(figsize=(7.4, 4.2))
    figure.subplots_adjust(0.1, 0.12, 0.93, 0.95)
    ends, colours = {}, {}
    for mode, rows in table.groupby("mode"):
        if mode > SHOWN_MODES:
            continue
        first = mode == 1
        colour = WARN if first else plt.cm.Blues(0.4 + 0.1 * mode)
        axes.plot(rows["V_m_s"], rows["damping_ratio_pct"], color=colour, linewidth=2.0 if first else 1.2)
        ends[f"mode {mode}"], colours[f"mode {mode}"] = (rows["V_m_s"].iloc[-1], rows["damping_ratio_pct"].iloc[-1]), colour
    name_ends(axes, ends, colours, 0.17)
    axes.axhline(0, color=INK, linewidth=0.9)
    speed = critical(study, "standin")
    speed = speed[speed["model"] == "A"]["V_cr_m_s"].iloc[0]
    axes.plot([speed], [0], "o", color=WARN)
    axes.annotate(f"{speed:.2f} m/s (fitted)", (speed, 0), xytext=(8, 8), textcoords="offset points", color=WARN)
    design = design_speed(study)
    axes.axvline(design, color=PALE, linewidth=0.9, linestyle=(0, (4, 3)))
    axes.text(design + 0.2, axes.get_ylim()[1] * 0.94, "design wind", fontsize=8, color="#5b6673")
    axes.set_xlabel("wind velocity V (m/s)")
    axes.set_ylabel("total damping ξ (%)")
    return figure, table
