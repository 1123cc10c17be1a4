"""Which columns of two runs of a study differ, and by how much."""
import csv

import pandas as pd

# Not results: what a run took and where it was.
NOT_COMPARED = {"seconds", "manifest"}
# Folders of a study that a run without report lacks: they show the others' numbers.
SHOWN = {"figures", "report"}
# Relative to the column's largest number: what rounding may move where numbers follow from given data.
ROUNDING = 1e-6


def changes(reference, other):
    """(file, column, relative change, row) of every numeric column of every CSV below the two folders; a file or row count that differs
    is a change without a number."""
    for file in sorted(reference.rglob("*.csv")):
        name = file.relative_to(reference)
        if "records" in name.parts or name.parts[0] in SHOWN:
            continue
        a = pd.read_csv(file)
        b = pd.read_csv(other / name) if (other / name).exists() else None
        if b is None or list(a.columns) != list(b.columns) or len(a) != len(b):
            yield str(name), "", float("inf"), "rows or columns differ"
            continue
        for column in a.columns:
            if column in NOT_COMPARED or a[column].equals(b[column]):
                continue
            x, y = pd.to_numeric(a[column], errors="coerce"), pd.to_numeric(b[column], errors="coerce")
            text = a[column].astype(str)[x.isna() | y.isna()] != b[column].astype(str)[x.isna() | y.isna()]
            if text.any():
                yield str(name), column, float("inf"), f"row {text.idxmax() + 1}: {a[column][text.idxmax()]} / {b[column][text.idxmax()]}"
                continue
            # An imaginary part is judged by the size of the whole number: beside a real one it may be rounding alone.
            whole = pd.to_numeric(a[column.removesuffix("_imag")], errors="coerce") if column.endswith("_imag") else x
            largest = max(x.abs().max(), whole.abs().max())
            difference = (x - y).abs()
            if largest > 0 and difference.max() > 0:
                yield str(name), column, difference.max() / largest, f"row {difference.idxmax() + 1}"


def write_changes(file, what, moved):
    """Writes the changes of several runs and tells each in words. @param what  name of the first column, such as kernel
    @param moved  run -> its changes @return run -> line"""
    with open(file, "w", newline="") as f:
        writer = csv.writer(f)
        writer.writerow([what, "file", "column", "relative_change", "where"])
        writer.writerows([name, *change] for name, found in moved.items() for change in found)
    return {name: _words(found) for name, found in moved.items()}


def _words(found):
    if not found:
        return "no column moves"
    file, column, change, where = max(found, key=lambda c: c[2])
    large = sum(c[2] > ROUNDING for c in found)
    return f"{len(found)} columns move, {large} by more than {ROUNDING:g}, most {file} {column} by {change:.2g} ({where})"
