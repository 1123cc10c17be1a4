"""Fig. 1: the steps that lead from the preliminary to the updated model, with what each has read, from the manifests of the run."""
import pandas as pd
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch

from ..study import Study
from .flow import flow
from .style import ACCENT, GOOD, INK, PALE, WARN, plt

NAME = "fig_01"
CAPTION = ("Steps of the reproduction (the paper's Fig. 1), with the paper's step in a circle. An arrow says that a step has read files of another, as the "
           "manifest of its last run lists them; blue arrows go from one study to the other. Words on the right: how the run ended, and its seconds.")
NEEDS = ()

WIDTH, HEIGHT, GAP, APART = 4.6, 0.92, 0.42, 7.4
COLOUR = {"converged": GOOD, "unconverged": WARN, "not run": PALE}


def draw(study: Study):
    campaign = study.campaign()
    studies = [study] if campaign is study else [campaign, study]
    steps = {each.results.name: flow(each) for each in studies}
    order = sorted({s.token for found in steps.values() for s in found}, key=_number)
    tops = {token: -i * (HEIGHT + GAP) for i, token in enumerate(order)}
    depth = len(order) * (HEIGHT + GAP)
    figure, axes = plt.subplots(figsize=(1.2 + 4.6 * len(studies), 0.62 * depth + 0.5))
    rows = []
    for column, (each, (folder, found)) in enumerate(zip(studies, steps.items())):
        left = column * APART
        measured = each.read_toml(each.workflow / "study.toml").get("measured", "published")
        axes.text(left, 0.32, f"{measured} measurements", color=ACCENT, fontsize=10)
        for step in found:
            _box(axes, left, tops[step.token], step)
            for read in step.reads:
                _arrow(axes, left, tops[read], tops[step.token])
            for name, read in step.elsewhere:
                if name in steps and read in tops:
                    _across(axes, list(steps).index(name) * APART, tops[read], left, tops[step.token])
            # no seconds in the data: they would make other bytes of the same result
            rows.append({"study": folder, "step": step.token, "section": step.section, "paper_step": step.paper_step, "reads": " ".join(step.reads),
                         "reads_elsewhere": " ".join("/".join(pair) for pair in step.elsewhere), "status": step.status})
    axes.set_xlim(-1.5, (len(studies) - 1) * APART + WIDTH + 0.2)
    axes.set_ylim(-depth + GAP - 0.1, 0.65)
    axes.axis("off")
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.99)
    return figure, pd.DataFrame(rows)


def _number(token: str) -> int:
    """s10 comes after s9."""
    return int(token[1:].partition("_")[0])


def _box(axes, left, top, step):
    axes.add_patch(FancyBboxPatch((left, top - HEIGHT), WIDTH, HEIGHT, boxstyle="round,pad=0,rounding_size=0.1",
                                  facecolor="#f5f7fa", edgecolor=INK, linewidth=0.8))
    axes.add_patch(FancyBboxPatch((left, top - HEIGHT), 0.12, HEIGHT, boxstyle="round,pad=0,rounding_size=0.05",
                                  facecolor=COLOUR.get(step.status, WARN), edgecolor="none"))
    if step.paper_step:
        axes.text(left + 0.42, top - 0.24, step.paper_step, ha="center", va="center", fontsize=7.5, color=ACCENT,
                  bbox={"boxstyle": "circle,pad=0.2", "facecolor": "white", "edgecolor": ACCENT, "linewidth": 0.7})
    axes.text(left + 0.72, top - 0.24, step.token, weight="bold", va="center", fontsize=9)
    section = f"section {step.section}" if step.section[:1].isdigit() else step.section
    axes.text(left + WIDTH - 0.12, top - 0.24, section, ha="right", va="center", fontsize=7.5, color="#5b6673")
    axes.text(left + 0.3, top - 0.64, step.meaning, va="center", fontsize=8, linespacing=1.1)
    seconds = "" if step.seconds is None else f"{step.seconds:.1f} s"
    axes.text(left + WIDTH - 0.12, top - 0.66, f"{step.status}\n{seconds}".strip(), ha="right", va="center", fontsize=7.5,
              color=COLOUR.get(step.status, WARN) if step.status != "not run" else "#5b6673")


def _arrow(axes, left, from_top, to_top):
    """Straight down to the next box, around the boxes between otherwise; the further, the wider."""
    steps = round(abs(from_top - to_top) / (HEIGHT + GAP))
    if steps == 1:
        start, end, style = (left + WIDTH / 2, from_top - HEIGHT), (left + WIDTH / 2, to_top), "arc3"
    else:
        start, end, style = (left, from_top - 0.6 * HEIGHT), (left, to_top - 0.4 * HEIGHT), f"arc3,rad={0.55 / steps ** 0.5:.2f}"
    axes.add_patch(FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=9, color=INK, linewidth=0.8,
                                   connectionstyle=style, shrinkA=0, shrinkB=1))


def _across(axes, from_left, from_top, to_left, to_top):
    right = from_left < to_left
    start = (from_left + (WIDTH if right else 0.0), from_top - HEIGHT / 2)
    end = (to_left + (0.0 if right else WIDTH), to_top - HEIGHT / 2)
    axes.add_patch(FancyArrowPatch(start, end, arrowstyle="-|>", mutation_scale=9, color=ACCENT, linewidth=0.9, shrinkA=1, shrinkB=2))
