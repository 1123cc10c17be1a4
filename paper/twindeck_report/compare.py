"""Each compared cell of the tables as they lie in results/<study>/tables, against the paper as printed."""
from dataclasses import dataclass

import pandas as pd

from .cells import csv_text, decimals, number
from .errors import InputError
from .identifiability import allowed_changes
from .study import Study
from .tolerances import Column, Tolerances


@dataclass
class Cell:
    """One compared cell. `deviation` and `allowed` are in the column's unit; for the rule `measurement` the deviation is how
    much further than the paper ours is from the measurement (negative: closer)."""

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
    one_sided: bool = False
    shown: bool = False  # beside the paper's, no claim of agreement: never judged

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
        deviation = max(0.0, self.deviation) if self.one_sided else abs(self.deviation)
        if self.allowed == 0.0:
            return 0.0 if deviation == 0.0 else float("inf")
        return 100.0 * deviation / self.allowed

    @property
    def deviation_pct(self) -> float:
        """What the ratchet watches: points for columns in percent, else percent of the paper's value."""
        if self.deviation is None:
            return 0.0 if self.inside else 100.0
        deviation = max(0.0, self.deviation) if self.one_sided else abs(self.deviation)
        paper = number(self.paper)
        return deviation if self.column.endswith("_pct") or not paper else 100.0 * deviation / abs(paper)


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
    changes = allowed_changes(study, _scatter(rules)) if any(r.rule == "identifiability" for r in rules.values()) else {}
    cells = []
    for row in paper.index:
        for column, rule in rules.items():
            printed = paper.at[row, column]
            found = ours.at[row, column] if row in ours.index and column in ours.columns else ""
            if printed or found:
                cells.append(_cell(rule, rules, row, printed, found, paper, changes))
    for row in ours.index.difference(paper.index, sort=False):
        cells.append(Cell(table, row, key, "", row, None, None, False, "input", "rows are the paper's"))
    return cells


def _scatter(rules) -> float:
    return next(r.tolerance for r in rules.values() if r.rule == "identifiability")


def _cell(rule: Column, rules, row, printed, found, paper, changes) -> Cell:
    def cell(deviation, allowed, inside, basis=rule.basis, one_sided=False):
        return Cell(rule.table, row, rule.name, printed, found, deviation, allowed, inside, rule.kind_of(row), basis, "", one_sided)

    theirs, value = number(printed), number(found)
    if rule.rule == "shown":
        deviation = None if theirs is None or value is None else value - theirs
        return Cell(rule.table, row, rule.name, printed, found, deviation, None, True, rule.kind_of(row), rule.basis, shown=True)
    if rule.rule == "exact":
        return cell(None, None, printed == found)
    if theirs is None or value is None:
        return cell(None, None, printed == found)
    if rule.rule == "measurement":
        measured, error = number(paper.at[row, rule.measured]), number(paper.at[row, rule.error])
        points = abs(value) if rule.name == rule.error else 100.0 * abs(value / measured - 1.0)
        further = points - abs(error)
        return cell(further, rule.tolerance, further <= rule.tolerance, one_sided=True)
    deviation = value - theirs
    basis = rule.basis
    if rule.rule == "identifiability":
        if row not in changes:
            raise InputError(f"s6_updating/parameters.csv: no parameter {row}, a row of {rule.table}")
        points, words = changes[row]
        initial = number(paper.at[row, "initial_value"])
        allowed = points if rule.name.endswith("_pct") else points / 100.0 * initial
        basis = f"{words}. {basis}"
    else:
        allowed = _allowed(rule, rules, row, printed, paper)
    # 12 digits are written: a deviation of that size is not one
    return cell(deviation, allowed, abs(deviation) <= allowed * (1.0 + 1e-9) + 1e-12 * abs(theirs), basis)


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


def rms_of(cells, table: str, column: str) -> float | None:
    """Root mean square of (ours - paper) / paper over the cells of a column; None if there is nothing to take it of."""
    squares = []
    for cell in cells:
        paper, ours = number(cell.paper), number(cell.ours)
        if cell.table == table and cell.column == column and paper and ours is not None:
            squares.append((ours / paper - 1.0) ** 2)
    return (sum(squares) / len(squares)) ** 0.5 if squares else None


def row_for_csv(cell: Cell) -> list:
    used = "" if cell.used_pct == float("inf") else f"{cell.used_pct:.4g}"
    return [cell.table, cell.row, cell.column, cell.paper, cell.ours, csv_text(cell.deviation), csv_text(cell.allowed), used,
            cell.kind, cell.verdict, cell.basis]
