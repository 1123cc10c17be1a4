"""What the updated model still gets wrong and where: residuals by row and the map of locations (step 9)."""
import json
import textwrap

import numpy as np
import pandas as pd

from ..page.diagnosis import residual_counts, verdict_in_words
from ..page.headline import in_runs
from ..page.heatmap import NAMES, label
from ..study import Study
from .style import ACCENT, INK, PALE, WARN, plt

NAME = "diagnosis"
CAPTION = ("Left: measured values against the model fitted within its bounds and, where causes are named, against the model with the causes in it, in standard "
           "deviations; open marks were held out; dashed: 2 standard deviations; values of modes that lie beyond 3 bear the mode's number. Right: where a change "
           "would explain most (score in standard deviations; not a verdict).")
NEEDS = ("s9_diagnosis",)
MOST = 10  # locations
FAR = 3.0  # standard deviations beyond which a value is named
LETTERS = 38  # of a line of a location's name


def draw(study: Study):
    rows = study.step_csv("s9_diagnosis/residuals.csv", ["type", "mode", "condition", "held_out", "residual_before", "residual_after"])
    path = study.results / "s9_diagnosis" / "diagnosis.json"
    study.used.add(path)
    told = json.loads(path.read_text(encoding="utf-8"))
    rows = rows.sort_values(["condition", "type"], kind="stable").reset_index(drop=True)
    sides = [("residual_before", PALE if told["effects"] else ACCENT, "model fitted within its bounds")]
    sides += [("residual_after", ACCENT, "model with the causes in it")] if told["effects"] else []
    blocks = [block for _, block in rows.fillna({"condition": ""}).groupby(["condition", "type"], sort=False)]
    places = told["localisation"][:MOST]

    figure, (left, right) = plt.subplots(1, 2, figsize=(11.4, max(3.6, 1.1 + 0.42 * max(len(blocks), len(places)))), width_ratios=(1.35, 1.0))
    _residuals(left, blocks, sides)
    right.barh(np.arange(len(places)), [place["score"] for place in places], color=ACCENT, height=0.6)
    right.set_yticks(np.arange(len(places)), [_name(place) for place in places], fontsize=7.5)
    right.invert_yaxis()
    right.set_xlabel("score (standard deviations)")
    right.set_title("where a change would explain most", loc="left")
    figure.suptitle(f"{verdict_in_words(told, residual_counts(study)[1])[1]}.", x=0.01, ha="left", fontsize=11)
    figure.tight_layout()
    return figure, rows


def _residuals(axes, blocks: list, sides: list) -> None:
    """One line a kind of value and condition; the models above one another."""
    for line, block in enumerate(blocks):
        for level, (column, colour, _) in enumerate(sides):
            y = line + (0.3 * level - 0.15 if len(sides) > 1 else 0.0)
            held = block["held_out"].to_numpy() == 1
            values = block[column].to_numpy(float)
            axes.scatter(values[~held], np.full((~held).sum(), y), s=14, color=colour, linewidth=0, zorder=3)
            axes.scatter(values[held], np.full(held.sum(), y), s=16, facecolors="none", edgecolors=colour, zorder=3)
            _name_far(axes, block, values, y, level)
        axes.axhline(line + 0.5, color="#edf0f4", linewidth=0.8)
    for limit in (-2, 2):
        axes.axvline(limit, color=WARN, linewidth=0.7, linestyle="--", zorder=1)
    axes.axvline(0.0, color=INK, linewidth=0.5, zorder=1)
    axes.set_yticks(range(len(blocks)), [_block(block) for block in blocks], fontsize=7.5)
    axes.set_ylim(len(blocks) - 0.5, -0.5)
    axes.set_xlabel("(measured - computed) / standard deviation")
    for column, colour, words in sides:
        axes.scatter([], [], s=14, color=colour, label=words)
    axes.legend(frameon=False, fontsize=8, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=len(sides), borderaxespad=0.0, handletextpad=0.1)


def _name_far(axes, block, values, y: float, level: int) -> None:
    """Shapes have a value a sensor: their modes would name many."""
    for mode, kind, value in zip(block["mode"], block["type"], values):
        if abs(value) > FAR and not kind.startswith("shape") and mode == mode:
            axes.annotate(label(mode), (value, y), xytext=(0, -8 if level else 4), textcoords="offset points", ha="center", fontsize=6.5)


def _block(block) -> str:
    kind, condition = block["type"].iloc[0], str(block["condition"].iloc[0]).replace("_", " ")
    return f"{NAMES.get(kind, kind.replace('_', ' '))} ({len(block)})" + (f"\n{condition}" if condition else "")


def _name(place: dict) -> str:
    """Where a person would look; what files call it only where there are no words."""
    words = place["words"] if isinstance(place.get("words"), str) and place["words"] else place["location"]
    name, at, coordinates = in_runs(words.replace("_", " ")).partition(" at x = ")
    return "\n".join(textwrap.fill(part, LETTERS) for part in (name, f"{at[1:]}{coordinates}") if part)
