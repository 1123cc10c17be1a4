"""The short page on the terminal: what was asked differently, then what moved, the largest first."""
from twindeck.comparison import Comparison

from .numbers import change, cut, in_std, six, size
from .parts import PARTS, words

most_rows = 6  # of each part; the CSV file and the page have all of them
text_width = 22  # letters of a value
words_width = 44  # letters of what a row is about


def terminal_text(found: Comparison, names: tuple) -> str:
    """The page as text, without a line break at its end."""
    lines = [f"A  {names[0]}", f"B  {names[1]}"] + [f"note: {note}" for note in found.notes]
    if not len(found.changed):
        return "\n".join([*lines, f"nothing differs: {len(found.table)} things compared in {', '.join(found.a.steps)}"])
    for part, (title, _) in PARTS.items():
        rows = found.table[found.table["part"] == part].to_dict("records")
        changed = sorted((r for r in rows if r["status"] != "same"), key=size, reverse=True)
        if not rows:
            continue
        lines += ["", f"{title}: {_count(len(changed), len(rows))}"]
        lines += _table([_cells(r) for r in changed[:most_rows]])
        if len(changed) > most_rows:
            lines.append(f"  and {len(changed) - most_rows} more")
    return "\n".join([*lines, "", "std: change in standard deviations, the larger of both runs'"])


def _count(changed: int, rows: int) -> str:
    return f"{changed} of {rows} differ" if changed else f"all {rows} the same"


def _cells(row: dict) -> list:
    known = row["status"] if row["status"].startswith("only") else change(row)
    return [row["step"].split("_")[0], cut(words(row), words_width, row["part"] == "inputs"), cut(six(row["a"]), text_width), cut(six(row["b"]), text_width), row["unit"], known, in_std(row)]


def _table(rows: list) -> list:
    if not rows:
        return []
    rows = [["", "", "A", "B", "unit", "change", "std"], *rows]
    kept = [i for i in range(7) if i < 4 or any(r[i] for r in rows[1:])]
    widths = {i: max(len(r[i]) for r in rows) for i in kept}
    return ["  " + "  ".join(r[i].ljust(widths[i]) if i in (0, 1, 4) else r[i].rjust(widths[i]) for i in kept).rstrip() for r in rows]
