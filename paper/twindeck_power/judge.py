"""Which cells notice a changed input. Only tables whose every source has been run anew, or is not touched by the change, are looked at;
columns that the unchanged study shows because their null passes stay shown. A cell that prints the changed input does not count, nor does
one that is carried over from the paper."""
from dataclasses import dataclass, field
from fnmatch import fnmatchcase

from twindeck_report.cells import number
from twindeck_report.check import Rms
from twindeck_report.claims import check_claims
from twindeck_report.compare import compare_table, rms_of
from twindeck_report.errors import InputError
from twindeck_report.known import entries_of
from twindeck_report.orders import check_orders
from twindeck_report.own import own_numbers
from twindeck_report.ratchet import check_ratchet, held_cells, margin_of
from twindeck_report.study import Study
from twindeck_report.tables import TABLES, table_name
from twindeck_report.tables.writer import full_table, write_csv
from twindeck_report.tolerances import CARRIED, read_tolerances

# What a share of the allowance is called where there is none to take it of: an order, a word, a cell that is empty now.
BEYOND = 10.0


@dataclass
class Caught:
    paper: dict = field(default_factory=dict)  # name -> deviation over what is allowed (above 1)
    ratchet: dict = field(default_factory=dict)  # name -> movement over the margin
    nearest: float = 0.0  # the largest of those shares over all cells, caught or not

    @property
    def cells(self) -> list:
        """The clearest first, those of the paper gate before the ratchet's."""
        names = sorted(self.paper, key=lambda n: -self.paper[n])
        return names + sorted((n for n in self.ratchet if n not in self.paper), key=lambda n: -self.ratchet[n])


class Judge:
    def __init__(self, unchanged: Study, result=None):
        """@param result  of run_check on the unchanged study; without it every column that has a tolerance counts as compared, and every
        order as one that holds"""
        self.known = {(e["table"], e.get("row", ""), e["column"]) for e in entries_of(unchanged)}
        self.shown = {(c.table, c.column) for c in result.cells if c.shown} if result else set()
        self.failing = {o.name for o in result.orders if not o.holds} if result else set()
        self.claims = {c.name for c in result.claims if c.verdict == "shown, not compared"} if result else set()

    def look(self, study: Study, prints: tuple) -> Caught:
        tolerances = read_tolerances(study)
        tables = _tables_that_can_be_made(study, tolerances)
        cells = [cell for table in tables for cell in compare_table(study, table, tolerances)]
        for cell in cells:
            cell.shown = cell.shown or (cell.table, cell.column) in self.shown
        claims = check_claims(study, skip_missing=True)
        for claim in claims:
            claim.allowed = None if claim.name in self.claims else claim.allowed
        found = Caught()
        self._paper(study, tolerances, tables, cells, claims, found)
        self._ratchet(study, cells, claims, found)
        for gate in (found.paper, found.ratchet):
            for name in [n for n in gate if any(fnmatchcase(n, p) for p in prints)]:
                del gate[name]
        shares = [*found.paper.values(), *found.ratchet.values()]
        found.nearest = max([found.nearest, *shares])
        found.paper = {n: s for n, s in found.paper.items() if s > 1.0}
        found.ratchet = {n: s for n, s in found.ratchet.items() if s > 1.0}
        return found

    def _paper(self, study, tolerances, tables, cells, claims, found: Caught) -> None:
        for cell in cells:
            if cell.independent and (cell.table, cell.row, cell.column) not in self.known:
                found.paper[cell.name] = _share(cell.deviation, cell.allowed, cell.inside)
        for claim in claims:
            if claim.independent and ("claims", claim.name, "value") not in self.known:
                found.paper[f"claim {claim.name}"] = _share(claim.ours - number(claim.paper), claim.allowed, claim.inside)
        for rule in tolerances.rms:
            rms = Rms(rule, rms_of(cells, rule.table, rule.column))
            if rms.value is not None and (rule.table, "", rule.column) not in self.known and (rule.table, rule.column) not in self.shown:
                found.paper[f"{rule.table} column {rule.column} rms"] = rms.value / rule.limit
        orders = check_orders(study, {table: tolerances.keys[table] for table in tables}, skip_missing=True)
        found.paper |= {f"order {o.name}": BEYOND for o in orders
                        if not o.holds and o.name not in self.failing and ("orders", o.name, "") not in self.known}

    def _ratchet(self, study, cells, claims, found: Caught) -> None:
        held = held_cells([c for c in cells if c.kind not in CARRIED], claims, own_numbers(study))
        ratchet = check_ratchet(study, held, whole=False)
        # What has an entry in ratchet_moves.csv is held where that entry says it is.
        for cell, old in [*((cell, old) for cell, old, _ in ratchet.moved), *ratchet.again]:
            before, now, paper = number(old), number(cell.value), number(cell.paper)
            if before is None or now is None:
                found.ratchet[cell.name] = BEYOND
                continue
            further = abs(now - before) if paper is None else abs(now - paper) - abs(before - paper)
            found.ratchet[cell.name] = further / margin_of(cell, before, now)


def _share(deviation, allowed, inside: bool) -> float:
    if deviation is None or allowed is None:
        return 0.0 if inside else BEYOND
    return abs(deviation) / allowed if allowed else (0.0 if inside else BEYOND)


def _tables_that_can_be_made(study: Study, tolerances) -> list:
    """Those whose sources are there, written to the study's tables/."""
    folder = study.results / "tables"
    folder.mkdir(exist_ok=True)
    made = []
    for number_ in TABLES:
        path = folder / f"{table_name(number_)}.csv"
        path.unlink(missing_ok=True)
        try:
            write_csv(full_table(study, number_, tolerances), path)
            made.append(table_name(number_))
        except InputError:
            pass  # a step that it rests on has not run
    return made
