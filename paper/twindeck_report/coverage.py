"""Which printed numbers of the paper's tables are among the cells of the check. None may be missing."""
from collections import Counter

from .cells import number
from .study import Study
from .tolerances import Tolerances


def printed_numbers(study: Study, tolerances: Tolerances) -> dict:
    """{table: [(row position, column), ...]}: every number in the paper's tables but those that only name a row."""
    found = {}
    for path in sorted((study.data / "paper").glob("table_*.csv")):
        table = study.read_csv(path, text=True)
        names = tolerances.keys.get(path.stem, "").split("+")
        found[path.stem] = [(i, column) for column in table.columns if column not in names
                            for i, text in enumerate(table[column]) if number(text) is not None]
    return found


def lacking(study: Study, tolerances: Tolerances) -> list:
    """["table_10 column MAC_1X: 9 printed numbers without a rule", ...]"""
    lines = []
    for table, cells in printed_numbers(study, tolerances).items():
        ruled = tolerances.columns.get(table, {})
        without = Counter(column for _, column in cells if column not in ruled)
        lines += [f"{table} column {column}: {count} printed numbers without a rule in tolerances.toml" for column, count in without.items()]
    return lines


def counts(study: Study, tolerances: Tolerances, cells: list) -> list:
    """[(table, printed numbers, of those in the check, {kind: count})] by table of the paper."""
    rows = []
    for table, printed in printed_numbers(study, tolerances).items():
        own = [cell for cell in cells if cell.table == table and number(cell.paper) is not None]
        rows.append((table, len(printed), len(own), dict(sorted(Counter(cell.kind for cell in own).items()))))
    return rows
