"""A printed number and ours: digits, formats, text of a cell."""
import math


def decimals(printed: str) -> int:
    """Digits behind the point of a number as printed; 0 for integers."""
    return len(printed.partition(".")[2])


def number(text) -> float | None:
    """The number that a cell holds, None for text and for empty cells."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return value if math.isfinite(value) else None


def csv_text(value) -> str:
    """12 significant digits for numbers, text as it is, empty for nothing."""
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return ""
    if isinstance(value, float):
        return f"{value:.12g}"
    return str(value)


def shown(value, printed: str) -> str:
    """Ours rounded to the digits that the paper prints in the same cell."""
    found = number(value)
    if found is None:
        return "" if value is None or csv_text(value) == "" else str(value)
    if number(printed) is None:
        return csv_text(found)
    text = f"{found:.{decimals(printed)}f}"
    return text[1:] if float(text) == 0 and text.startswith("-") else text


def truth(value) -> bool:
    """0/1, true/false, yes/no as a step writes them."""
    return str(value).strip().lower() in ("1", "1.0", "true", "yes")
