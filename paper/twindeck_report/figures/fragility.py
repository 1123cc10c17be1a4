"""Step 10: probabilities of comfort limits and of instability against the mean wind, with and without dampers, in the first and the last year."""
import math

import numpy as np
import pandas as pd

from ..study import Study
from .style import ACCENT, GOOD, INK, PALE, WARN, plt

NAME = "fragility"
CAPTION = ("Probability that an acceleration exceeds the comfort limit of step 8 within ten minutes, and that the bridge is unstable, given the mean wind. Solid: in the first year; "
           "dashed: in the last year that was computed, with the loss of section of the assumed corrosion. Bands of the comfort curves: 5 to 95 % over the "
           "random inputs of random.csv; a probability is the mean over them, so that it lies above its band where a few of them make all excursions. The bar on each curve of instability: 5 to 95 % of the critical speed. Curves end where the bridge is unstable or nearly so. "
           "All is conditional on the mean wind.")
NEEDS = ("s10_reliability",)
COLOURS = (INK, ACCENT, GOOD, WARN, "#5b3a8c")
WIDEST, THINNER = 2.4, 0.6  # line widths: a curve below another one of nearly the same values still shows
COMFORT = (("comfort_vertical", "vertical comfort"), ("comfort_lateral", "lateral comfort"))


def tables(study: Study):
    """(fragility, critical) of step 10 with a column `case` in words."""
    found = []
    for name in ("fragility", "critical"):
        table = study.step_csv(f"s10_reliability/{name}.csv", ["model", "years", "dampers", "fault"])
        table["case"] = [case_words(d, f) for d, f in zip(table["dampers"], table["fault"])]
        found.append(table)
    return found


def case_words(dampers, fault) -> str:
    if dampers == "off":
        return "without dampers"
    return "with dampers" if pd.isna(fault) or not fault else f"with dampers, {fault}"


def draw(study: Study):
    fragility, critical = tables(study)
    model = fragility[fragility["limit_state"] != "stability"]["model"]
    model = model.iloc[0] if len(model) else fragility["model"].iloc[0]
    years = sorted({fragility["years"].min(), fragility["years"].max()})
    cases = dict(zip(dict.fromkeys(fragility["case"]), COLOURS))
    figure, panels = plt.subplots(1, 3, figsize=(10.4, 3.9), sharey=True)
    figure.subplots_adjust(0.06, 0.24, 0.99, 0.92, wspace=0.08)
    for axes, (state, title) in zip(panels, COMFORT):
        for (case, year), rows in fragility[fragility["limit_state"] == state].groupby(["case", "years"], sort=False):
            if year in years:
                _curve(axes, rows, cases[case], year == years[0], WIDEST - list(cases).index(case) * THINNER)
        axes.set_title(title, loc="left")
    highest = max(fragility["speed_m_s"].max(), 1.0)
    drawn = [row for row in critical.to_dict("records") if row["model"] == model and row["years"] in years and not math.isnan(row["speed_m_s"])]
    reach = max([highest, *(1.15 * row["high_m_s"] for row in drawn)])
    for row in drawn:
        _instability(panels[2], row, cases[row["case"]], row["years"] == years[0], reach)
    stable = [case for case in cases if case not in {row["case"] for row in drawn}]
    if stable:
        panels[2].text(0.03, 0.93, "no followed mode loses its damping:\n" + "\n".join(stable), transform=panels[2].transAxes, fontsize=7, va="top", color="#5b6673")
    panels[2].set_title(f"instability, model {model}", loc="left")
    for axes in panels:
        axes.set_xlim(0, reach if axes is panels[2] else 1.05 * highest)
        axes.set_ylim(-0.02, 1.02)
        axes.set_xlabel("mean wind speed (m/s)")
    panels[0].set_ylabel("probability")
    handles = [plt.Line2D([], [], color=colour, label=case) for case, colour in cases.items()]
    handles += [plt.Line2D([], [], color=PALE, linestyle=style, label=f"year {year:g}") for year, style in zip(years, ("-", (0, (4, 3))))]
    figure.legend(handles=handles, ncols=len(handles), frameon=False, fontsize=8, loc="lower center")
    return figure, fragility[fragility["years"].isin(years)].drop(columns="case")


def _curve(axes, rows, colour, first, width):
    rows = rows.sort_values("speed_m_s")
    axes.plot(rows["speed_m_s"], rows["probability"], color=colour, marker=".", linewidth=max(width, 1.0), linestyle="-" if first else (0, (4, 3)), zorder=3)
    if first:
        axes.fill_between(rows["speed_m_s"], rows["low"], rows["high"], color=colour, alpha=0.14, linewidth=0)


def _instability(axes, row, colour, first, reach):
    speed = np.linspace(0.01, reach, 400)
    deviation = row["deviation_pct"] / 100.0
    distance = np.log(speed / row["speed_m_s"]) / max(deviation, 1e-9)
    axes.plot(speed, [0.5 * math.erfc(-d / math.sqrt(2.0)) for d in distance], color=colour, linewidth=1.4, linestyle="-" if first else (0, (4, 3)))
    axes.plot([row["low_m_s"], row["high_m_s"]], [0.5 if first else 0.45] * 2, color=colour, linewidth=3, alpha=0.3, solid_capstyle="butt")
