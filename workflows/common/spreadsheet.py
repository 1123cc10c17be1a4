"""The first sheet of a workbook (.xlsx) as CSV on stdout: python3 -I spreadsheet.py BOOK.

The executables call it as a process. Formulas give the value that the workbook keeps of them, dates and times are ISO 8601, empty
cells and rows at the end are left out. Exit codes: 3 no workbook, 4 no openpyxl, 5 longer than a table may be, 6 nothing on the first sheet.
"""
import csv
import datetime
import io
import sys

LONGEST = 2_000_000_000  # bytes, as io::longest_text


def text(value):
    """A cell as a table has it: whole numbers without a point, all digits of others."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    if isinstance(value, (datetime.datetime, datetime.date, datetime.time)):
        return value.isoformat(" ") if isinstance(value, datetime.datetime) else value.isoformat()
    return str(value)


def main(path):
    try:
        import openpyxl
    except ImportError:
        return 4
    try:
        sheets = openpyxl.load_workbook(path, read_only=True, data_only=True).worksheets  # none where there are charts alone
        written = filled = 0
        for row in sheets[0].iter_rows(values_only=True) if sheets else ():
            cells = [text(value) for value in row]
            while cells and not cells[-1]:
                cells.pop()
            line = io.StringIO()
            csv.writer(line, lineterminator="\n").writerow(cells)
            written += len(line.getvalue())
            if written > LONGEST:
                return 5
            filled += bool(cells)
            if cells:
                sys.stdout.write(line.getvalue())
    except Exception:  # openpyxl has an error of its own for each way in which a file is no workbook
        return 3
    return 0 if filled else 6


if __name__ == "__main__":
    sys.stdout.reconfigure(encoding="utf-8")
    sys.exit(main(sys.argv[1]))
