"""One row of a comparison: the same quantity in both runs, and what became of it."""
import math
import re

COLUMNS = ["part", "step", "item", "quantity", "unit", "a", "b", "change", "change_pct", "std", "change_in_std", "status"]
SAME, MOVED, DIFFERS, ONLY_A, ONLY_B = "same", "moved", "differs", "only in A", "only in B"

same_relative = 1e-6  # [-] numbers this close count as equal: far below what is measured, above what threads and libraries round
same_absolute = 1e-6  # [-, %] the same of ratios and percentages, which may be zero


def number_row(part, step, item, quantity, unit, a, b, std=None) -> dict:
    """A number of both runs; None where a run does not have it.

    `std` is the standard deviation that the change is held against: the larger of the two runs', since both often rest on the same records.
    """
    row = dict.fromkeys(COLUMNS) | {"part": part, "step": step, "item": item, "quantity": quantity, "unit": unit, "a": a, "b": b}
    if a is None or b is None:
        numbers = {"a": math.nan if a is None else a, "b": math.nan if b is None else b}  # NaN, so that a column of numbers stays one
        return row | numbers | {"status": SAME if a is b else ONLY_A if b is None else ONLY_B}
    change = b - a
    row["change"] = change
    points = _in_points(quantity, unit)
    row["change_pct"] = None if points or not a else 100.0 * change / abs(a)
    if std:
        row["std"], row["change_in_std"] = std, change / std
    near = same_relative * max(abs(a), abs(b))
    row["status"] = SAME if abs(change) <= max(near, same_absolute if points else 0.0) else MOVED
    return row


def text_row(part, step, item, quantity, a, b) -> dict:
    """A text of both runs; None where a run does not have it."""
    row = dict.fromkeys(COLUMNS) | {"part": part, "step": step, "item": item, "quantity": quantity, "unit": "", "a": a, "b": b}
    return row | {"status": SAME if a == b else ONLY_A if b is None else ONLY_B if a is None else DIFFERS}


def row_of(part, step, item, quantity, unit, a, b, std=None) -> dict:
    """A number row where both values are numbers (or missing), a text row else."""
    one, other = as_number(a), as_number(b)
    if (one is None) == is_missing(a) and (other is None) == is_missing(b):
        return number_row(part, step, item, quantity, unit, one, other, std)
    return text_row(part, step, item, quantity, *(None if is_missing(v) else str(v) for v in (a, b)))


def as_number(value) -> "float | None":
    """A finite number, or None for a text and for what is missing."""
    if value is None or isinstance(value, (str, bool)):
        return None
    number = float(value)
    return number if math.isfinite(number) else None


def is_missing(value) -> bool:
    return value is None or value == "" or (isinstance(value, float) and math.isnan(value))


def larger(*deviations) -> "float | None":
    """The largest of the standard deviations that are stated; None if none is."""
    known = [d for d in map(as_number, deviations) if d]
    return max(known, default=None)


def _in_points(quantity: str, unit: str) -> bool:
    """Whether a change is told as it is and not in per cent of A: of percentages, MAC, probabilities, log odds."""
    return unit == "%" or bool(re.match(r"mac|MAC|probability|p_value|resolution|log_odds", quantity))
