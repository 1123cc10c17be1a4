"""Every table below results/STUDY in one workbook, a sheet a table: `twindeck export --xlsx [STUDY]`, `make xlsx`.

The first sheet lists the tables with their files. Numbers are cells of numbers, all else is text; a cell that begins with '=' stays
text. A table of more rows or columns than a sheet has is left out, and named.
"""
import argparse
import csv
import pathlib
import re
import sys

ROWS, COLUMNS, LETTERS = 1_048_576, 16_384, 31  # of a sheet, of its name
PARTS = {"records", "figures"}  # folders that hold no tables of results


def sheet_name(path, taken):
    """Step and table, as far as they fit, unlike all that is taken."""
    step, table = path.parts[0].split("_")[0] if len(path.parts) > 1 else "", " ".join(path.with_suffix("").parts[1:] or (path.stem,))
    whole = re.sub(r"[\[\]:*?/\\']", "_", f"{step} {table}".strip())
    name, number = whole[:LETTERS], 2
    while name.lower() in taken:
        end = f" {number}"
        name, number = whole[: LETTERS - len(end)] + end, number + 1
    taken.add(name.lower())
    return name


def value(text):
    """A number where the text is one; infinite and missing values have no cell of numbers."""
    try:
        number = float(text)
    except ValueError:
        return text
    if number in (float("inf"), float("-inf")) or number != number:
        return text
    return int(text) if re.fullmatch(r"-?[0-9]{1,15}", text) else number


def tables(root):
    """CSV files below the results, in the order of the steps."""
    def order(path):
        digits = re.match(r"s([0-9]+)_", path.parts[0])
        return (int(digits.group(1)) if digits else 99, path.as_posix())

    found = (path.relative_to(root) for path in root.rglob("*.csv"))
    return sorted((path for path in found if not PARTS & set(path.parts) and not any(part.startswith(".") for part in path.parts)), key=order)


def write(root, out, openpyxl):
    """@return  the number of tables written, lines on those left out"""
    def cells(sheet, row):
        made = []
        for item in row:
            cell = openpyxl.cell.WriteOnlyCell(sheet, value=item)
            if isinstance(item, str):
                cell.data_type = "s"  # '=…' is text of a table, no formula
            made.append(cell)
        return made

    book = openpyxl.Workbook(write_only=True)
    contents, taken, left_out, written = book.create_sheet("contents"), {"contents"}, [], 0
    contents.append(["sheet", "file", "rows"])
    for path in tables(root):
        with open(root / path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        if not rows:
            continue
        if len(rows) > ROWS or max(map(len, rows)) > COLUMNS:
            left_out.append(f"{path} is left out: {len(rows)} rows and {max(map(len, rows))} columns are more than a sheet has")
            continue
        name = sheet_name(path, taken)
        sheet = book.create_sheet(name)
        for number, row in enumerate(rows):
            sheet.append(cells(sheet, row if number == 0 else map(value, row)))
        contents.append(cells(contents, [name, path.as_posix(), len(rows) - 1]))
        written += 1
    if written:
        part = out.with_name(out.name + ".part")
        book.save(part)
        part.replace(out)
    return written, left_out


def main(arguments):
    parser = argparse.ArgumentParser(prog="twindeck export", description="write the tables of a study into one workbook")
    parser.add_argument("--xlsx", action="store_true", required=True, help="a workbook of Excel, the one format there is")
    parser.add_argument("results", type=pathlib.Path, help="folder of the results, results/STUDY")
    parser.add_argument("out", type=pathlib.Path, nargs="?", help="the workbook; RESULTS/tables.xlsx where it is left out")
    given = parser.parse_args(arguments)
    out = given.out or given.results / "tables.xlsx"

    def fail(line):
        print(f"twindeck export: {line}", file=sys.stderr)
        return 2

    try:
        import openpyxl
        import openpyxl.cell
    except ImportError:
        return fail("openpyxl, which writes workbooks, is not installed; apt-get install python3-openpyxl")
    if not given.results.is_dir():
        return fail(f"{given.results}: is no folder of results; run the study first: twindeck run")
    try:
        written, left_out = write(given.results, out, openpyxl)
    except OSError as problem:
        return fail(f"{problem.filename or out}: cannot be read or written: {problem.strerror}; check the path and your permissions")
    for line in left_out:
        print(f"twindeck export: note: {line}", file=sys.stderr)
    if not written:
        return fail(f"{given.results}: holds no table; run the study first: twindeck run")
    print(f"{written} tables in {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
