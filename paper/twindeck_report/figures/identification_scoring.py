"""How good the identification is over many virtual campaigns, as the slow test scored them; says so where it has not been run."""
import numpy as np
import pandas as pd

from ..study import Study
from .style import ACCENT, INK, PALE, plt

NAME = "identification_scoring"
CAPTION = ("Virtual campaigns of other seeds, none of which a setting was made with, against their truth. Left: errors of frequency and damping "
           "of the named modes in their own standard deviations; they should follow the curve, with a standard deviation between 0.8 and 1.25. "
           "Right: named modes found (frequency within the larger of 0.5 % and three standard deviations, damping within three, shape its own) and "
           "others below 2.6 Hz that no true mode explains, by the automatic rule and by the paper's. Scored by the slow test of step 3, which the "
           "study itself does not run; the panels say how many campaigns are in.")
NEEDS = ("s3_identification",)
FOLDER = "scoring"  # beside the study's results: written by tests/steps/test_table_4.py with TWINDECK_SLOW=1
NOT_RUN = "not run: TWINDECK_SLOW=1 tests/steps/test_table_4.py scores 30 campaigns"
STATES = (("without_dampers", "without dampers"), ("with_dampers", "with dampers"))
RULES = (("automatic", ACCENT), ("paper", PALE))


def tables(study: Study):
    """(errors, recall) of the campaigns scored so far, None where there are none."""
    folder = study.results.parent / FOLDER
    if not all((folder / f"identification_{name}.csv").is_file() for name in ("errors", "recall")):
        return None
    return (study.read_csv(folder / "identification_errors.csv", ["seed", "state", "mode", "frequency_error", "damping_error"]),
            study.read_csv(folder / "identification_recall.csv", ["seed", "state", "selection", "named", "found", "spurious"]))


def draw(study: Study):
    scored = tables(study)
    if scored is None:
        figure, axes = plt.subplots(figsize=(10.4, 1.0))
        axes.axis("off")
        axes.text(0.5, 0.5, NOT_RUN, ha="center", va="center", color=INK)
        return figure, pd.DataFrame({"state": [], "mode": [], "frequency_error": [], "damping_error": []})
    errors, recall = scored
    figure, axes = plt.subplots(1, 3, figsize=(10.4, 3.4), gridspec_kw={"width_ratios": [1, 1, 1.1]})
    figure.subplots_adjust(0.06, 0.2, 0.99, 0.9, wspace=0.22)
    x = np.linspace(-4, 4, 200)
    for place, what in zip(axes, ("frequency", "damping")):
        own = errors[f"{what}_error"].to_numpy(float)
        place.hist(np.clip(own, -4, 4), bins=np.arange(-4, 4.1, 0.4), density=True, color=PALE)
        place.plot(x, np.exp(-x**2 / 2) / np.sqrt(2 * np.pi), color=ACCENT)
        place.set_title(f"{what}: {len(own)} errors, standard deviation {own.std():.2f}", loc="left")
        place.set_xlabel("error / standard deviation")
    _recall(axes[2], recall)
    return figure, errors


def _recall(axes, recall):
    labels = []
    for group, (state, words) in enumerate(STATES):
        for side, (rule, colour) in enumerate(RULES):
            rows = recall[(recall["state"] == state) & (recall["selection"] == rule)]
            if len(rows):
                place = 3.4 * group + 1.4 * side
                axes.bar(place, rows["found"].mean(), color=colour, width=0.8)
                axes.text(place, rows["found"].mean() + 0.1, f"{rows['found'].mean():.2f} of {rows['named'].iloc[0]}\n+ {rows['spurious'].mean():.2f}",
                          ha="center", va="bottom", fontsize=8)
                labels.append((place, rule))
        axes.text(3.4 * group + 0.7, -1.9, words, ha="center", va="top")
    axes.set_xticks([place for place, _ in labels], [label for _, label in labels])
    axes.set_ylim(0, 12.5)
    axes.set_title(f"found + unexplained, mean of {recall['seed'].nunique()} campaigns", loc="left")
