"""What drivers of trials share: they run and time a step, and write a score beside the table of results."""
import csv
import pathlib
import subprocess
import time


def run(*arguments):
    """Seconds. A step that ends with another exit code than 0 is a RuntimeError with the last line of its stderr."""
    start = time.monotonic()
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{pathlib.Path(arguments[0]).name}: exit {done.returncode}: {(done.stderr.strip().splitlines() or [''])[-1]}")
    return time.monotonic() - start


def write_score(table, lines):
    """Beside a CSV of results the same name with .md. @param lines  of rows: (what, its rate in words)"""
    with open(table, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    versions = sorted({r["version"] for r in rows if r["version"]}) or ["step 9 was not run"]
    text = f"twindeck {', '.join(versions)}; {len(rows)} trials\n\n| | rate, exact 95 % interval |\n|---|---|\n"
    text += "".join(f"| {what} | {value} |\n" for what, value in lines(rows))
    table.with_suffix(".md").write_text(text, encoding="utf-8")
    print("\n" + text)
