"""orders.toml: orderings and signs that carry the paper's conclusions, checked on our tables."""
from dataclasses import dataclass

from .cells import number
from .compare import load_table
from .errors import InputError
from .study import Study


@dataclass
class Order:
    name: str
    statement: str
    basis: str
    holds: bool
    found: str  # the numbers that decide
    known: str = ""  # why it may not hold

    @property
    def verdict(self) -> str:
        if self.known:
            return "stale entry" if self.holds else "known"
        return "holds" if self.holds else "does not hold"


def check_orders(study: Study, keys: dict, skip_missing: bool = False) -> list:
    """@param skip_missing  leave out an order whose table or file is not there"""
    path = study.data / "orders.toml"
    orders = []
    for i, entry in enumerate(study.read_toml(path).get("order", []), 1):
        try:
            orders.append(_check(study, keys, f"{path}: order {i}", entry))
        except InputError:
            if not skip_missing:
                raise
    return orders


def _check(study: Study, keys: dict, where: str, entry: dict) -> Order:
    for key in ("name", "statement", "basis", "rule"):
        if not isinstance(entry.get(key), str) or not entry[key].strip():
            raise InputError(f"{where}: no {key}")
    rule = RULES.get(entry["rule"])
    if rule is None:
        raise InputError(f"{where}: rule {entry['rule']!r}; expected one of {', '.join(RULES)}")
    holds, found = rule(lambda reference: _values(study, keys, where, reference), where, entry)
    return Order(entry["name"], entry["statement"], entry["basis"], holds, found)


def _values(study: Study, keys: dict, where: str, reference) -> dict:
    """{row: number} of "table_09.error_pct", or of a step's file: "s6_updating/costs.csv point cost", its key and its column."""
    if ".csv " in str(reference):
        file, key, column = str(reference).split()
        rows = study.step_csv(file, [key, column], text=True)
        return {row: number(text) for row, text in zip(rows[key], rows[column]) if number(text) is not None}
    table, _, column = str(reference).partition(".")
    if table not in keys:
        raise InputError(f"{where}: {reference!r}: expected \"table_NN.column\" of a compared table")
    frame = load_table(study, table, keys[table])
    if column not in frame.columns:
        raise InputError(f"{where}: {reference!r}: {table} has no column {column}")
    return {row: number(text) for row, text in frame[column].items() if number(text) is not None}


def _ascending(values, where, entry):
    column = list(values(entry.get("column")).values())
    falls = [f"{a:.4g} before {b:.4g}" for a, b in zip(column, column[1:]) if not a < b]
    return bool(column) and not falls, falls[0] if falls else f"{len(column)} values"


def _mean_abs_below(values, where, entry):
    """Mean absolute value of `left` below that of `right`; `common = true`: over the rows that both have."""
    left, right = values(entry.get("left")), values(entry.get("right"))
    if entry.get("common"):
        rows = [r for r in left if r in right]
        left, right = {r: left[r] for r in rows}, {r: right[r] for r in rows}
    a, b = _mean(map(abs, left.values())), _mean(map(abs, right.values()))
    return a is not None and b is not None and a < b, f"{_text(a)} against {_text(b)}"


def _mean_above(values, where, entry):
    """Mean of `left` above that of `right`, over the rows that both have."""
    left, right = values(entry.get("left")), values(entry.get("right"))
    rows = [r for r in left if r in right]
    a, b = _mean(left[r] for r in rows), _mean(right[r] for r in rows)
    return a is not None and b is not None and a > b, f"{_text(a)} against {_text(b)}"


def _mean_sign(values, where, entry):
    """Sign of the mean of `column` over `rows` (all if none are named)."""
    if entry.get("sign") not in ("positive", "negative"):
        raise InputError(f"{where}: sign {entry.get('sign')!r}; expected positive or negative")
    column = values(entry.get("column"))
    rows = entry.get("rows", list(column))
    if any(r not in column for r in rows):
        return False, f"no value in row {next(r for r in rows if r not in column)}"
    mean = _mean(column[r] for r in rows)
    return mean is not None and (mean > 0) == (entry["sign"] == "positive") and mean != 0, f"mean {_text(mean)}"


def _ranking(values, where, entry):
    """Rows of `column` rank as `chain` says: "C > H > D >= G = I > A"; `equal`: relative difference that counts as none."""
    words = str(entry.get("chain", "")).split()
    rows, relations = words[::2], words[1::2]
    if len(rows) < 2 or len(rows) != len(relations) + 1 or any(r not in (">", ">=", "=") for r in relations):
        raise InputError(f"{where}: chain {entry.get('chain')!r}; expected rows with >, >= or = between them")
    equal = entry.get("equal", 0.0)
    column = values(entry.get("column"))
    if any(row not in column for row in rows):
        return False, f"no value in row {next(row for row in rows if row not in column)}"
    wrong = []
    for a, relation, b in zip(rows, relations, rows[1:]):
        apart = column[a] / column[b] - 1.0
        holds = {">": apart > equal, ">=": apart >= -equal, "=": abs(apart) <= equal}[relation]
        if not holds:
            wrong.append(f"{a} {column[a]:.4g} {relation} {b} {column[b]:.4g} is not so")
    return not wrong, wrong[0] if wrong else ", ".join(f"{row} {column[row]:.4g}" for row in rows)


def _mean(values):
    values = list(values)
    return sum(values) / len(values) if values else None


def _text(value):
    return "nothing" if value is None else f"{value:.4g}"


RULES = {"ascending": _ascending, "mean_abs_below": _mean_abs_below, "mean_above": _mean_above, "mean_sign": _mean_sign, "ranking": _ranking}
