"""What the updated model still gets wrong and where: residuals by row and the map of locations (step 9)."""
import json
import textwrap

import numpy as np
import pandas as pd

from ..study import Study
from .style import ACCENT, PALE, WARN, plt

NAME = "diagnosis"
CAPTION = ("Left: measured rows against the model fitted within its bounds, in standard deviations, before and after the extension; open "
           "marks were held out. Right: where a change would explain most (score in standard deviations; not a verdict).")
NEEDS = ("s9_diagnosis",)
MOST = 14


def draw(study: Study):
    rows = study.step_csv("s9_diagnosis/residuals.csv", ["type", "mode", "condition", "held_out", "residual_before", "residual_after"])
    path = study.results / "s9_diagnosis" / "diagnosis.json"
    study.used.add(path)
    result = json.loads(path.read_text(encoding="utf-8"))
    places = pd.DataFrame(result["localisation"][:MOST], columns=["location", "score", "words"])
    rows = rows.sort_values(["condition", "type"], kind="stable").reset_index(drop=True)

    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.4), width_ratios=(1.3, 1.0))
    x = np.arange(len(rows))
    held = rows["held_out"].to_numpy() == 1
    for column, colour, label in (("residual_before", PALE, "before"), ("residual_after", ACCENT, "after")):
        values = rows[column].to_numpy()
        left.scatter(x[~held], values[~held], s=14, color=colour, label=label, zorder=2)
        left.scatter(x[held], values[held], s=20, facecolors="none", edgecolors=colour, zorder=2)
    for limit in (-2, 2):
        left.axhline(limit, color=WARN, linewidth=0.7, linestyle="--")
    left.axhline(0.0, color="black", linewidth=0.5)
    if len(rows) <= 20:
        left.set_xticks(x, [f"{m}" for m in rows["mode"]])
        left.set_xlabel("mode")
    else:
        _blocks(left, rows)
    left.set_ylabel("(measured - computed) / deviation")
    left.legend(frameon=False, fontsize=8, loc="lower left")
    right.barh(np.arange(len(places)), places["score"], color=ACCENT)
    right.set_yticks(np.arange(len(places)), [_name(place) for place in places.to_dict("records")], fontsize=7)
    right.invert_yaxis()
    right.set_xlabel("score")
    right.set_title(f"verdict: {result['verdict']}", loc="left")
    figure.tight_layout()
    return figure, rows


def _name(place: dict) -> str:
    """Where a person would look, and what files call it."""
    words = place["words"] if isinstance(place["words"], str) else ""
    return textwrap.shorten(words, 44, placeholder=" …") + f"\n{place['location']}" if words and words != place["location"] else place["location"]


def _blocks(axes, rows) -> None:
    """Rows of one condition and type stand together, their name below their middle."""
    block = (rows[["condition", "type"]] != rows[["condition", "type"]].shift()).any(axis=1).cumsum()
    ticks, names = [], []
    for _, own in rows.groupby(block):
        axes.axvline(own.index[0] - 0.5, color=PALE, linewidth=0.6)
        ticks.append((own.index[0] + own.index[-1]) / 2)
        names.append(f"{own['condition'].iloc[0]}, {own['type'].iloc[0]}".replace("_", " "))
    axes.set_xticks(ticks, names, fontsize=7, rotation=20, ha="right")
