"""python3 -m twindeck_compare results/x results/y [--out FOLDER]: what differs between two runs (make compare A=results/x B=results/y)"""
import argparse
import sys
from pathlib import Path

from twindeck import InputError, compare
from twindeck.tables import with_units
from twindeck.writing import csv_text, write_files

from .names import file_name, run_names
from .page import page_text
from .terminal import terminal_text

EXAMPLES = """examples:
  make compare A=results/my_bridge B=results/my_bridge_winter
  make compare A=results/my_bridge/s6_updating B=results/trial/s6_updating

exit codes: 0 done, whatever differs; 2 bad input (one line on stderr)"""


def main(arguments) -> int:
    options = _parse(arguments)
    try:
        if not options.a or not options.b:
            raise InputError("two runs are needed: make compare A=results/x B=results/y")
        found = compare(options.a, options.b)
        names = run_names(found.a.folder, found.b.folder)
        stem = file_name(names)
        csv = csv_text(with_units(found.table.astype(object)))
        write_files(options.out, {f"{stem}.csv": csv, f"{stem}.html": page_text(found, names)})
    except InputError as problem:
        print(f"compare: {problem}", file=sys.stderr)
        return 2
    print(terminal_text(found, names))
    print(f"all {len(found.table)} compared things: {options.out / stem}.csv and .html")
    return 0


def _parse(arguments):
    parser = argparse.ArgumentParser(prog="twindeck_compare", description=__doc__, epilog=EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", nargs="?", default="", help="results folder of the first run, or of one of its steps")
    parser.add_argument("b", nargs="?", default="", help="the same of the second run")
    parser.add_argument("--out", type=Path, default=Path("results/compare"), help="folder for the CSV file and the page (default results/compare)")
    return parser.parse_args(arguments)
