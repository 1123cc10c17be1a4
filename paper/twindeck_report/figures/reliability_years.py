"""Step 10: which input the critical speed hangs on, and what the years make of critical speeds and frequencies."""
import numpy as np

from ..study import Study
from .sensitivity_map import symbol
from .style import ACCENT, INK, PALE, WARN, plt

NAME = "reliability_years"
CAPTION = ("Left: share of each random input in the variance of the critical speed (FORM's importance factors), by model of Table 11, without dampers, in the first year. "
           "Middle: critical speed in each year that was computed, with its 5 to 95 % interval. Right: change of the first frequencies from the first year to the last, at the medians of all inputs. "
           "Rates of corrosion are assumed.")
NEEDS = ("s10_reliability",)
LEAST_SHARE = 0.005  # [-] inputs of less are left out of the bars


def draw(study: Study):
    importance = study.step_csv("s10_reliability/importance.csv", ["model", "years", "dampers", "input", "importance"])
    years = study.step_csv("s10_reliability/years.csv", ["years", "dampers", "quantity", "place", "value", "low", "high"])
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10.4, 3.9))
    figure.subplots_adjust(0.15, 0.23, 0.99, 0.92, wspace=0.28)
    first = importance[(importance["years"] == importance["years"].min()) & (importance["dampers"] == "off")]
    shares = first.pivot_table(index="input", columns="model", values="importance", sort=False)
    shares = shares[shares.max(axis=1) > LEAST_SHARE] if len(shares) else shares
    for k, model in enumerate(shares.columns):
        left.barh(np.arange(len(shares)) + 0.8 * (k + 0.5) / len(shares.columns) - 0.4, shares[model], 0.8 / len(shares.columns) * 0.9,
                  color=_colour(k, len(shares.columns)), label=model)
    left.set_yticks(range(len(shares)), [symbol(name.removeprefix("parameter:")) if name.startswith("parameter:") else name.replace("_", " ") for name in shares.index])
    left.invert_yaxis()
    left.set_xlabel("share of the variance of ln $V_{cr}$")
    if len(shares):
        left.legend(frameon=False, fontsize=7, title="model", title_fontsize=7)
    left.set_title("importance", loc="left")
    speeds = years[(years["quantity"] == "critical_speed") & (years["dampers"] == "off")]
    spread = 0.012 * max(years["years"].max(), 1.0)
    for k, (place, rows) in enumerate(speeds.groupby("place", sort=False)):
        x = rows["years"] + spread * (k - (speeds["place"].nunique() - 1) / 2)
        middle.errorbar(x, rows["value"], [rows["value"] - rows["low"], rows["high"] - rows["value"]], color=_colour(k, speeds["place"].nunique()), marker="o", markersize=3, capsize=2, linewidth=1.2, label=place)
    middle.set_xlabel("years in service")
    middle.set_ylabel("critical speed (m/s)")
    if len(speeds):
        middle.legend(frameon=False, fontsize=7, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=4, columnspacing=1.0, handlelength=1.2)
    middle.set_title("without dampers", loc="left")
    modes = years[years["quantity"] == "frequency"].pivot_table(index="place", columns="years", values="value", sort=False)
    change = 100.0 * (modes[modes.columns.max()] / modes[modes.columns.min()] - 1.0)
    right.bar(range(len(change)), change, color=ACCENT, width=0.7)
    right.axhline(0, color=INK, linewidth=0.9)
    right.set_xticks(range(len(change)), [place.replace("mode ", "") for place in change.index])
    right.set_xlabel("mode")
    right.set_ylabel(f"change of frequency to year {modes.columns.max():g} (%)")
    right.grid(axis="y", color=PALE, linewidth=0.5)
    return figure, years


def _colour(k: int, count: int):
    """The same for a model in both panels; the first one, which the limits are of, is red."""
    return WARN if k == 0 else plt.cm.Blues(0.35 + 0.6 * k / max(count - 1, 1))
