"""What the two runs are called: the shortest ends of their paths that differ."""
import re
from pathlib import Path


def run_names(a: Path, b: Path) -> tuple:
    """('before', 'after') of results/before and results/after; the last two parts where the last is the same, and so on."""
    one, other = a.resolve().parts, b.resolve().parts
    longest = max(len(one), len(other))
    count = next((n for n in range(1, longest + 1) if one[-n:] != other[-n:]), 1)
    return "/".join(one[-count:]), "/".join(other[-count:])


def file_name(names: tuple) -> str:
    """before__after: both names with everything but letters, digits, points and - as _."""
    return "__".join(re.sub(r"[^A-Za-z0-9.-]+", "_", name).strip("_") for name in names)
