"""Numbers with units as people write them: 210 GPa, 8.2 MN/m, 0.612."""
import re

PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"))
TAKES_PREFIX = ("Pa", "N", "N/m", "N m/rad", "N s/m")


def physical(value, unit: str, digits: int = 3) -> str:
    """The value with its unit, a prefix of thousands where the unit takes one; '-' and '' are no units."""
    unit = "" if unit in ("-", None) else unit
    number, prefix = float(value), ""
    if unit in TAKES_PREFIX:
        for size, letter in PREFIXES:
            if abs(number) >= size:
                number, prefix = number / size, letter
                break
    text = f"{number:.{digits}g}"
    if "e" in text and 1e-4 <= abs(number) < 1e9:
        text = f"{float(text):,.0f}" if abs(number) >= 1 else f"{float(text):f}".rstrip("0")
    return f"{text} {prefix}{re.sub('(?<=[ms])([23])', lambda power: '²³'[int(power[1]) - 2], unit.replace('^', ''))}".strip()


def span(estimate: dict, unit: str) -> str:
    """'210 GPa (205 to 216 GPa)' of {value, low, high}, in one unit."""
    return f"{physical(estimate['value'], unit)} ({physical(estimate['low'], unit)} to {physical(estimate['high'], unit)})"
