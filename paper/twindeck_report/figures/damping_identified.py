"""Mode 1's total damping with the structural damping that was identified instead of assumed, and with dampers."""
import pandas as pd

from ..statements import design_speed
from ..study import Study
from .damping_curves import damping, name_ends
from .style import ACCENT, GOOD, INK, PALE, WARN, plt
from .wind import SYNTHETIC

NAME = "damping_identified"
CAPTION = ("Left: total damping of mode 1 with the assumed 0.5 % and with the 1.10 % that was identified (Table 4, without dampers), with both "
           "aerodynamic sets: how far the instability moves depends on how h1* grows with the wind. Right: with the dampers, every followed "
           "mode of the stand-in set, green where it stays above 2 % and red where it does not; the paper states damping well above 2 % for each mode up to 40.4 m/s. Positions of the dampers are "
           "reconstructed. " + SYNTHETIC)
NEEDS = ("s7_aerodynamics",)
SETS = (("standin", "stand-in", (0, ())), ("quasi_steady", "quasi-steady", (0, (5, 3))))


def draw(study: Study):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.2))
    figure.subplots_adjust(0.07, 0.12, 0.98, 0.93, wspace=0.16)
    kept = []
    for name, label, style in SETS:
        table = damping(study, name, "off")
        table = table[table["mode"] == 1]
        for (structural, rows), colour in zip(table.groupby("structural_damping_pct"), (WARN, ACCENT)):
            left.plot(rows["V_m_s"], rows["damping_ratio_pct"], color=colour, linestyle=style, linewidth=1.5, label=f"{structural:.2f} %, {label}")
        kept.append(table)
    left.axhline(0, color=INK, linewidth=0.9)
    left.set_ylim(-3, 2)
    left.set_title("mode 1 without dampers", loc="left")
    left.legend(frameon=False, fontsize=8)
    damped = damping(study, "standin", "on")
    ends, colours = {}, {}
    for mode, rows in damped.groupby("mode"):
        above = rows["damping_ratio_pct"].min() >= 2.0
        right.plot(rows["V_m_s"], rows["damping_ratio_pct"], color=GOOD if above else WARN, linewidth=1.2)
        ends[str(mode)], colours[str(mode)] = (rows["V_m_s"].iloc[-1], rows["damping_ratio_pct"].iloc[-1]), GOOD if above else WARN
    kept.append(damped)
    name_ends(right, ends, colours, 0.22)
    right.axhline(2.0, color=INK, linewidth=0.9, linestyle=(0, (4, 3)))
    right.set_title("every followed mode with dampers", loc="left")
    for axes in (left, right):
        axes.axvline(design_speed(study), color=PALE, linewidth=0.9, linestyle=(0, (4, 3)))
        axes.annotate("design wind", (design_speed(study), 1.0), xycoords=("data", "axes fraction"), xytext=(3, -9), textcoords="offset points", fontsize=8, color="#5b6673")
        axes.set_xlabel("wind velocity V (m/s)")
    left.set_ylabel("total damping ξ (%)")
    return figure, pd.concat(kept, ignore_index=True)
