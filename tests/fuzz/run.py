"""make fuzz: builds the fuzz targets with clang, gives each its share of the seconds, says what was run and what was found.

    run.py SECONDS [--build DIR] [--results DIR] [--jobs N] [--keep] [TARGET ...]

Inputs begin from tests/fuzz/corpus/TARGET; what is new goes to RESULTS/corpus/TARGET, what crashes or hangs to RESULTS/found/TARGET.
--keep adds the new inputs that reach new code to tests/fuzz/corpus, minimised. Exit code 1 if anything was found. Where clang or its libFuzzer
is missing, one line says so and nothing is run.
"""
import argparse
import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = ROOT / "tests/fuzz/corpus"
INSTALL = "apt-get install --no-install-recommends clang-14 libclang-rt-14-dev llvm-14"

MEMORY_MB = 2048   # of a target: sound inputs of these sizes take some megabytes
TIMEOUT_S = 10     # of one input: sound ones take milliseconds
LARGEST_KB = 64    # of an input: what a reader does wrong, it does on small files
FINDINGS = 5       # of one target in one run; then it goes on no further
KEPT_KB = 4        # of an input that is kept in the repository, but for the first ones
ENVIRONMENT = {"ASAN_OPTIONS": f"suppressions={ROOT / 'tests/sanitize/address.supp'}:detect_leaks=1:allocator_may_return_null=1:handle_abort=1", "UBSAN_OPTIONS": "print_stacktrace=1:halt_on_error=1",
               "LSAN_OPTIONS": f"suppressions={ROOT / 'tests/sanitize/leaks.supp'}:print_suppressions=0",
               "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}


def compiler():
    """clang++ that links libFuzzer, or None."""
    for name in ("clang++-14", "clang++"):
        if shutil.which(name) is None:
            continue
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder, "probe.cpp")
            source.write_text('extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }\n')
            done = subprocess.run([name, "-fsanitize=fuzzer,address", str(source), "-o", folder + "/probe"], capture_output=True)
            if done.returncode == 0:
                return name
    return None


def build(clang, folder, jobs):
    commands = [["cmake", "-S", ".", "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo", f"-DCMAKE_CXX_COMPILER={clang}",
                 f"-DCMAKE_C_COMPILER={clang.replace('++', '')}", "-DTWINDECK_FUZZ=ON", "-DTWINDECK_WERROR=OFF", "-DTWINDECK_STD_THREADS=ON"],
                ["cmake", "--build", str(folder), "-j", str(jobs), "--target", "fuzzers"]]
    for command in commands:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
        if done.returncode != 0:
            print(done.stdout[-4000:] + done.stderr[-4000:], file=sys.stderr)
            sys.exit(f"fuzz: {' '.join(command[:2])} failed")


def fuzz(program, seconds, results):
    """Runs one target until its seconds are over; a finding ends a run of libFuzzer, and the next one begins."""
    name = program.name.removeprefix("fuzz_")
    new, found = results / "corpus" / name, results / "found" / name
    kept = CORPUS / name
    for folder in (new, found, kept):
        folder.mkdir(parents=True, exist_ok=True)
    before = set(found.iterdir())
    end, executions, log = time.monotonic() + seconds, 0, ""
    while (left := round(end - time.monotonic())) > 0 and len(set(found.iterdir()) - before) < FINDINGS:
        command = [str(program), f"-max_total_time={left}", f"-rss_limit_mb={MEMORY_MB}", f"-timeout={TIMEOUT_S}", f"-max_len={LARGEST_KB * 1024}",
                   "-print_final_stats=1", f"-artifact_prefix={found}/", str(new), str(kept)]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", env={**os.environ, **ENVIRONMENT})
        log += done.stderr
        runs = re.findall(r"number_of_executed_units: (\d+)|^#(\d+)", done.stderr, re.M)
        executions += int(next(filter(None, runs[-1])) if runs else 0)
        if done.returncode == 0 and left >= seconds:
            break
        if done.returncode != 0 and not set(found.iterdir()) - before:
            sys.exit(f"fuzz: {program.name} does not run:\n{done.stderr[-3000:]}")
    (results / f"{name}.log").write_text(log)
    findings = [file.name for file in set(found.iterdir()) - before]
    count = lambda *kinds: sum(file.startswith(kinds) for file in findings)
    return {"target": name, "seconds": round(seconds), "executions": executions, "crashes": count("crash-", "leak-"), "hangs": count("timeout-", "slow-"),
            "out_of_memory": count("oom-"), "inputs": len(list(new.iterdir())) + len(list(kept.iterdir()))}


def keep(program, results):
    """Adds to the repository what reaches code that the kept inputs do not, smallest first."""
    name = program.name.removeprefix("fuzz_")
    new, kept = results / "corpus" / name, CORPUS / name
    with tempfile.TemporaryDirectory() as folder:
        merged = pathlib.Path(folder)
        subprocess.run([str(program), "-merge=1", f"-rss_limit_mb={MEMORY_MB}", f"-timeout={TIMEOUT_S}", str(merged), str(kept), str(new)],
                       capture_output=True, env={**os.environ, **ENVIRONMENT})
        there = {file.name for file in kept.iterdir()}
        for file in merged.iterdir():
            if file.stat().st_size <= 1024 * KEPT_KB and file.name not in there:
                shutil.copy(file, kept / file.name)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("seconds", type=float)
    arguments.add_argument("--build", type=pathlib.Path, default=ROOT / "build-fuzz")
    arguments.add_argument("--results", type=pathlib.Path, default=ROOT / "results/fuzz")
    arguments.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments.add_argument("--keep", action="store_true")
    arguments.add_argument("targets", nargs="*")
    asked = arguments.parse_args()
    clang = compiler()
    if clang is None:
        print(f"fuzz: skipped: it needs clang with libFuzzer ({INSTALL}); `make test` replays the kept inputs without it")
        return 0
    build(clang, asked.build, asked.jobs)
    programs = sorted(file for file in (asked.build / "bin").glob("fuzz_*") if not asked.targets or file.name.removeprefix("fuzz_") in asked.targets)
    rows = []
    for program in programs:
        rows.append(fuzz(program, asked.seconds / len(programs), asked.results))
        print("{target:<22} {executions:>10} executions in {seconds:>4} s, {crashes} crashes, {hangs} hangs, {out_of_memory} out of memory, {inputs} inputs"
              .format(**rows[-1]), flush=True)
        if asked.keep:
            keep(program, asked.results)
    with open(asked.results / "fuzz.csv", "w", newline="") as stream:
        table = csv.DictWriter(stream, rows[0].keys(), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    bad = sum(row["crashes"] + row["hangs"] + row["out_of_memory"] for row in rows)
    print(f"fuzz: {sum(row['executions'] for row in rows)} executions of {len(rows)} targets, {bad} findings" +
          (f"; see {asked.results / 'found'}, and put each into tests/fuzz/corpus when it is mended" if bad else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
