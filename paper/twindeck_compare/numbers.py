"""How a compared value is shown: six digits of a number, a change with its sign, long texts cut on the terminal."""
import math

from twindeck.comparison.rows import is_missing

NOTHING = "-"


def six(value) -> str:
    """Six significant digits of a number, '-' for what a run does not have; text stays text."""
    if is_missing(value):
        return NOTHING
    if isinstance(value, str):
        return value
    text = f"{float(value):.6g}"
    return f"{float(value):,.0f}" if "e+" in text and abs(value) < 1e15 else text


def change(row: dict) -> str:
    """'+2.73 %', in points for percentages and ratios: '+0.006'; '' where there is no number on both sides."""
    if is_missing(row["change"]):
        return ""
    if not is_missing(row["change_pct"]) and not math.isinf(row["change_pct"]):
        return f"{row['change_pct']:+.3g} %"
    return f"{row['change']:+.3g}{' points' if row['unit'] == '%' else ''}"


def in_std(row: dict) -> str:
    """'1.3' standard deviations; '' where none is known."""
    return "" if is_missing(row["change_in_std"]) else f"{abs(row['change_in_std']):.2g}"


def size(row: dict) -> float:
    """How far a row moved, for putting the largest first: in standard deviations where one is known, else in per cent or points.
    Of input files, those of the run's own earlier steps come last: that they differ follows from what is listed already."""
    if row["part"] == "inputs" and row["quantity"].startswith("{results}"):
        return 0.0
    for name in ("change_in_std", "change_pct", "change"):
        if not is_missing(row[name]):
            return abs(row[name])
    return math.inf  # a text that differs, or what stands in one run only


def cut(text: str, width: int, begin: bool = False) -> str:
    """A text of at most `width` letters; `begin`: what is too long loses its beginning, as of a path."""
    if begin and len(text) > width:
        return "…" + text[1 - width:]
    return text if len(text) <= width else text[: width - 1] + "…"
