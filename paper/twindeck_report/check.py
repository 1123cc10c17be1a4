"""The paper check: every gate, in one result. The tables are compared as they lie there first, then hashes are looked at."""
from dataclasses import dataclass, field
from pathlib import Path

from .claims import check_claims
from .compare import Cell, compare_table, rms_of
from .coverage import counts, lacking
from .errors import InputError
from .known import apply_known_deviations
from .orders import check_orders
from .ratchet import check_ratchet
from .stale import find_stale
from .statements import check_statements
from .study import Study
from .tolerances import RmsRule, read_tolerances


@dataclass(frozen=True)
class Rms:
    rule: RmsRule
    value: float | None

    @property
    def inside(self) -> bool:
        return self.value is not None and self.value <= self.rule.limit


@dataclass
class CheckResult:
    cells: list  # worst first
    rms: list
    orders: list
    claims: list
    statements: list  # of the text, hit or miss: shown, they fail nothing
    ratchet: str
    grown: list  # [(Cell, what is wrong)]
    stale: list  # [(Path, what is wrong)]
    missing: list  # tables that are not there
    uncovered: list  # printed numbers that no rule covers
    numbers: list  # [(table, printed numbers, in the check, {kind: count})]
    failures: list = field(default_factory=list)  # one line each

    @property
    def passed(self) -> bool:
        return not self.failures

    def count(self, verdict: str) -> int:
        return sum(cell.verdict == verdict for cell in self.cells)

    def coverage(self) -> list:
        """A line a table: how many of its printed numbers are in the check, and of which kind ours is."""
        return [f"{table}: {inside} of {printed} printed numbers: " + ", ".join(f"{n} {kind}" for kind, n in kinds.items())
                for table, printed, inside, kinds in self.numbers]

    def summary(self) -> str:
        stale = f", {len(self.stale)} stale or missing files" if self.stale else ""
        kept = sum(order.holds for order in self.orders)
        judged = len(self.cells) - self.count("shown")
        computed = [c for c in self.claims if c.ours is not None]
        return (f"paper check {'passed' if self.passed else 'FAILED'}: {judged} cells compared, "
                f"{self.count('inside')} inside, {self.count('known')} known deviations, "
                f"{self.count('outside') + self.count('stale entry')} failing, {self.count('shown')} shown beside the paper's; "
                f"{len(computed)} of {len(self.claims)} claims of the text computed, "
                f"{sum(c.allowed is not None for c in computed)} compared, {sum(c.verdict == 'known' for c in computed)} known; "
                f"{sum(r.inside for r in self.rms)} of {len(self.rms)} rms limits, {kept} of {len(self.orders)} orders hold; "
                f"ratchet {self.ratchet}{stale}")


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
    apply_known_deviations(study, cells) if not missing else _verdicts_without_list(cells)
    rms = [Rms(rule, rms_of(cells, rule.table, rule.column)) for rule in tolerances.rms]
    orders = check_orders(study, tolerances.keys) if not missing else []
    ratchet, grown = check_ratchet(study, cells)
    cells.sort(key=lambda c: (c.shown, c.verdict in ("inside", "known"), -c.used_pct))
    result = CheckResult(cells, rms, orders, check_claims(study) if not missing else [],
                         check_statements(study) if not missing else [], ratchet, grown,
                         find_stale(study, tolerances), missing, lacking(study, tolerances), counts(study, tolerances, cells))
    result.failures = _failures(study, result)
    return result


def _verdicts_without_list(cells: list) -> None:
    """With a table missing the share of known deviations cannot be judged: cells stand for themselves."""
    for cell in cells:
        cell.verdict = "shown" if cell.shown else "inside" if cell.inside else "outside"


def _failures(study: Study, result: CheckResult) -> list:
    lines = [f"{table}: missing in {study.results / 'tables'}; run `make tables STUDY={study.name}`"
             for table in result.missing]
    lines += [f"{cell.name}: {explain(cell)}" for cell in result.cells if cell.verdict in ("outside", "stale entry")]
    lines += [f"{r.rule.table} column {r.rule.column}: root mean square deviation {percent(r.value)}, at most "
              f"{percent(r.rule.limit)} allowed" for r in result.rms if not r.inside and r.rule.table not in result.missing]
    lines += [f"order {o.name}: does not hold ({o.found}): {o.statement}" for o in result.orders if not o.holds]
    lines += result.uncovered
    lines += [f"claim {c.name}: ours {c.shown}, paper {c.paper}" for c in result.claims if c.verdict == "outside"]
    lines += [f"claim {c.name}: listed in known_deviations.toml but inside its tolerance again; take the entry out"
              for c in result.claims if c.verdict == "stale entry"]
    lines += [f"{cell.name}: {problem}" for cell, problem in result.grown]
    lines += [f"{Path(path).as_posix()}: {problem}" for path, problem in result.stale]
    return lines


def explain(cell: Cell) -> str:
    """What is wrong with a cell, in a line."""
    if cell.verdict == "stale entry":
        return "listed in known_deviations.toml but inside its tolerance again; take the entry out"
    if cell.deviation is None or cell.allowed is None:
        return f"ours {cell.ours or 'empty'}, paper {cell.paper or 'empty'}"
    if cell.one_sided:
        return (f"ours {cell.ours}, paper {cell.paper}: {cell.deviation:.4g} points further from the measurement than the "
                f"paper's, {cell.allowed:.4g} allowed")
    return f"ours {cell.ours}, paper {cell.paper}: deviation {cell.deviation:.4g}, {cell.allowed:.4g} allowed"


def percent(value) -> str:
    return "nothing to compare" if value is None else f"{100 * value:.2f} %"
