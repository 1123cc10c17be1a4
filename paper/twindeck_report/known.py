"""known_deviations.toml: numbers that are outside their tolerance for a stated reason. The list cannot grow into an excuse: at most a
tenth of the independent computed numbers that are compared (cells and claims of the text), no identity, and an entry goes as soon as its
number is back inside. An entry on a column's rms limit has `rms = true` in place of a row; one on an order of orders.toml has
`table = "orders"` and the order's name as its row."""
from .errors import InputError
from .study import Study

LARGEST_SHARE = 0.1


def apply_known_deviations(study: Study, cells: list, claims: list, rms: list, orders: list) -> None:
    """Gives every cell its verdict: inside, outside, known, `stale entry` (listed, but inside), or shown (never judged). A cell that
    repeats another's number is excused with that one. Claims, rms limits and orders get the reason of their entry."""
    path = study.data / "known_deviations.toml"
    entries = entries_of(study)
    by_name = {(c.table, c.row, c.column): c for c in cells if not c.shown}
    by_claim = {c.name: c for c in claims if c.allowed is not None}
    by_rms = {(r.rule.table, r.rule.column): r for r in rms}
    by_order = {o.name: o for o in orders}
    listed = {}
    for i, entry in enumerate(entries, 1):
        where = f"{path}: deviation {i}"
        if entry["table"] == "claims":
            _know_claim(where, entry, by_claim)
        elif entry.get("rms"):
            _know_rms(where, entry, by_rms)
        elif entry["table"] == "orders":
            _know_order(where, entry, by_order)
        else:
            cell = by_name.get((entry["table"], entry["row"], entry["column"]))
            if cell is None:
                raise InputError(f"{where}: {entry['table']} {entry['row']} {entry['column']} is not a compared cell")
            if cell.kind == "identity":
                raise InputError(f"{where}: {cell.name} is an identity; arithmetic has no known deviation")
            listed[cell.name] = entry["reason"]
    comparable = sum(c.independent for c in cells) + sum(c.independent for c in claims)
    if len(entries) > LARGEST_SHARE * comparable:
        raise InputError(f"{path}: {len(entries)} entries; at most a tenth of the {comparable} independent computed numbers that are compared "
                         f"may be listed ({int(LARGEST_SHARE * comparable)})")
    for cell in cells:
        cell.verdict = _verdict(cell, cell.name in listed or cell.repeats in listed)


def _know_claim(where: str, entry: dict, by_claim: dict) -> None:
    if entry["row"] not in by_claim or entry["column"] != "value":
        raise InputError(f"{where}: claims {entry['row']} {entry['column']}: no compared claim of that name (column = \"value\")")
    claim = by_claim[entry["row"]]
    claim.known, claim.basis = True, entry["reason"]


def _know_rms(where: str, entry: dict, by_rms: dict) -> None:
    if (entry["table"], entry["column"]) not in by_rms:
        raise InputError(f"{where}: {entry['table']} column {entry['column']} has no rms limit")
    by_rms[entry["table"], entry["column"]].known = entry["reason"]


def _know_order(where: str, entry: dict, by_order: dict) -> None:
    if entry["row"] not in by_order:
        raise InputError(f"{where}: order {entry['row']!r}: orders.toml has no order of that name")
    by_order[entry["row"]].known = entry["reason"]


def _verdict(cell, known: bool) -> str:
    if cell.shown:
        return "shown"
    if known:
        return "stale entry" if cell.inside and not cell.repeats else "inside" if cell.inside else "known"
    return "inside" if cell.inside else "outside"


def verdicts_without_list(cells: list) -> None:
    """With a table missing the share of known deviations cannot be judged: cells stand for themselves."""
    for cell in cells:
        cell.verdict = _verdict(cell, False)


def entries_of(study: Study) -> list:
    """On cells, on claims of the text (table = "claims", row = the claim), on rms limits (rms = true) and on orders (table = "orders",
    row = the order's name; `column` is empty in what is returned)."""
    path = study.data / "known_deviations.toml"
    entries = study.read_toml(path).get("deviation", [])
    for i, entry in enumerate(entries, 1):
        rms, order = entry.get("rms") is True, entry.get("table") == "orders"
        for key in ("table", *([] if rms else ["row"]), *([] if order else ["column"]), "reason"):
            if not isinstance(entry.get(key), str) or not entry[key].strip():
                raise InputError(f"{path}: deviation {i}: no {key}; each entry has table, row (or rms = true), column and reason; one on an "
                                 "order has table = \"orders\", row and reason")
        if order and ("column" in entry or rms):
            raise InputError(f"{path}: deviation {i}: an order has neither column nor rms; name it by table = \"orders\" and row")
    return [{"column": "", **entry} for entry in entries]
