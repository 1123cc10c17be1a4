"""tolerances.toml: for every compared column of every table its kind, its rule, and why that rule (the basis)."""
from dataclasses import dataclass

from .errors import InputError
from .study import Study

KINDS = ("input", "identity", "calibrated", "fit", "predicted", "recovered", "virtual", "unavailable")
CARRIED = ("input", "identity")  # kinds that nothing of ours was computed for
RULES = {
    "exact": "text equals the paper's text",
    "rounding": "inside half a unit of the last printed digit (times `tolerance`)",
    "absolute": "|ours - paper| <= tolerance, in the column's unit",
    "relative": "|ours - paper| <= tolerance |paper|",
    "error_of": "propagated: 100 / measured x what the column `of` may deviate",
    "shown": "beside the paper's, not compared: no claim of agreement",
}


@dataclass(frozen=True)
class Column:
    """The rule of one compared column."""

    table: str
    name: str
    kind: str
    rule: str
    tolerance: float
    basis: str
    of: str = ""  # error_of: the column it is computed from
    measured: str = ""  # error_of: the column with the measured value
    row_kinds: tuple = ()  # ((row, kind), ...) of rows of another kind than the column's
    repeats: str = ""  # "table_NN.column": rows that it has too are one number with ours, and are counted once
    null: str = ""  # what the column is judged with in place of ours (nulls.py)
    simplest: str = ""  # the simplest rule that recovers the column's numbers (simplest.py)

    def kind_of(self, row: str) -> str:
        return dict(self.row_kinds).get(row, self.kind)


@dataclass(frozen=True)
class RmsRule:
    """Limit on the root mean square of the relative deviations of a column."""

    table: str
    column: str
    limit: float
    basis: str


@dataclass(frozen=True)
class Tolerances:
    keys: dict  # table -> name of the column that names its rows
    columns: dict  # table -> {column: Column}
    rms: list

    def tables(self) -> list:
        return sorted(self.columns)


def read_tolerances(study: Study) -> Tolerances:
    path = study.data / "tolerances.toml"
    keys, columns, rms = {}, {}, []
    for table, entry in study.read_toml(path).items():
        if not isinstance(entry, dict) or not isinstance(entry.get("key"), str):
            raise InputError(f'{path}: {table}: expected a table with key = "<column that names the rows>" (several: "a+b")')
        keys[table] = entry["key"]
        columns[table] = {name: _column(path, table, name, rule) for name, rule in entry.get("columns", {}).items()}
        rms += [_rms(path, table, rule) for rule in entry.get("rms", [])]
    return Tolerances(keys, columns, rms)


def _column(path, table, name, rule) -> Column:
    where = f"{path}: {table}.columns.{name}"
    basis = _basis(where, rule)
    if rule.get("kind") not in KINDS:
        raise InputError(f"{where}: kind {rule.get('kind')!r}; expected one of {', '.join(KINDS)}")
    if rule.get("rule") not in RULES:
        raise InputError(f"{where}: rule {rule.get('rule')!r}; expected one of {', '.join(RULES)}")
    tolerance = rule.get("tolerance", 1.0 if rule["rule"] in ("rounding", "exact", "error_of", "shown") else None)
    if not isinstance(tolerance, (int, float)) or isinstance(tolerance, bool) or not 0 <= tolerance < float("inf"):
        raise InputError(f"{where}: tolerance {tolerance!r}; expected a number of at least 0")
    for key in ("of", "measured") if rule["rule"] == "error_of" else ():
        if not isinstance(rule.get(key), str):
            raise InputError(f"{where}: the rule {rule['rule']} needs {key} = \"<column>\"")
    row_kinds = rule.get("row_kinds", {})
    if not isinstance(row_kinds, dict) or any(kind not in KINDS for kind in row_kinds.values()):
        raise InputError(f"{where}: row_kinds {row_kinds!r}; expected {{ <row> = \"<kind>\" }} with one of {', '.join(KINDS)}")
    repeats, null, simplest = rule.get("repeats", ""), rule.get("null", ""), rule.get("simplest", "")
    if not isinstance(repeats, str) or (repeats and repeats.count(".") != 1):
        raise InputError(f'{where}: repeats {repeats!r}; expected "table_NN.column", the numbers that this column says again')
    if rule["rule"] != "shown" and rule["kind"] not in CARRIED and not null and not repeats:
        raise InputError(f"{where}: no null; name what the column is judged with in place of ours, or the column that it repeats")
    if rule["rule"] != "shown" and rule["kind"] == "recovered" and not simplest:
        raise InputError(f"{where}: no simplest; name the simplest rule that recovers these numbers")
    return Column(table, name, rule["kind"], rule["rule"], float(tolerance), basis, rule.get("of", ""), rule.get("measured", ""),
                  tuple(row_kinds.items()), repeats, null, simplest)


def _rms(path, table, rule) -> RmsRule:
    where = f"{path}: {table}.rms"
    basis = _basis(where, rule)
    if not isinstance(rule.get("column"), str) or not isinstance(rule.get("limit"), float):
        raise InputError(f'{where}: expected column = "<column>" and limit = <relative deviation>')
    return RmsRule(table, rule["column"], rule["limit"], basis)


def _basis(where, rule) -> str:
    """A tolerance that nobody can give a reason for is refused."""
    basis = rule.get("basis") if isinstance(rule, dict) else None
    if not isinstance(basis, str) or len(basis.split()) < 3:
        raise InputError(f"{where}: no basis; write the reason for this tolerance as a sentence")
    return basis
