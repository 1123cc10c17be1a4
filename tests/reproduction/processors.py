"""The study and the tests as other processors compute them: `make processors`.

OpenBLAS picks its kernels by the processor; another set can be asked for. Under each the study is run into
results/processors/NAME/STUDY and the tests are run. Then every numeric column of every table and of every step's CSV is compared with the
same under the first kernel: results/processors/columns.csv (kernel, file, column, change relative to the column's largest number, the
row where) and tests.csv (kernel, tests, failed). The report shows both with its provenance.

processors.py BUILD STUDY [--kernels A,B] [--no-tests] [--no-study]. Exit code 1 if a test fails.
"""
import argparse
import csv
import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from columns import changes, write_changes  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
OUT = pathlib.Path("results") / "processors"
# Name -> flags of /proc/cpuinfo that the kernels need. OpenBLAS takes one of a lesser machine, never of a greater. The product has no
# instructions of its own to choose but where two widths give the same bytes (wind/wave_sums).
KERNELS = {
    "Nehalem": {"sse4_2"},
    "Sandybridge": {"avx"},
    "Haswell": {"avx2", "fma"},
    "Zen": {"avx2", "fma"},
    "SkylakeX": {"avx512f", "avx512dq", "avx512vl"},
}
TESTS_LINE = re.compile(r"(\d+)% tests passed, (\d+) tests failed out of (\d+)")


def runnable():
    flags = set(re.search(r"^flags\s*:(.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.M).group(1).split())
    return [name for name, needed in KERNELS.items() if needed <= flags]


def environment(name):
    return {**os.environ, "OPENBLAS_CORETYPE": name}


def run_study(name, study):
    """The steps, tables and figures of the study under this kernel; the report is not needed."""
    results = OUT / name / study
    subprocess.run(["make", "--no-print-directory", "tables", "NO_BUILD=1", f"STUDY={study}", f"RESULTS={results}"], cwd=ROOT, env=environment(name),
                   check=True, stdout=subprocess.DEVNULL)


def run_tests(name, build):
    """(tests, names of those that failed). A failed one is run once more alone, so that a time limit on a busy machine is no verdict."""
    done = subprocess.run(["ctest", "-j2"], cwd=build, env=environment(name), capture_output=True, text=True)
    counts = TESTS_LINE.search(done.stdout)
    if not counts:
        raise SystemExit(f"processors: ctest under {name} printed no result:\n{done.stdout[-2000:]}")
    failed = []
    if int(counts[2]):
        again = subprocess.run(["ctest", "--rerun-failed", "--output-on-failure"], cwd=build, env=environment(name), capture_output=True, text=True)
        failed = re.findall(r"^\s*\d+ - (\S+) \(", again.stdout, re.M)
    return int(counts[3]), failed


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("study")
    parser.add_argument("--kernels", default="")
    parser.add_argument("--no-tests", action="store_true")
    parser.add_argument("--no-study", action="store_true")
    options = parser.parse_args()
    able = runnable()
    names = [n for n in options.kernels.split(",") if n] or able
    for name in names:
        if name not in able:
            print(f"processors: {name} is not for this processor: skipped" if name in KERNELS
                  else f"processors: unknown kernel '{name}'; known are {', '.join(KERNELS)}", file=sys.stderr)
    names = [n for n in names if n in able]
    out = ROOT / OUT
    out.mkdir(parents=True, exist_ok=True)
    bad = False
    tests = []
    for name in names:
        if not options.no_study:
            print(f"processors: {options.study} under {name}", flush=True)
            run_study(name, options.study)
        if not options.no_tests:
            print(f"processors: tests under {name}", flush=True)
            count, failed = run_tests(name, options.build)
            tests.append([name, count, len(failed), " ".join(failed)])
            print(f"processors: {name}: {count} tests, {len(failed)} failed {' '.join(failed)}", flush=True)
            bad = bad or bool(failed)
            with open(out / "tests.csv", "w", newline="") as f:
                csv.writer(f).writerows([["kernel", "tests", "failed", "names"], *tests])
    here = [n for n in able if (out / n / options.study / "tables" / "manifest.json").exists()]
    moved = {name: list(changes(out / here[0] / options.study, out / name / options.study)) for name in here[1:]}
    for name, line in write_changes(out / "columns.csv", "kernel", moved).items():
        print(f"processors: {name} against {here[0]}: {line}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
