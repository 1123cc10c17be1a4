"""Fig. 1: the steps that lead from the preliminary to the updated model, as the study declares them."""
import pandas as pd
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch

from ..study import Study
from .flow import flow
from .style import ACCENT, GOOD, INK, PALE, WARN, plt

NAME = "fig_01"
CAPTION = ("Steps of the reproduction (the paper's Fig. 1). Boxes are the declared steps with status and seconds of their last "
           "run; arrows say which results a step reads. Measured frequencies enter as published.")
NEEDS = ()

WIDTH, HEIGHT, GAP = 4.6, 0.92, 0.5
COLOUR = {"converged": GOOD, "unconverged": WARN, "not run": PALE}


def draw(study: Study):
    steps = flow(study)
    tops = {s.token: -i * (HEIGHT + GAP) for i, s in enumerate(steps)}
    depth = len(steps) * (HEIGHT + GAP)
    figure, axes = plt.subplots(figsize=(6.4, 0.62 * depth + 0.5))
    for step in steps:
        _box(axes, 0.0, tops[step.token], step)
        for read in step.reads:
            _arrow(axes, tops[read], tops[step.token])
    measured = study.read_toml(study.workflow / "study.toml").get("measured", "published")
    readers = [s.token for s in steps if s.token in ("s4_refinement", "s6_updating")]
    if readers:
        _measured(axes, f"{measured} frequencies", [tops[r] for r in readers])
    axes.set_xlim(-0.75, 7.9)
    axes.set_ylim(-depth + GAP - 0.1, 0.15)
    axes.axis("off")
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.99)
    # no seconds in the data: they would make other bytes of the same result
    data = pd.DataFrame([{"step": s.token, "section": s.section, "reads": " ".join(s.reads), "status": s.status}
                         for s in steps])
    return figure, data


def _box(axes, left, top, step):
    axes.add_patch(FancyBboxPatch((left, top - HEIGHT), WIDTH, HEIGHT, boxstyle="round,pad=0,rounding_size=0.1",
                                  facecolor="#f5f7fa", edgecolor=INK, linewidth=0.8))
    axes.add_patch(FancyBboxPatch((left, top - HEIGHT), 0.12, HEIGHT, boxstyle="round,pad=0,rounding_size=0.05",
                                  facecolor=COLOUR.get(step.status, WARN), edgecolor="none"))
    axes.text(left + 0.3, top - 0.24, step.token, weight="bold", va="center", fontsize=9)
    section = f"section {step.section}" if step.section[:1].isdigit() else step.section
    axes.text(left + WIDTH - 0.12, top - 0.24, section, ha="right", va="center", fontsize=7.5, color="#5b6673")
    axes.text(left + 0.3, top - 0.62, step.meaning, va="center", fontsize=8, linespacing=1.1)
    seconds = "" if step.seconds is None else f"{step.seconds:.1f} s"
    axes.text(left + WIDTH - 0.12, top - 0.66, f"{step.status}\n{seconds}".strip(), ha="right", va="center", fontsize=7.5,
              color=COLOUR.get(step.status, WARN) if step.status != "not run" else "#5b6673")


def _arrow(axes, from_top, to_top):
    """Straight down to the next box, around the boxes between otherwise."""
    if abs(from_top - to_top) < HEIGHT + GAP + 0.01:
        start, end, style = (WIDTH / 2, from_top - HEIGHT), (WIDTH / 2, to_top), "arc3"
    else:
        start, end, style = (0.0, from_top - 0.6 * HEIGHT), (0.0, to_top - 0.4 * HEIGHT), "arc3,rad=0.28"
    axes.add_patch(FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=10, color=INK, linewidth=0.9,
                                   connectionstyle=style, shrinkA=0, shrinkB=1))


def _measured(axes, text, tops):
    middle = sum(tops) / len(tops) - HEIGHT / 2
    axes.text(6.75, middle, text.replace(" ", "\n"), ha="center", va="center", fontsize=8.5, color=ACCENT,
              bbox={"boxstyle": "round,pad=0.45", "facecolor": "white", "edgecolor": ACCENT})
    for top in tops:
        axes.add_patch(FancyArrowPatch((6.05, middle), (WIDTH, top - HEIGHT / 2), arrowstyle="-|>", mutation_scale=10,
                                       color=ACCENT, linewidth=0.9, shrinkA=2, shrinkB=1))
