"""ratchet_baseline.csv: every computed cell as it was when the baseline was last written. What is compared may not move away from the
paper, what is only shown may not move at all, beyond a margin. ratchet_moves.csv excuses single cells, each with its old value, its new
value and the reason; it is emptied when the baseline is written anew."""
import csv
from dataclasses import dataclass, field

from .cells import csv_text, number
from .errors import InputError
from .study import Study
from .tolerances import CARRIED

# By how much a cell may differ from its baseline, as a share of the larger of the two. The same source on the same machine gives the
# same bytes whatever the threads. Another processor's kernels (OPENBLAS_CORETYPE) moved frequencies and damping ratios of steps 1 and 3 by
# 1e-11, forces of members by 3e-8; a search stops where its gradient has fallen by 1e-6. A ten-thousandth is far above all that, and
# below the last digit that the paper prints.
MARGIN = 1e-4
# Of what was measured on virtual records: friction integrated in time, and an automatic selection that counts poles, are ten times as
# far from the rounding of a sum.
MARGIN_OF_RECORDS = 1e-3
FROM_RECORDS = ("recovered", "virtual")
# In the names of columns, ending in _pct, that are differences in percent and pass through zero: there the margin is that share of one
# of the two numbers, in points.
DIFFERENCES = ("error", "err_pct", "change")

BASELINE = ["table", "row", "column", "kind", "value"]
MOVES = ["table", "row", "column", "old", "new", "reason"]


@dataclass(frozen=True)
class Held:
    """A computed cell, a claim of the text or a number of ours alone, as the ratchet sees it."""

    table: str
    row: str
    column: str
    kind: str
    value: str
    paper: str = ""  # "" where it is not compared

    @property
    def key(self) -> tuple:
        return self.table, self.row, self.column

    @property
    def name(self) -> str:
        return f"{self.table} row {self.row} column {self.column}"


@dataclass
class Ratchet:
    held: int | None = None  # None: there is no baseline
    excused: list = field(default_factory=list)  # [(name, old, new, reason)]
    moved: list = field(default_factory=list)  # [(Held, old, what is wrong)] that nothing excuses
    stale: list = field(default_factory=list)  # lines: entries of ratchet_moves.csv that excuse nothing
    again: list = field(default_factory=list)  # [(Held, excused value)] that moved on from what an entry excuses; `stale` has a line for each

    @property
    def told(self) -> str:
        if self.held is None:
            return "not yet set: `make baseline` writes it"
        return f"{self.held} cells held, {len(self.excused)} excused, {len(self.moved)} moved"


def held_cells(cells: list, claims: list, own: list) -> list:
    """Everything that was computed: cells of the paper's tables, claims of the text, numbers of ours alone (own.py)."""
    found = [Held(c.table, c.row, c.column, c.kind, c.ours, "" if c.shown or number(c.paper) is None else c.paper)
             for c in cells if c.kind not in (*CARRIED, "unavailable")]
    found += [Held("claims", c.name, "value", c.kind, csv_text(c.ours), "" if c.allowed is None else c.paper)
              for c in claims if c.ours is not None and c.kind not in CARRIED]
    return found + own


def margin_of(cell: Held, old: float, new: float) -> float:
    margin = MARGIN_OF_RECORDS if cell.kind in FROM_RECORDS else MARGIN
    difference = cell.column.endswith("_pct") and any(word in cell.column for word in DIFFERENCES)
    return 100.0 * margin if difference else margin * max(abs(old), abs(new))


def what_moved(cell: Held, old: str) -> str:
    """What is wrong with a cell that was `old`, "" if nothing is."""
    before, now, paper = number(old), number(cell.value), number(cell.paper)
    if before is None or now is None:
        return "" if old == cell.value else f"was {old or 'empty'}, is {cell.value or 'empty'}"
    margin = margin_of(cell, before, now)
    if paper is None:
        return "" if abs(now - before) <= margin else f"moved from {old} to {cell.value}, {margin:.3g} allowed"
    further = abs(now - paper) - abs(before - paper)
    return "" if further <= margin else (f"moved from {old} to {cell.value}, {further:.3g} further from the paper's {cell.paper}, "
                                         f"{margin:.3g} allowed")


def check_ratchet(study: Study, held: list, whole: bool = True) -> Ratchet:
    """@param whole  every table is there: then a cell of the baseline that is gone has moved too"""
    path = study.data / "ratchet_baseline.csv"
    if not path.is_file():
        return Ratchet()
    baseline = {(r["table"], r["row"], r["column"]): r for r in study.read_csv(path, BASELINE, text=True).to_dict("records")}
    moves = read_moves(study)
    present = {cell.key: cell for cell in held}
    if whole:
        gone = [Held(*key, row["kind"], "") for key, row in baseline.items() if key not in present]
        present |= {cell.key: cell for cell in gone}
    result = Ratchet(held=sum(key in baseline for key in present))
    for key, cell in present.items():
        old = baseline[key]["value"] if key in baseline else ""
        wrong = what_moved(cell, old)
        move = moves.pop(key, None)
        if not wrong:
            if move:
                result.stale.append(f"{cell.name}: has not moved beyond the margin; take the entry out")
        elif move and not _is(cell, move["old"], old):
            result.stale.append(f"{cell.name}: the entry says that it was {move['old'] or 'empty'}, the baseline says {old or 'empty'}")
        elif move and not _is(cell, move["new"], cell.value):
            result.stale.append(f"{cell.name}: the entry says that it is {move['new'] or 'empty'} now, it is {cell.value or 'empty'}")
            result.again.append((cell, move["new"]))
        elif move:
            result.excused.append((cell.name, old, cell.value, move["reason"]))
        else:
            result.moved.append((cell, old, wrong))
    if whole:
        result.stale += [f"{' '.join(key)}: no computed cell" for key in moves]
    return result


def _is(cell: Held, said: str, value: str) -> bool:
    a, b = number(said), number(value)
    return said == value if a is None or b is None else abs(a - b) <= margin_of(cell, a, b)


def read_moves(study: Study) -> dict:
    """{(table, row, column): entry} of ratchet_moves.csv, empty where it is not there."""
    path = study.data / "ratchet_moves.csv"
    if not path.is_file():
        return {}
    entries = study.read_csv(path, MOVES, text=True).to_dict("records")
    for i, entry in enumerate(entries, 2):
        if len(entry["reason"].split()) < 3:
            raise InputError(f"{path}: line {i}: reason {entry['reason']!r}; say in a sentence why this cell has to move")
    return {(e["table"], e["row"], e["column"]): e for e in entries}


def write_baseline(study: Study, held: list) -> None:
    """Every computed cell as it is now; no excuse is left."""
    _write(study.data / "ratchet_baseline.csv", BASELINE, [[*c.key, c.kind, c.value] for c in held])
    _write(study.data / "ratchet_moves.csv", MOVES, [])


def add_moves(study: Study, ratchet: Ratchet, reason: str) -> int:
    """Lists every cell that moved without an excuse with `reason`; entries that excuse nothing any more go."""
    kept = [[*key, e["old"], e["new"], e["reason"]] for key, e in read_moves(study).items()
            if any(name == f"{key[0]} row {key[1]} column {key[2]}" for name, *_ in ratchet.excused)]
    new = [[*cell.key, old, cell.value, reason] for cell, old, _ in ratchet.moved]
    _write(study.data / "ratchet_moves.csv", MOVES, kept + new)
    return len(new)


def _write(path, header, rows) -> None:
    with path.open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
