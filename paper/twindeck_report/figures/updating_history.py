"""How the updating went: cost and normalised parameters over the iterations of the best start, with the bounds."""
import numpy as np

from ..errors import InputError
from ..cells import truth
from ..study import Study
from .sensitivity_map import symbol
from .style import ACCENT, GOOD, INK, PALE, WARN, plt

NAME = "updating_history"
CAPTION = ("Cost (Eq. 5), radius of the trust region and length of the step, and parameters, divided by their initial values (by their ranges where those "
           "are 0), over the iterations of the best start. Grey: the bounds of section 4.2; red: parameters that end on one. Dashed lines: the prestress was computed anew.")
NEEDS = ("s6_updating",)


def best_start(study: Study) -> int:
    """The converged start of least cost (of all starts if none converged)."""
    starts = study.step_csv("s6_updating/starts.csv", ["start", "cost"])
    if "converged" in starts:
        converged = starts[starts["converged"].map(truth)]
        starts = converged if len(converged) else starts
    return int(starts.loc[starts["cost"].idxmin(), "start"])


def draw(study: Study):
    name = "s6_updating/history.csv"
    history = study.step_csv(name, ["start", "outer", "iteration", "cost", "step_norm", "trust_radius"])
    bounds = study.step_csv("s6_updating/parameters.csv", ["parameter", "initial_value", "lower", "upper", "bound"])
    start = best_start(study)
    rows = history[history["start"] == start].reset_index(drop=True)
    if rows.empty:
        raise InputError(f"{study.results / name}: no iteration of start {start}, the best one of starts.csv")
    lacking = [p for p in bounds["parameter"] if p not in rows.columns]
    if lacking:
        raise InputError(f"{study.results / name}: no column {lacking[0]}, a parameter of parameters.csv")
    count = np.arange(len(rows))
    renewed = [i - 0.5 for i in count[1:] if rows["outer"][i] != rows["outer"][i - 1]]

    n = len(bounds)
    columns = 3
    height = 2.2 + 1.45 * -(-n // columns)
    figure = plt.figure(figsize=(8.2, height))
    bottom = max(0.08, 0.45 / height)  # room for the words under the axes of a low figure
    grid = figure.add_gridspec(1 + -(-n // columns), columns, height_ratios=[1.5] + [1] * -(-n // columns), hspace=0.55,
                               wspace=0.3, left=0.09, right=0.92, top=0.95, bottom=bottom)
    cost = figure.add_subplot(grid[0, :])
    cost.plot(count, 1e3 * rows["cost"], color=ACCENT, marker="o", markersize=3.5, linewidth=1.2)
    cost.set_ylim(0.0, 1.1e3 * rows["cost"].max())
    cost.set_ylabel("cost F (10$^{-3}$)")
    cost.set_title(f"start {start}: {len(rows) - 1} iterations of the solver, {rows['outer'].nunique()} states of prestress", loc="right")
    _radius(cost, count, rows)
    _mark(cost, renewed)
    for i, row in enumerate(bounds.to_dict("records")):
        axes = figure.add_subplot(grid[1 + i // columns, i % columns], sharex=cost)
        _parameter(axes, count, rows[row["parameter"]], row)
        _mark(axes, renewed)
        if i >= n - columns:
            axes.set_xlabel("iteration")
    cost.xaxis.get_major_locator().set_params(integer=True)
    keep = ["start", "outer", "iteration", "cost", "step_norm", "trust_radius", *bounds["parameter"]]
    return figure, rows[keep]


def _radius(axes, count, rows):
    """Of the trust region, and the length of each step, on an axis of their own."""
    beside = axes.twinx()
    for column, words, style in (("trust_radius", "radius of the trust region", "-"), ("step_norm", "length of the step", (0, (1, 2)))):
        shown = rows[column] > 0
        beside.semilogy(count[shown], rows[column][shown], color=GOOD, linewidth=0.9, linestyle=style, label=words)
    beside.spines["right"].set_visible(True)
    beside.set_ylabel("radius, step", color=GOOD)
    beside.legend(frameon=False, fontsize=7, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.2)


def _parameter(axes, count, values, row):
    size = abs(row["initial_value"]) or row["upper"] - row["lower"]  # what history.csv divides by
    lower, upper = row["lower"] / size, row["upper"] / size
    on_bound = row["bound"] in ("lower", "upper")
    margin = 0.12 * (upper - lower)
    axes.set_ylim(lower - margin, upper + margin)
    axes.axhspan(lower - margin, lower, color=PALE, alpha=0.6, linewidth=0)
    axes.axhspan(upper, upper + margin, color=PALE, alpha=0.6, linewidth=0)
    axes.axhline(row["initial_value"] / size, color=PALE, linewidth=0.8)
    axes.plot(count, values, color=WARN if on_bound else INK, linewidth=1.3, marker="o", markersize=2.5, clip_on=False)
    axes.set_title(symbol(row["parameter"]) + (f"  on its {row['bound']} bound" if on_bound else ""), loc="left", fontsize=9,
                   color=WARN if on_bound else INK, pad=3)
    axes.tick_params(labelsize=7.5)


def _mark(axes, positions):
    for position in positions:
        axes.axvline(position, color=PALE, linewidth=0.8, linestyle=(0, (3, 3)))
