"""Complexity plots: the components of each identified shape as arrows in the complex plane. In a structure with little damping they lie
on one line."""
import html

import numpy as np
import pandas as pd

from ..study import Study

SIZE, REACH = 168, 62.0  # [px] of the view box, and of the longest arrow
STRAIGHT = 0.95  # phase collinearity from which on a shape counts as real, as in most guides to modal testing


def complexity(study: Study) -> list:
    """[{label, frequency, mpc, straight, svg}], one a mode; empty where step 3 wrote no complex shapes."""
    labels, shapes = identified_shapes(study)
    if not labels or not any(np.abs(np.nan_to_num(s).imag).max(initial=0.0) > 0.0 for s in shapes):
        return []
    frequency = study.step_csv("s3_identification/modes.csv", ["mode", "frequency_Hz"]).set_index("mode")["frequency_Hz"]
    names = _channels(study)
    found = []
    for label, shape in zip(labels, shapes):
        there = np.isfinite(shape)
        if there.sum() < 2:
            continue
        collinear = phase_collinearity(shape[there])
        found.append({"label": label, "frequency": float(frequency.get(int(label), np.nan)), "mpc": collinear, "straight": collinear >= STRAIGHT,
                      "svg": _plot(turned(shape[there]), [n for n, t in zip(names, there) if t], label)})
    return found


def identified_shapes(study: Study) -> tuple:
    """(labels of the modes, complex shapes over the channels; NaN where a mode has none), of the first condition."""
    name = "s3_identification/shapes.csv"
    if "s3_identification" not in study.steps() or not (study.results / name).is_file():
        return [], []
    table = study.step_csv(name, ["mode", "direction", "value"])
    imaginary = table["value_imag"].fillna(0.0) if "value_imag" in table else 0.0
    table = pd.DataFrame({"mode": table["mode"].astype(int), "channel": table["direction"].astype(str), "value": table["value"] + 1j * imaginary})
    channels = list(dict.fromkeys(table["channel"]))
    labels, shapes = [], []
    for mode, rows in table.groupby("mode"):
        values = dict(zip(rows["channel"], rows["value"]))
        labels.append(str(mode))
        shapes.append(np.array([values.get(c, np.nan) for c in channels], complex))
    return labels, shapes


def phase_collinearity(shape) -> float:
    """Modal phase collinearity ((l1 - l2) / (l1 + l2))^2 with the eigenvalues l of the 2 x 2 scatter of real and imaginary parts about zero:
    1 where all phases agree but for a sign, 0 where they are spread evenly. Pappa, Elliott and Schenk (1993)."""
    parts = np.column_stack([shape.real, shape.imag])
    low, high = np.linalg.eigvalsh(parts.T @ parts)
    return float(((high - low) / (high + low)) ** 2) if high + low > 0 else 0.0


def turned(shape):
    """The shape turned so that it lies along the real axis as well as it can, its largest component 1 long and to the right."""
    parts = np.column_stack([shape.real, shape.imag])
    axis = np.linalg.eigh(parts.T @ parts)[1][:, -1]
    out = shape * (axis[0] - 1j * axis[1])
    largest = out[np.abs(out).argmax()]
    return out / (abs(largest) or 1.0) * (1.0 if largest.real >= 0 else -1.0)


def _plot(shape, names: list, label: str) -> str:
    middle = SIZE / 2
    body = "".join(f'<circle class="ringed" cx="{middle}" cy="{middle}" r="{REACH * r:.0f}"/>' for r in (0.5, 1.0))
    body += f'<path class="grid" d="M{middle - REACH - 8:.0f} {middle}H{middle + REACH + 8:.0f}M{middle} {middle - REACH - 8:.0f}V{middle + REACH + 8:.0f}"/>'
    for value, name in sorted(zip(shape, names), key=lambda p: -abs(p[0])):
        x, y = middle + REACH * value.real, middle - REACH * value.imag
        body += (f'<g><title>{html.escape(name)}: {abs(value):.2f}, {np.degrees(np.angle(value)):.0f}°</title><path class="arm" d="M{middle} {middle}L{x:.1f} {y:.1f}"/>'
                 f'<circle class="tip" cx="{x:.1f}" cy="{y:.1f}" r="2.6"/></g>')
    return f'<svg viewBox="0 0 {SIZE} {SIZE}" width="{SIZE}" height="{SIZE}" role="img" aria-label="Complexity of mode {html.escape(label)}">{body}</svg>'


def _channels(study: Study) -> list:
    return list(dict.fromkeys(study.step_csv("s3_identification/shapes.csv", ["direction"])["direction"].astype(str)))
