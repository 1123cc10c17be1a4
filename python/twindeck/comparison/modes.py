"""Modes of two runs: which belongs to which, what their frequencies and damping ratios did, and how alike their shapes are."""
import numpy as np  # pandas brings it
import pandas as pd

from ..results import StepResults
from .rows import as_number, larger, number_row

sure_mac = 0.7  # [-] from here on the shape decides: turned by 45 degrees among two close modes, a shape has 0.5 with each of them
least_mac = 0.5  # [-] below it two shapes share less than they differ in
alike_in_frequency = 0.02  # [-] modes left over by shape are one if their frequencies are this close: close modes turn within their plane


def mode_rows(a: StepResults, b: StepResults, notes: list) -> list:
    """Rows of each modes.csv that both runs of a step wrote: the step's own, and of step 3 those of further conditions."""
    part = "identified modes" if a.step == "s3_identification" else "modes"
    rows = []
    left, right = _tables_of_modes(a), _tables_of_modes(b)
    top, other_top = next(iter(left), ""), next(iter(right), "")
    if left and right and top not in right and other_top not in left:  # each run calls its first condition otherwise
        if top and other_top:
            notes.append(f"{a.step}: modes of condition {top} in A are held against those of {other_top} in B")
        right = {top: right.pop(other_top)} | right
    for condition, name in left.items():
        if condition in right:
            rows += _rows(part, a, b, (name, right[condition]), f" ({condition})" if condition != top else "", notes)
    for here, other, run in ((left, right, "A"), (right, left, "B")):
        notes += [f"{a.step}: modes of condition {condition or 'without a name'} stand in {run} alone" for condition in here if condition not in other]
    return rows


def _tables_of_modes(result: StepResults) -> dict:
    """{condition: table}: that of the step's own modes.csv first, whose condition step 3 names in poles.csv."""
    poles = result.table("poles") if "modes" in result and "poles" in result else {}
    first = str(poles["condition"].iloc[0]) if "condition" in poles and len(poles) else ""
    names = sorted(file[:-4] for file in result.manifest["outputs"] if file.startswith("conditions/") and file.endswith("/modes.csv"))
    return ({first: "modes"} if "modes" in result else {}) | {name.split("/")[1]: name for name in names}


def _rows(part, a, b, names, suffix, notes) -> list:
    left, right = (_by_mode(result.table(name)) for result, name in zip((a, b), names))
    pairs, likeness = _pairs(a, b, names, left, right, notes)
    rows = []
    for one, other in pairs:
        item = f"mode {one if one is not None else other}{suffix}"
        if one is not None and other is not None and one != other:
            item += f" (B: mode {other})"
        cells = left.get(one, {}), right.get(other, {})
        for column, std, unit in (("frequency_Hz", "frequency_std_Hz", "Hz"), ("damping_ratio_pct", "damping_ratio_std_pct", "%")):
            values = [as_number(c.get(column)) for c in cells]
            if any(v is not None for v in values):
                rows.append(number_row(part, a.step, item, column, unit, *values, larger(*(c.get(std) for c in cells))))
        if (one, other) in likeness:
            rows.append(number_row(part, a.step, item, "MAC with A's shape", "", 1.0, likeness[one, other]))
    return rows


def _by_mode(frame: pd.DataFrame) -> dict:
    return {str(cells["mode"]): cells for cells in frame.to_dict("records")}


def _pairs(a, b, names: tuple, left: dict, right: dict, notes: list) -> tuple:
    """[(mode of A, mode of B)] with None for no partner, and {pair: MAC}."""
    shapes = [name[: -len("modes")] + "shapes" for name in names]
    if all(a.manifest["outputs"].get(f"{one}.csv") == b.manifest["outputs"].get(f"{other}.csv") for one, other in (names, shapes)):
        return [(mode, mode) for mode in left], {(mode, mode): 1.0 for mode in left}  # the same bytes
    phi_a, phi_b = (_shapes(result.table(file), modes) if file in result else None for result, file, modes in zip((a, b), shapes, (left, right)))
    if phi_a is None or phi_b is None or set(phi_a.index) != set(phi_b.index):
        notes.append(f"{a.step}: modes are paired by their number, since the shapes of {names[0]}.csv are not given at the same points in both runs")
        return [(mode if mode in left else None, mode if mode in right else None) for mode in dict.fromkeys([*left, *right])], {}
    macs = mac(phi_a, phi_b.loc[phi_a.index])
    pairs = paired(macs, {m: float(c["frequency_Hz"]) for m, c in left.items()}, {m: float(c["frequency_Hz"]) for m, c in right.items()})
    return pairs, {pair: macs.at[pair] for pair in pairs if None not in pair}


def _shapes(frame: pd.DataFrame, modes: dict) -> "pd.DataFrame | None":
    """(points and directions x modes), complex where the table says so; None if a mode has no shape."""
    values = frame["value"].fillna(0.0).to_numpy(dtype=complex)
    if "value_imag" in frame.columns:
        values = values + 1j * frame["value_imag"].fillna(0.0).to_numpy()
    rows, places = pd.factorize(frame["point"].astype(str) + " " + frame["direction"].astype(str))
    columns, names = pd.factorize(frame["mode"].astype(str))
    if len(set(zip(rows, columns))) < len(values) or not set(modes) <= set(names):
        return None
    phi = np.zeros((len(places), len(names)), dtype=complex)
    phi[rows, columns] = values
    return pd.DataFrame(phi, index=places, columns=names)[list(modes)]


def mac(phi_a: pd.DataFrame, phi_b: pd.DataFrame) -> pd.DataFrame:
    """Modal assurance criterion (paper Eq. 2) of shapes in columns, rows alike in both: (modes of A x modes of B), 0 to 1."""
    one, other = phi_a.to_numpy(), phi_b.to_numpy()
    product = np.abs(one.conj().T @ other) ** 2
    norms = np.outer(np.sum(np.abs(one) ** 2, axis=0), np.sum(np.abs(other) ** 2, axis=0))
    return pd.DataFrame(product / np.where(norms > 0.0, norms, 1.0), index=phi_a.columns, columns=phi_b.columns)


def paired(macs: pd.DataFrame, frequency_a: dict, frequency_b: dict) -> list:
    """[(mode of A, mode of B)] one to one, in the order of A, then what only B has.

    First those whose shapes are surely alike, the best pair before the others: the largest MAC less the frequencies' relative distance, which
    decides where few sensors see two modes alike. Then, nearest frequencies first, what remains and has a MAC of at least `least_mac`
    or frequencies within `alike_in_frequency`.
    """
    def apart(one, other):
        f, g = abs(frequency_a[one]), abs(frequency_b[other])  # 0 of a rigid movement
        return abs(f - g) / max(f, g) if f != g else 0.0

    every = [(i, j) for i in frequency_a for j in frequency_b]
    surely = sorted((p for p in every if macs.at[p] >= sure_mac), key=lambda p: apart(*p) - macs.at[p])
    perhaps = sorted((p for p in every if macs.at[p] >= least_mac or apart(*p) <= alike_in_frequency), key=lambda p: apart(*p))
    partner, taken = {}, set()
    for one, other in surely + perhaps:
        if one not in partner and other not in taken:
            partner[one] = other
            taken.add(other)
    return [(one, partner.get(one)) for one in frequency_a] + [(None, other) for other in frequency_b if other not in taken]
