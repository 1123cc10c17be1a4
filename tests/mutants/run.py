"""make mutants N=40 SEED=7: one fault at a time is put into the rooms of numerics, and the tests say whether they notice.

    run.py N SEED [--build DIR] [--jobs N] [--room fe]

The faults are drawn by the seed: a kind first (faults.py), then one of its places. The sources are copied to DIR/source, so that nobody's tree
is touched, and compiled there one by one. A mutant is built as far as the tests that run need it: first the test of its room, then those of
the rooms that use it, then the laws and the verification, at last the numbers of whole runs that `make test` holds where they are: the smoke
chain and diagnoses. The first test that fails has caught it; one that takes longer than TOO_LONG times what it takes without a fault has
caught it too. A fault that does not compile is drawn anew. So is one that equivalent.toml lists: no number can tell it from the original,
and the entry says why.

Results: DIR/mutants.csv (mutant, file, line, kind, before, after, outcome, by, seconds), written after each, so that a run can be broken off.
The last line says how many were caught. Exit code 1 if LEAST_CAUGHT of them were not, 2 for bad arguments.
"""
import argparse
import csv
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(HERE.parent / "coverage")]
from faults import KINDS, faults_by_kind  # noqa: E402
from rooms import BESIDE, NUMERICS  # noqa: E402

LEAST_CAUGHT = 0.9    # of the mutants: 36 of 40
TOO_LONG = 5.0        # times what a test takes without a fault: an endless loop, or one of another order
SLACK_S = 20.0        # beside it, for tests of milliseconds on a busy machine
# As `make sanitize` compiles the same tests: Eigen and the standard library say where sizes do not match and indices lie outside.
ASSERTING = ("-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1", "-DCMAKE_CXX_FLAGS=-D_GLIBCXX_ASSERTIONS")
# Tests of whole runs: what is built for them, and how they are started, from the copy of the sources.
SMOKE, BLIND, RECORDS = "held numbers of the smoke chain", "held numbers of blind diagnoses", "held numbers of identified records"
CHAIN_AND_GIRDER, DIAGNOSED_SMOKE = "held numbers of two diagnoses", "held numbers of a diagnosis of the smoke chain"
HELD = [sys.executable, "-m", "unittest", "tests/steps/test_held_numbers.py", "-k"]
WHOLE_RUNS = {SMOKE: ("executables", [*HELD, "test_the_smoke_chain"]), CHAIN_AND_GIRDER: ("s9_diagnosis", [*HELD, "test_diagnoses_of"]),
              RECORDS: ("test_blind_modes", ["test_blind_modes", "--gtest_brief=1"]), DIAGNOSED_SMOKE: ("executables", [*HELD, "test_a_diagnosis_of"]),
              BLIND: ("blind_form", ["blind_form", "7", "9000", "--held", "tests/blind/form/held_9000.csv"])}
COLUMNS = ("mutant", "file", "line", "kind", "before", "after", "outcome", "by", "seconds")


def sources(root, rooms):
    return [file.relative_to(root) for room in rooms for file in sorted((root / "src" / room).rglob("*.[ch]pp"))
            if str(file.parent.relative_to(root / "src")) not in BESIDE]


def users(uses, library):
    """The libraries that use this one, directly or through others, in the order of layers.toml."""
    reached = {library}
    for name, used in uses.items():  # from the lower layers to the higher
        if reached & set(used):
            reached.add(name)
    return [name for name in uses if name in reached and name != library]


def tests_of(library, uses, known):
    """Names of the test executables that link this library, its own first, the laws, the verification and whole runs last."""
    higher = users(uses, library)
    names = ["test_" + name.replace("/", "_") for name in (library, *higher)]
    of_diagnosis = library.split("/")[0] == "diagnosis"  # the smoke chain ends before the diagnosis
    whole = [RECORDS] if "identification" in (library, *higher) else []
    whole += [] if of_diagnosis else [SMOKE]
    if of_diagnosis or "diagnosis" in higher:
        whole += [CHAIN_AND_GIRDER, DIAGNOSED_SMOKE, BLIND]
    return [name for name in names if name in known] + ["test_laws", "test_verification"] + whole


def library_of(file, uses):
    """src/diagnosis/inference/guard.cpp -> diagnosis/inference"""
    folder = pathlib.Path(file).parent.relative_to("src")
    return str(folder) if str(folder) in uses else folder.parts[0]


def draws(faults, seed):
    """Without end: faults, a kind first, then one of its places; each at most once."""
    generator = random.Random(seed)
    left = {kind: list(found) for kind, found in faults.items() if found}
    while left:
        kind = generator.choice([k for k in KINDS if k in left])
        yield left[kind].pop(generator.randrange(len(left[kind])))
        if not left[kind]:
            del left[kind]


class Bench:
    """A copy of the sources with a build of its own."""

    def __init__(self, folder, jobs):
        self.source, self.build, self.jobs = folder / "source", folder / "build", jobs
        self.seconds = {}

    def prepare(self):
        listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
        for name in filter(lambda n: (ROOT / n).is_file(), listed.splitlines()):
            there = self.source / name
            if not there.exists() or there.read_bytes() != (ROOT / name).read_bytes():
                there.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, there)
        subprocess.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DTWINDECK_UNITY=OFF",
                        "-DTWINDECK_WERROR=OFF", *ASSERTING], check=True, stdout=subprocess.DEVNULL)
        self.known = (self.build / "unit_tests.txt").read_text().strip().split(";")

    def make(self, test):
        target = WHOLE_RUNS[test][0] if test in WHOLE_RUNS else test
        return subprocess.run(["cmake", "--build", self.build, "-j", str(self.jobs), "--target", target], capture_output=True).returncode == 0

    def run(self, test, limit=None):
        """True if the test passes, None if it takes longer than the limit."""
        binaries = self.build / "bin"
        command, folder = [binaries / test, "--gtest_brief=1", "--gtest_fail_fast"], self.build
        if test in WHOLE_RUNS:
            words, folder = WHOLE_RUNS[test][1], self.source
            command = [binaries / words[0] if (binaries / words[0]).exists() else words[0], *words[1:]]
        running = subprocess.Popen(command, cwd=folder, env={**os.environ, "TWINDECK_BIN": str(binaries)}, start_new_session=True,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            return running.wait(limit) == 0
        except subprocess.TimeoutExpired:
            os.killpg(running.pid, signal.SIGKILL)  # a whole run has children
            running.wait()
            return None

    def without_a_fault(self, tests):
        """Builds and times the tests on the sound sources."""
        for test in tests:
            if test in self.seconds:
                continue
            print(f"mutants: {test} without a fault", flush=True)
            if not self.make(test):
                sys.exit(f"mutants: {test} does not compile without a fault")
            start = time.monotonic()
            if not self.run(test):
                sys.exit(f"mutants: {test} fails without a fault: mend that first")
            self.seconds[test] = time.monotonic() - start

    def judge(self, fault, tests):
        """(outcome, the test that noticed): caught, survived, or `does not compile`."""
        self.without_a_fault(tests)
        file = self.source / fault.file
        text = file.read_text()
        file.write_text(fault.applied(text))
        try:
            for i, test in enumerate(tests):
                if not self.make(test):
                    return ("does not compile", "") if i == 0 else ("caught", f"{test} does not compile")
                passed = self.run(test, TOO_LONG * self.seconds[test] + SLACK_S)
                if not passed:
                    return "caught", test + ("" if passed is False else ", which did not end")
            return "survived", ""
        finally:
            file.write_text(text)


def equivalent(entries, fault, text):
    before, after = fault.shown(text)
    return any(e["file"] == fault.file and e["before"] == before and e["after"] == after for e in entries)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("n", type=int, metavar="N")
    parser.add_argument("seed", type=int, metavar="SEED")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build-mutants")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--room", choices=NUMERICS, help="faults of this room alone")
    options = parser.parse_args()
    uses = tomllib.loads((ROOT / "src/layers.toml").read_text())["uses"]
    entries = tomllib.loads((HERE / "equivalent.toml").read_text()).get("mutant", [])
    bench = Bench(options.build.resolve(), options.jobs)
    bench.prepare()
    rows, refused = [], 0
    for fault in draws(faults_by_kind(ROOT, sources(ROOT, [options.room] if options.room else NUMERICS)), options.seed):
        if len(rows) == options.n:
            break
        text = (ROOT / fault.file).read_text()
        if equivalent(entries, fault, text):
            print(f"mutants: {fault.file}:{fault.line(text)} is equivalent, drawn anew", flush=True)
            continue
        start = time.monotonic()
        outcome, by = bench.judge(fault, tests_of(library_of(fault.file, uses), uses, bench.known))
        if outcome == "does not compile":
            refused += 1
            continue
        rows.append((len(rows) + 1, fault.file, fault.line(text), fault.kind, *fault.shown(text), outcome, by, f"{time.monotonic() - start:.0f}"))
        print(f"mutants: {len(rows)} of {options.n}: {fault.file}:{fault.line(text)}, {fault.kind}: {outcome} {by}", flush=True)
        with open(options.build / "mutants.csv", "w", newline="", encoding="utf-8") as stream:
            csv.writer(stream).writerows([COLUMNS, *rows])
    caught = sum(row[6] == "caught" for row in rows)
    print(f"mutants: {caught} of {len(rows)} caught, seed {options.seed}; {refused} more did not compile")
    return 0 if caught >= LEAST_CAUGHT * len(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
