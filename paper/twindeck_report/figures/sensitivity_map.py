"""Sensitivity matrix of section 4.2 (Eq. 6) in relative form, with the parameters that were selected."""
import numpy as np

from ..errors import InputError
from ..study import Study
from ..cells import truth
from .style import ACCENT, INK, plt

NAME = "sensitivity_map"
CAPTION = ("Relative sensitivities d ln f / d ln p of the refined model's modes, exact derivatives. Parameters in blue were "
           "selected for updating; the bars show each parameter's score.")
NEEDS = ("s5_sensitivity",)


def draw(study: Study):
    name = "s5_sensitivity/sensitivity.csv"
    table = study.step_csv(name, ["mode", "parameter", "relative"])
    if table.duplicated(["mode", "parameter"]).any():
        raise InputError(f"{study.results / name}: a mode and parameter stand twice")
    selection = study.step_csv("s5_sensitivity/selection.csv", ["parameter", "score", "selected"]).set_index("parameter")
    matrix = table.pivot(index="mode", columns="parameter", values="relative")[list(dict.fromkeys(table["parameter"]))]
    values = matrix.to_numpy()
    chosen = [p in selection.index and truth(selection.at[p, "selected"]) for p in matrix.columns]
    limit = np.abs(values).max() or 1.0

    figure, (bars, axes) = plt.subplots(2, 1, figsize=(7.6, 6.8), sharex=True, height_ratios=(1, 5.2))
    scores = [selection["score"].get(p, np.nan) for p in matrix.columns]
    bars.bar(range(len(scores)), scores, color=[ACCENT if c else "#9aa4af" for c in chosen], width=0.7)
    bars.set_ylabel("score")
    bars.tick_params(bottom=False)
    picture = axes.pcolormesh(np.arange(values.shape[1] + 1) - 0.5, np.arange(values.shape[0] + 1) - 0.5, values, cmap="RdBu_r",
                              vmin=-limit, vmax=limit, edgecolors="white", linewidth=0.6)
    for i, j in np.ndindex(*values.shape):
        if abs(values[i, j]) >= 0.05 * limit:
            axes.text(j, i, _two_digits(values[i, j]), ha="center", va="center", fontsize=6,
                      color="white" if abs(values[i, j]) > 0.6 * limit else INK)
    axes.set_xticks(range(values.shape[1]), [symbol(p) for p in matrix.columns], rotation=40, ha="right",
                    rotation_mode="anchor")
    for label, is_chosen in zip(axes.get_xticklabels(), chosen):
        label.set(color=ACCENT if is_chosen else "#6b7580", fontweight="bold" if is_chosen else "normal")
    axes.set_yticks(range(values.shape[0]), [f"{m}N" for m in matrix.index])
    axes.set_ylabel("mode")
    axes.invert_yaxis()
    axes.spines[["left", "bottom"]].set_visible(False)
    axes.tick_params(length=0)
    figure.subplots_adjust(0.08, 0.13, 0.9, 0.98, hspace=0.05)
    colours = figure.add_axes((0.92, 0.13, 0.018, 0.68))
    figure.colorbar(picture, cax=colours).outline.set_visible(False)
    colours.set_title("d ln f /\nd ln p", fontsize=8)
    data = table[["mode", "parameter", "relative"]].assign(selected=[int(chosen[list(matrix.columns).index(p)])
                                                                      for p in table["parameter"]])
    return figure, data


def _two_digits(value):
    """0.31 -> .31: the cell is narrow."""
    return f"{value:.2f}".replace("0.", ".", 1)


def symbol(parameter):
    """E_s_stay_44 -> $E_{s,stay,44}$, rho_1 -> $\\rho_{1}$."""
    letter, _, rest = parameter.partition("_")
    letter = {"rho": r"\rho"}.get(letter, letter)
    return f"${letter}_{{\\mathrm{{{rest.replace('_', ',')}}}}}$" if rest else f"${letter}$"
