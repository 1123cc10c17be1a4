"""Each compared cell of the tables as they lie in results/<study>/tables, against the paper as printed."""
from dataclasses import dataclass

import pandas as pd

from .cells import csv_text, decimals, number
from .errors import InputError
from .study import Study
from .tolerances import CARRIED, Column, Tolerances


@dataclass
class Cell:
    """One cell beside the paper's. `deviation` and `allowed` are in the column's unit."""

    table: str
    row: str
    column: str
    paper: str
    ours: str
    deviation: float | None  # None: text or nothing to subtract
    allowed: float | None
    inside: bool
    kind: str
    basis: str
    verdict: str = ""  # inside | outside | known | stale entry | shown
    shown: bool = False  # beside the paper's, no claim of agreement: never judged
    repeats: str = ""  # name of the cell that says the same number; "" for a number of its own
    null: str = ""  # what the null puts in this cell's place; "" where the column has none
    null_passes: bool = False  # the null would be inside the tolerance too
    simplest: str = ""  # of a recovered number: what the simplest rule that recovers it gives

    @property
    def name(self) -> str:
        return f"{self.table} row {self.row} column {self.column}"

    @property
    def used_pct(self) -> float:
        """Share of the allowed deviation that is used up; infinite if nothing is allowed, or no share is to be told."""
        if self.shown:
            return float("inf")
        if self.deviation is None or self.allowed is None:
            return 0.0 if self.inside else float("inf")
        if self.allowed == 0.0:
            return 0.0 if self.deviation == 0.0 else float("inf")
        return 100.0 * abs(self.deviation) / self.allowed

    @property
    def independent(self) -> bool:
        """A computed number of its own that is compared."""
        return not self.shown and self.kind not in CARRIED and not self.repeats

    @property
    def closer_than_simplest(self) -> bool:
        theirs, value, simplest = number(self.paper), number(self.ours), number(self.simplest)
        return None not in (theirs, value, simplest) and abs(value - theirs) < abs(simplest - theirs)


def load_table(study: Study, table: str, key: str) -> pd.DataFrame:
    """A generated table, cells as text, indexed by row."""
    frame = study.step_csv(f"tables/{table}.csv", key.split("+"), text=True)
    return _indexed(frame, key, study.results / "tables" / f"{table}.csv")


def load_paper(study: Study, table: str, key: str) -> pd.DataFrame:
    number = "_".join(table.split("_")[:2])  # table_12_quasi_steady is held against table_12
    path = study.data / "paper" / f"{number}.csv"
    return _indexed(study.read_csv(path, key.split("+"), text=True), key, path)


def _indexed(frame, key, path) -> pd.DataFrame:
    rows = row_names(frame, key)
    repeated = rows[rows.duplicated()]
    if len(repeated):
        raise InputError(f"{path}: row {repeated.iloc[0]} stands twice")
    return frame.set_index(rows)


def row_names(frame, key) -> pd.Series:
    """What rows are called: the key column's text, or that of several columns ("case+cable") with a blank between."""
    columns = key.split("+")
    return frame[columns[0]].str.cat([frame[c] for c in columns[1:]], sep=" ") if len(columns) > 1 else frame[key]


def compare_table(study: Study, table: str, tolerances: Tolerances) -> list:
    """The cells of one table. A row or column that is gone counts as an empty cell, outside; what is only shown is not judged."""
    key = tolerances.keys[table]
    ours, paper = load_table(study, table, key), load_paper(study, table, key)
    rules = tolerances.columns[table]
    lacking = [c for c in rules if c not in paper.columns]
    if lacking:
        raise InputError(f"{study.data / 'tolerances.toml'}: {table}.columns.{lacking[0]}: no such column in the paper's table")
    said_before = {column: _said_before(study, tolerances, rule) for column, rule in rules.items()}
    cells = []
    for row in paper.index:
        for column, rule in rules.items():
            printed = paper.at[row, column]
            found = ours.at[row, column] if row in ours.index and column in ours.columns else ""
            if printed or found:
                cells.append(judge(rule, rules, row, printed, found, paper))
                cells[-1].repeats = said_before[column].get(row, "")
    for row in ours.index.difference(paper.index, sort=False):
        cells.append(Cell(table, row, key, "", row, None, None, False, "input", "rows are the paper's"))
    return cells


def _said_before(study: Study, tolerances: Tolerances, rule: Column) -> dict:
    """{row: name of the cell whose number this column says again}: the rows that the column named by `repeats` has too."""
    if not rule.repeats:
        return {}
    table, _, column = rule.repeats.partition(".")
    if column not in tolerances.columns.get(table, {}):
        raise InputError(f"{study.data / 'tolerances.toml'}: {rule.table}.columns.{rule.name}: repeats {rule.repeats!r}, "
                         f"which is no column with a rule")
    return {row: f"{table} row {row} column {column}" for row in load_paper(study, table, tolerances.keys[table]).index}


def judge(rule: Column, rules: dict, row: str, printed: str, found: str, paper: pd.DataFrame) -> Cell:
    """What is found (ours, or a null's) in a cell held against what is printed there."""
    def cell(deviation, allowed, inside, shown=False):
        return Cell(rule.table, row, rule.name, printed, found, deviation, allowed, inside, rule.kind_of(row), rule.basis, shown=shown)

    theirs, value = number(printed), number(found)
    if rule.rule == "shown":
        return cell(None if theirs is None or value is None else value - theirs, None, True, shown=True)
    if rule.rule == "exact" or theirs is None or value is None:
        return cell(None, None, printed == found)
    deviation, allowed = value - theirs, _allowed(rule, rules, row, printed, paper)
    # 12 digits are written: a deviation of that size is not one
    return cell(deviation, allowed, abs(deviation) <= allowed * (1.0 + 1e-9) + 1e-12 * abs(theirs))


def _allowed(rule: Column, rules, row, printed, paper) -> float:
    if rule.rule == "rounding":
        return rule.tolerance * 0.5 * 10.0 ** -decimals(printed)
    if rule.rule == "absolute":
        return rule.tolerance
    if rule.rule == "relative":
        return rule.tolerance * abs(number(printed))
    if rule.of not in rules or number(paper.at[row, rule.measured]) is None:
        raise InputError(f"tolerances.toml: {rule.table}.columns.{rule.name}: error_of needs a compared column `of` and a "
                         f"`measured` column with numbers")
    source = rules[rule.of]
    return 100.0 / number(paper.at[row, rule.measured]) * _allowed(source, rules, row, paper.at[row, rule.of], paper)


def relative_deviation(cell: Cell, found: str) -> float | None:
    """(found - paper) / paper; None where one of them is no number."""
    paper, value = number(cell.paper), number(found)
    return value / paper - 1.0 if paper and value is not None else None


def rms_of(cells, table: str, column: str, null: bool = False) -> float | None:
    """Root mean square of the relative deviations of a column's cells, ours or its null's; None if there is nothing to take it of."""
    found = [relative_deviation(c, c.null if null else c.ours) for c in cells if c.table == table and c.column == column]
    squares = [d * d for d in found if d is not None]
    return (sum(squares) / len(squares)) ** 0.5 if squares else None


def row_for_csv(cell: Cell) -> list:
    used = "" if cell.used_pct == float("inf") else f"{cell.used_pct:.4g}"
    return [cell.table, cell.row, cell.column, cell.paper, cell.ours, csv_text(cell.deviation), csv_text(cell.allowed), used,
            cell.kind, cell.verdict, cell.basis]
