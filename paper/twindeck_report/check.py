"""The paper check: every gate, in one result. The tables are compared as they lie there first, then hashes are looked at."""
from dataclasses import dataclass, field
from pathlib import Path

from .checksums import changed_inputs
from .claims import check_claims
from .compare import Cell, compare_table, rms_of
from .counts import Counts, count, mark_repetitions
from .coverage import counts, lacking
from .errors import InputError
from .known import apply_known_deviations, verdicts_without_list
from .nulls import judge_nulls
from .orders import check_orders
from .own import own_numbers
from .ratchet import Ratchet, check_ratchet, held_cells
from .simplest import judge_simplest
from .stale import find_stale
from .statements import check_statements
from .study import Study
from .tolerances import RmsRule, read_tolerances


@dataclass
class Rms:
    rule: RmsRule
    value: float | None
    known: str = ""  # why it may lie beyond its limit

    @property
    def inside(self) -> bool:
        return self.value is not None and self.value <= self.rule.limit

    @property
    def verdict(self) -> str:
        if self.known:
            return "stale entry" if self.inside else "known"
        return "inside" if self.inside else "outside"


@dataclass
class CheckResult:
    cells: list  # worst first
    rms: list
    orders: list
    claims: list
    statements: list  # of the text, hit or miss: shown, they fail nothing
    nulls: list  # verdicts on what stands in each column's place
    counts: Counts
    held: list  # what the ratchet sees
    ratchet: Ratchet
    stale: list  # [(Path, what is wrong)]
    missing: list  # tables that are not there
    uncovered: list  # printed numbers that no rule covers
    numbers: list  # [(table, printed numbers, in the check, {kind: count})]
    failures: list = field(default_factory=list)  # one line each
    held_back: list = field(default_factory=list)  # those of them that are the ratchet's

    @property
    def passed(self) -> bool:
        return not self.failures

    def count(self, verdict: str) -> int:
        return sum(cell.verdict == verdict for cell in self.cells)

    def coverage(self) -> list:
        """A line a table: how many of its printed numbers are in the check, and of which kind ours is."""
        return [f"{table}: {inside} of {printed} printed numbers: " + ", ".join(f"{n} {kind}" for kind, n in kinds.items())
                for table, printed, inside, kinds in self.numbers]

    def first_line(self) -> str:
        return f"Paper check {'passed' if self.passed else 'FAILED'}. {self.counts.told}"

    def second_line(self) -> str:
        stale = f"; {len(self.stale)} stale or missing files" if self.stale else ""
        kept, known = sum(order.holds for order in self.orders), sum(order.verdict == "known" for order in self.orders)
        known = f" ({known} does not for a stated reason)" if known == 1 else f" ({known} do not for stated reasons)" if known else ""
        computed = sum(c.ours is not None for c in self.claims)
        return (f"By kind: {self.counts.by_kind}; {self.counts.apart}; {computed} of {len(self.claims)} claims of the text computed; {sum(r.inside for r in self.rms)} of "
                f"{len(self.rms)} rms limits, {kept} of {len(self.orders)} orders hold{known}; {sum(n.passes for n in self.nulls)} of {len(self.nulls)} "
                f"columns shown because their null passes; ratchet: {self.ratchet.told}{stale}")

    def summary(self) -> str:
        return f"{self.first_line()}\n{self.second_line()}"


def run_check(study: Study) -> CheckResult:
    """@throws InputError for rules that are not as they should be, and for results that are not there at all."""
    tolerances = read_tolerances(study)
    if not (study.results / "tables").is_dir():
        raise InputError(f"{study.results / 'tables'}: missing; run `make tables STUDY={study.name}` first")
    cells, missing = [], []
    for table in tolerances.tables():
        if (study.results / "tables" / f"{table}.csv").is_file():
            cells += compare_table(study, table, tolerances)
        else:
            missing.append(table)
    nulls = judge_nulls(study, tolerances, cells)
    shown = {(v.table, v.column) for v in nulls if v.passes}
    rms = [Rms(rule, rms_of(cells, rule.table, rule.column)) for rule in tolerances.rms if (rule.table, rule.column) not in shown]
    judge_simplest(study, tolerances, cells)
    claims = check_claims(study) if not missing else []
    mark_repetitions(cells, claims)
    orders = check_orders(study, tolerances.keys) if not missing else []
    if missing:
        verdicts_without_list(cells)
    else:
        apply_known_deviations(study, cells, claims, rms, orders)
    held = held_cells(cells, claims, own_numbers(study))
    result = CheckResult(sorted(cells, key=lambda c: (c.shown, c.verdict in ("inside", "known"), -c.used_pct)), rms,
                         orders, claims, check_statements(study) if not missing else [], nulls, count(cells, claims), held,
                         check_ratchet(study, held, whole=not missing), find_stale(study, tolerances) + changed_inputs(study), missing,
                         lacking(study, tolerances), counts(study, tolerances, cells))
    result.held_back = [f"{cell.name}: {wrong}; list it in ratchet_moves.csv with the reason if it has to" for cell, _, wrong in result.ratchet.moved]
    result.held_back += [f"ratchet_moves.csv: {line}" for line in result.ratchet.stale]
    result.failures = _failures(study, result) + result.held_back
    return result


def _failures(study: Study, result: CheckResult) -> list:
    back = "listed in known_deviations.toml but inside again; take the entry out"
    lines = [f"{table}: missing in {study.results / 'tables'}; run `make tables STUDY={study.name}`"
             for table in result.missing]
    lines += [f"{cell.name}: {explain(cell)}" for cell in result.cells if cell.verdict in ("outside", "stale entry")]
    lines += [f"{r.rule.table} column {r.rule.column}: root mean square deviation {percent(r.value)}, at most "
              f"{percent(r.rule.limit)} allowed" for r in result.rms if r.verdict == "outside" and r.rule.table not in result.missing]
    lines += [f"{r.rule.table} column {r.rule.column}: root mean square deviation: {back}" for r in result.rms if r.verdict == "stale entry"]
    lines += [f"order {o.name}: does not hold ({o.found}): {o.statement}" for o in result.orders if o.verdict == "does not hold"]
    lines += [f"order {o.name}: listed in known_deviations.toml but it holds again ({o.found}); take the entry out"
              for o in result.orders if o.verdict == "stale entry"]
    lines += result.uncovered
    lines += [f"claim {c.name}: ours {c.shown}, paper {c.paper}" for c in result.claims if c.verdict == "outside"]
    lines += [f"claim {c.name}: {back}" for c in result.claims if c.verdict == "stale entry"]
    lines += [f"{Path(path).as_posix()}: {problem}" for path, problem in result.stale]
    return lines


def explain(cell: Cell) -> str:
    """What is wrong with a cell, in a line."""
    if cell.verdict == "stale entry":
        return "listed in known_deviations.toml but inside its tolerance again; take the entry out"
    if cell.deviation is None or cell.allowed is None:
        return f"ours {cell.ours or 'empty'}, paper {cell.paper or 'empty'}"
    return f"ours {cell.ours}, paper {cell.paper}: deviation {cell.deviation:.4g}, {cell.allowed:.4g} allowed"


def percent(value) -> str:
    return "nothing to compare" if value is None else f"{100 * value:.2f} %"
