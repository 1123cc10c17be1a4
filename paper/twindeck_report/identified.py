"""Modes that s3_identification found, by condition, and which of them are the rows of Table 4."""
import numpy as np
import pandas as pd

from .study import Study

STEP = "s3_identification"
WITHOUT, WITH = "without_dampers", "with_dampers"
NEAR = 0.03  # relative: a found mode further from a printed frequency is not that row
LEAST_MAC = 0.3
EQUALLY = 0.1  # MAC within which two modes count as equally like a row


def folder_of(condition: str) -> str:
    """The first condition's files lie at the top, those of the others below conditions/."""
    return STEP if condition == WITHOUT else f"{STEP}/conditions/{condition}"


def modes_of(study: Study, condition: str) -> pd.DataFrame:
    return study.step_csv(f"{folder_of(condition)}/modes.csv",
                          ["mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"]).set_index("mode")


def shapes_of(study: Study, condition: str) -> pd.DataFrame:
    """Complex components: rows channels, columns modes; NaN where a mode is not known."""
    table = study.step_csv(f"{folder_of(condition)}/shapes.csv", ["mode", "point", "direction", "value"])
    table["imaginary"] = table["value_imag"].fillna(0.0) if "value_imag" in table.columns else 0.0
    parts = [table.pivot(index="direction", columns="mode", values=part) for part in ("value", "imaginary")]
    return parts[0] + 1j * parts[1]


def mac(a: pd.Series, b: pd.Series) -> float:
    """Over the channels that both have."""
    both = a.notna() & b.reindex(a.index).notna()
    p, q = a[both].to_numpy(complex), b.reindex(a.index)[both].to_numpy(complex)
    norms = np.vdot(p, p).real * np.vdot(q, q).real
    return abs(np.vdot(p, q)) ** 2 / norms if norms > 0 else 0.0


def without_dampers(study: Study) -> dict:
    """{row of Table 4: found mode}: the nearest in frequency, one each, the nearest pair first."""
    found = modes_of(study, WITHOUT)["frequency_Hz"]
    printed = study.paper_table(4)
    distance = {(int(row), mode): abs(f / float(text) - 1.0) for row, text in zip(printed["mode"], printed["f_X_without_dampers_Hz"])
                for mode, f in found.items()}
    return _assign(distance, NEAR)


def with_dampers(study: Study) -> dict:
    """{row of Table 4: found mode}: the one whose shape is most like the row's shape without dampers. A deck's motion that two modes share,
    one of them mostly a stay's, has nearly the same shape in both: of modes equally like it the one that moves the channels more."""
    rows = without_dampers(study)
    before, after = shapes_of(study, WITHOUT), shapes_of(study, WITH)
    levels = study.step_csv(f"{STEP}/amplitude.csv", ["source", "condition", "mode", "amplitude"])
    levels = levels[(levels["source"] == "ambient") & (levels["condition"] == WITH)]
    amplitude = {int(mode): float(a) for mode, a in zip(levels["mode"], levels["amplitude"])}
    distance = {}
    for row, name in rows.items():
        likeness = {mode: mac(before[name], after[mode]) for mode in after.columns}
        most = max(likeness.values(), default=0.0)
        alike = [mode for mode, value in likeness.items() if value >= most - EQUALLY]
        largest = max((amplitude.get(int(mode), 0.0) for mode in alike), default=0.0)
        for mode, value in likeness.items():
            weaker = mode in alike and amplitude.get(int(mode), 0.0) < largest
            distance[row, mode] = 1.0 - value + (EQUALLY if weaker else 0.0)
    return _assign(distance, 1.0 - LEAST_MAC)


def _assign(distance: dict, limit: float) -> dict:
    out = {}
    for (row, mode), value in sorted(distance.items(), key=lambda entry: (entry[1], entry[0])):
        if value <= limit and row not in out and mode not in out.values():
            out[row] = mode
    return dict(sorted(out.items()))
