"""Fig. 19: flutter derivative h1* over the reduced velocity and static coefficients over the angle of attack, foot deck."""
import pandas as pd

from ..errors import InputError
from ..study import Study
from .style import ACCENT, GOOD, INK, PALE, WARN, plt
from .wind import SYNTHETIC

NAME = "fig_19"
CAPTION = ("(a) Flutter derivative h1* of the foot deck over V/(fB) at several mean angles of attack; (b) static coefficients. " + SYNTHETIC
           + " As in the paper h1* is negative at realistic angles and C_L falls near the origin; the steep fall of h1* is what the order of "
           "Table 12 demands. Dashed: the quasi-steady set, whose lift slope is its own. Both at the level fitted to row A of Table 12.")
NEEDS = ("s7_aerodynamics",)
DECK = "foot"


def draw(study: Study):
    h1 = study.step_csv("s7_aerodynamics/galloping.csv", ["set", "deck", "angle_of_attack_deg", "V_over_fB", "h1", "den_hartog"])
    polar = study.step_csv("s7_aerodynamics/polars.csv", ["set", "deck", "angle_of_attack_deg", "C_D", "C_L", "C_M"])
    if not (h1["deck"] == DECK).any():
        raise InputError(f"{study.results / 's7_aerodynamics/galloping.csv'}: no deck {DECK}")
    h1, polar = h1[h1["deck"] == DECK], polar[polar["deck"] == DECK]
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.0))
    figure.subplots_adjust(0.07, 0.13, 0.98, 0.93, wspace=0.18)
    angles = sorted(h1["angle_of_attack_deg"].unique())
    curves = {}  # one a curve: angles whose values are the same share it
    for angle in angles:
        rows = h1[(h1["set"] == "standin") & (h1["angle_of_attack_deg"] == angle)]
        curves.setdefault(tuple(rows["h1"]), []).append((angle, rows["V_over_fB"]))
    for i, (values, shared) in enumerate(sorted(curves.items(), key=lambda c: max(abs(a) for a, _ in c[1]))):
        left.plot(shared[0][1], values, color=plt.cm.viridis(i / max(1, len(curves) - 1) * 0.9), linewidth=1.4,
                  label="α = " + " and ".join(f"{angle:+.0f}°".replace("+0", "0") for angle, _ in shared))
    steady = h1[(h1["set"] == "quasi_steady") & (h1["angle_of_attack_deg"] == 0)]
    left.plot(steady["V_over_fB"], steady["h1"], color=INK, linewidth=1.0, linestyle=(0, (5, 3)), label="quasi-steady, α = 0°")
    left.axhline(0, color=PALE, linewidth=0.8)
    left.set_xlabel("V/(fB)")
    left.set_ylabel("h1*")
    left.set_title("(a)", loc="left")
    left.legend(frameon=False, fontsize=8)
    main = polar[polar["set"] == "standin"]
    for column, colour in (("C_D", GOOD), ("C_L", ACCENT), ("C_M", WARN)):
        right.plot(main["angle_of_attack_deg"], main[column], color=colour, linewidth=1.4, label=column)
    right.axhline(0, color=PALE, linewidth=0.8)
    right.axvline(0, color=PALE, linewidth=0.8)
    right.set_xlabel("angle of attack (degrees)")
    right.set_title("(b)", loc="left")
    right.legend(frameon=False, fontsize=8)
    right.text(0.98, 0.03, "synthetic", transform=right.transAxes, ha="right", color="#5b6673", fontsize=8)
    left.text(0.98, 0.9, "synthetic", transform=left.transAxes, ha="right", va="top", color="#5b6673", fontsize=8)
    return figure, pd.concat([h1, polar], ignore_index=True)
