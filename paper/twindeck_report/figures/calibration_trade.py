"""The trade of the reconstruction: frequencies against cable forces against masses, one row a trial of calibration.toml."""
import numpy as np

from ..study import Study
from .style import ACCENT, INK, PALE, WARN, plt

NAME = "calibration_trade"
CAPTION = ("Fits of the bridge's unknown sizes to frequencies alone and to frequencies, cable forces, masses per metre and the displacement of "
           "the anchors, in several forms of the truss (rows: trials of calibration.toml). Dashed: what was aimed at; grey: the stated "
           "ranges of mass. Rows are of the quick mesh unless they name another. Forces and masses are those of the variant refined; a force is judged by the site's control sheet.")
NEEDS = ("calibration_trade.csv",)

RMS_AIM_PCT, FORCE_AIM_PCT, EDGE_AIM = 2.5, 10.0, 5  # stated before the fits
DECKS = (("foot deck", "refined_foot_deck_kg_m", INK, "o"), ("cycle deck", "refined_cycle_deck_kg_m", ACCENT, "s"))


def draw(study: Study):
    rows = study.read_csv(study.data / "calibration_trade.csv",
                          ["trial", "form", "mesh", "preliminary_rms_pct", "refined_rms_pct", "force_worst_pct", "values_on_edge",
                           *(column for _, column, _, _ in DECKS)])
    ranges = {mass["name"]: mass for mass in study.read_toml(study.data / "calibration.toml")["mass"]}
    at = np.arange(len(rows))[::-1]
    figure, axes = plt.subplots(1, 4, figsize=(8.4, 1.3 + 0.32 * len(rows)), sharey=True, gridspec_kw={"width_ratios": [3, 3, 3, 2]})
    frequencies, forces, masses, edges = axes
    for column, label, colour, marker in (("preliminary_rms_pct", "Table 2", INK, "o"), ("refined_rms_pct", "Table 7", ACCENT, "s")):
        frequencies.plot(rows[column], at, marker, color=colour, markersize=5, linestyle="none", label=label)
    frequencies.set_xlabel("rms of frequencies (%)")
    forces.plot(rows["force_worst_pct"].abs(), at, "D", color=INK, markersize=5, linestyle="none")
    forces.set_xlabel("worst cable force (%)")
    for name, column, colour, marker in DECKS:
        masses.plot(rows[column], at, marker, color=colour, markersize=5, linestyle="none", label=name)
        masses.axvspan(ranges[name]["lower_kg_m"], ranges[name]["upper_kg_m"], color=PALE, alpha=0.3, linewidth=0)
    masses.set_xlabel("mass (kg/m)")
    edges.plot(rows["values_on_edge"], at, "D", color=INK, markersize=5, linestyle="none")
    edges.set_xlabel("values on an edge")
    for axis, aim in ((frequencies, RMS_AIM_PCT), (forces, FORCE_AIM_PCT), (edges, EDGE_AIM)):
        axis.axvline(aim, color=WARN, linewidth=0.9, linestyle=(0, (4, 3)))
        axis.margins(x=0.12)
        axis.set_xlim(left=0.0)
    for axis in axes:
        axis.grid(axis="y", color=PALE, linewidth=0.5)
        axis.tick_params(labelsize=8)
    for axis in (frequencies, masses):
        axis.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2, frameon=False, fontsize=7.5, handletextpad=0.2)
    frequencies.set_yticks(at, [f"{row.trial} ({row.mesh} mesh)" if row.mesh != "quick" else row.trial for row in rows.itertuples()])
    frequencies.set_ylim(-0.6, len(rows) - 0.4)
    figure.tight_layout()
    return figure, rows
