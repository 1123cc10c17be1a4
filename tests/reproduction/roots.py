"""The study made twice from nothing, and with other builds: `make reproduce-check`.

The committed tree is cloned into two folders of different names and lengths; in each `make all` compiles and runs everything. Every file of the
results is compared byte by byte: results/reproduce/files.csv (file, same, why). Then the steps are built with another compiler and for this very
processor; every numeric column of their tables and of every step's CSV is compared with the first build's: results/reproduce/columns.csv (build,
file, column, change relative to the column's largest number, the row where).

roots.py STUDY [--builds clang,native] [--keep]. Exit code 1 if a file differs between the roots for no reason that is known.
"""
import argparse
import csv
import fnmatch
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from columns import changes, write_changes  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUT = pathlib.Path("results") / "reproduce"
# Build -> environment of its configuration. Clang's OpenMP is a package of its own (libomp-dev).
BUILDS = {
    "clang": {"CXX": "clang++"},
    "native": {"CXXFLAGS": "-march=native"},
}
# Files that tell how long a run took or when it was. A manifest and a diagnosis are compared without these keys.
TELLS_TIME = {
    "report/report.html": "shows the time and the seconds of the run",
    "figures/fig_01.*": "prints the seconds of every step",
}
TIME_KEYS = {"seconds", "time", "started", "finished"}
# A manifest's hashes of files that tell time, which are compared themselves.
HASHED_WITH_TIME = ("*manifest.json", "*diagnosis.json", "*fig_01.*")


def clone(folder):
    """The committed tree; the compiler's cache is off, so that each root compiles."""
    subprocess.run(["git", "clone", "-q", "--no-hardlinks", str(ROOT), str(folder)], check=True)
    return folder


def run(folder, *arguments, **variables):
    """Runs make in a root; its output is shown if it fails."""
    done = subprocess.run(["make", "--no-print-directory", *arguments], cwd=folder, env={**os.environ, "CCACHE_DISABLE": "1", **variables},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        raise SystemExit(f"reproduce-check: make {' '.join(arguments)} in {folder} ends with {done.returncode}:\n{done.stdout[-3000:]}")


def timeless(value):
    """A JSON value without what tells time, and without hashes of what tells time."""
    if isinstance(value, dict):
        return {k: timeless(v) for k, v in value.items() if k not in TIME_KEYS and not any(fnmatch.fnmatch(k, pattern) for pattern in HASHED_WITH_TIME)}
    return [timeless(v) for v in value] if isinstance(value, list) else value


def same(a, b):
    if a.read_bytes() == b.read_bytes():
        return True
    return a.suffix == ".json" and timeless(json.loads(a.read_text())) == timeless(json.loads(b.read_text()))


def compared(first, second):
    """(file, same, why it may differ) of every file of either results."""
    names = sorted({f.relative_to(r) for r in (first, second) for f in r.rglob("*") if f.is_file()})
    for name in names:
        a, b = first / name, second / name
        why = next((reason for pattern, reason in TELLS_TIME.items() if fnmatch.fnmatch(name.as_posix(), pattern)), "")
        yield name.as_posix(), a.is_file() and b.is_file() and same(a, b), why


def compare_roots(study, roots):
    """Makes both and writes files.csv. @return number of files that differ without a reason"""
    for root in roots:  # both before either is made: a commit meanwhile would be a difference
        clone(root)
    for root in roots:
        started = time.monotonic()
        run(root, "all", f"STUDY={study}")
        print(f"reproduce-check: make all in {root}: {(time.monotonic() - started) / 60:.1f} minutes", flush=True)
    rows = list(compared(*(root / "results" / study for root in roots)))
    with open(ROOT / OUT / "files.csv", "w", newline="") as f:
        csv.writer(f).writerows([["file", "same", "why"], *([name, "yes" if equal else "no", "" if equal else why] for name, equal, why in rows)])
    different = [name for name, equal, why in rows if not equal and not why]
    print(f"reproduce-check: {len(rows)} files, {sum(not r[1] and bool(r[2]) for r in rows)} differ in what tells time, {len(different)} in results "
          + " ".join(different), flush=True)
    return len(different)


def compare_builds(study, root, builds):
    """Builds the steps anew in the first root and writes columns.csv."""
    moved = {}
    for name in builds:
        if name == "clang" and not shutil.which("clang++"):
            print("reproduce-check: clang++ is not here: skipped (apt-get install --no-install-recommends clang libomp-dev)", file=sys.stderr)
            continue
        print(f"reproduce-check: {study} built as {name}", flush=True)
        run(root, "build", f"BUILD=build-{name}", **BUILDS[name])
        run(root, "tables", "NO_BUILD=1", f"BUILD=build-{name}", f"STUDY={study}", f"RESULTS=results/{name}")
        moved[name] = list(changes(root / "results" / study, root / "results" / name))
    for name, line in write_changes(ROOT / OUT / "columns.csv", "build", moved).items():
        print(f"reproduce-check: {name}: {line}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study")
    parser.add_argument("--builds", default=",".join(BUILDS))
    parser.add_argument("--keep", action="store_true", help="leave the roots where they are")
    options = parser.parse_args()
    builds = [b for b in options.builds.split(",") if b]
    if unknown := set(builds) - set(BUILDS):
        parser.error(f"unknown build {', '.join(sorted(unknown))}; known are {', '.join(BUILDS)}")
    (ROOT / OUT).mkdir(parents=True, exist_ok=True)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="twindeck_reproduce_"))
    try:
        roots = [folder / "a", folder / "another_place" / "of_the_same_tree"]
        different = compare_roots(options.study, roots)
        compare_builds(options.study, roots[0], builds)
    finally:
        if options.keep:
            print(f"reproduce-check: the roots are in {folder}")
        else:
            shutil.rmtree(folder)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
