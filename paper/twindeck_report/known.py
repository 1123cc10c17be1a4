"""known_deviations.toml: cells that are outside their tolerance for a stated reason. The list cannot grow into an excuse: at
most a tenth of the compared cells that are not mere inputs, no identity, and an entry goes as soon as its cell is back."""
from .errors import InputError
from .study import Study

LARGEST_SHARE = 0.1


def apply_known_deviations(study: Study, cells: list) -> None:
    """Gives every cell its verdict: inside, outside, known, `stale entry` (listed, but inside), or shown (never judged)."""
    path = study.data / "known_deviations.toml"
    by_name = {(c.table, c.row, c.column): c for c in cells if not c.shown}
    listed = set()
    entries = entries_of(study, claims=False)
    for i, entry in enumerate(entries, 1):
        cell = (entry["table"], entry["row"], entry["column"])
        if cell not in by_name:
            raise InputError(f"{path}: deviation {i}: {' '.join(cell)} is not a compared cell")
        if by_name[cell].kind == "identity":
            raise InputError(f"{path}: deviation {i}: {by_name[cell].name} is an identity; arithmetic has no known deviation")
        listed.add(cell)
    comparable = sum(c.kind != "input" for c in by_name.values())
    if len(entries) > LARGEST_SHARE * comparable:
        raise InputError(f"{path}: {len(entries)} entries; at most a tenth of the {comparable} compared cells that are not "
                         f"inputs may be listed ({int(LARGEST_SHARE * comparable)})")
    for cell in cells:
        if cell.shown:
            cell.verdict = "shown"
        elif (cell.table, cell.row, cell.column) in listed:
            cell.verdict = "stale entry" if cell.inside else "known"
        else:
            cell.verdict = "inside" if cell.inside else "outside"


def entries_of(study: Study, claims: bool) -> list:
    """The list's entries on cells, or those on claims of the text (table = "claims", row = the claim)."""
    path = study.data / "known_deviations.toml"
    entries = study.read_toml(path).get("deviation", [])
    for i, entry in enumerate(entries, 1):
        for key in ("table", "row", "column", "reason"):
            if not isinstance(entry.get(key), str) or not entry[key].strip():
                raise InputError(f"{path}: deviation {i}: no {key}; each entry has table, row, column and reason, as text")
    return [entry for entry in entries if (entry["table"] == "claims") == claims]
