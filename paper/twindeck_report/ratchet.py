"""ratchet.csv: the deviations of the last release. No cell may move further from the paper without a changelog line."""
import csv
import re

from .cells import csv_text, number
from .errors import InputError
from .study import Study

MARGIN_POINTS = 0.2
HEADER = ["table", "row", "column", "ours", "deviation_pct"]


def check_ratchet(study: Study, cells: list) -> tuple:
    """(what was found in a sentence, [(cell, what is wrong)])."""
    path = study.data / "ratchet.csv"
    if not path.is_file():
        return "not yet set: no release has written it (twindeck_report ratchet)", []
    last = study.read_csv(path, HEADER, text=True)
    before = {(r["table"], r["row"], r["column"]): number(r["deviation_pct"]) for r in last.to_dict("records")}
    if None in before.values():
        raise InputError(f"{path}: deviation_pct: a cell that is not a number")
    announced = announced_tables(study)
    grown = []
    for cell in (c for c in cells if not c.shown):
        earlier = before.get((cell.table, cell.row, cell.column))
        if earlier is not None and cell.deviation_pct > earlier + MARGIN_POINTS and cell.table not in announced:
            grown.append((cell, f"deviation grew from {earlier:.3g} to {cell.deviation_pct:.3g} points since the last release; "
                                f"if that is meant, add a line `ratchet: {cell.table}` with the reason to {study.changelog}"))
    return f"{len(before)} cells of the last release, margin {MARGIN_POINTS} points", grown


def announced_tables(study: Study) -> set:
    """Tables named by `ratchet: table_NN` lines in the changelog's Unreleased section."""
    if not study.changelog.is_file():
        return set()
    text = study.changelog.read_text(encoding="utf-8")
    section = re.search(r"^##\s*\[?unreleased\]?[^\n]*\n(.*?)(?=^##\s|\Z)", text, re.M | re.S | re.I)
    return set(re.findall(r"ratchet:\s*(\w+)", section.group(1))) if section else set()


def write_ratchet(study: Study, cells: list) -> None:
    with (study.data / "ratchet.csv").open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(HEADER)
        for cell in (c for c in cells if not c.shown):
            ours = number(cell.ours)
            writer.writerow([cell.table, cell.row, cell.column, cell.ours if ours is None else csv_text(ours),
                             f"{cell.deviation_pct:.6g}"])
