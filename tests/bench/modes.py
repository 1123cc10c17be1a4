"""Benchmarks of the modal solver against peers on the same matrices: ratios of medians, never a pass or a fail.

    python3 tests/bench/modes.py BIN BENCH OUT [RUNS]

BIN: folder of the executables; BENCH: the bench executable; OUT: folder for bench.csv. Each run of either side is a process of its
own, so that nothing is warm that would not be; all on one thread, in processor time.
"""
import csv
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

PEER = """
import resource, sys, time
import scipy.io, scipy.sparse.linalg
folder = sys.argv[1]
k, m = (scipy.io.mmread(folder + "/" + name).tocsc() for name in ("K.mtx", "M.mtx"))
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
start = time.process_time()
values = scipy.sparse.linalg.eigsh(k, 15, m, sigma=0.0, which="LM", return_eigenvectors=True)[0]
print("first_solve_s", time.process_time() - start)
print("peak_MB", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
for i, value in enumerate(sorted(values)):
    print(f"frequency_{i + 1}_Hz", value ** 0.5 / 6.283185307179586)
"""


def measures(*command):
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, env=environment)
    if done.returncode:
        raise SystemExit(f"bench: {command[0]} failed:\n{done.stderr}")
    return {name: float(value) for name, value in (line.split() for line in done.stdout.splitlines())}


def medians(runs):
    return {name: statistics.median(run[name] for run in runs) for name in runs[0]}


def main():
    binaries, bench, out = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
    count = int(sys.argv[4]) if len(sys.argv) > 4 else 5
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        subprocess.run([binaries / "s1_model", "--study", "workflows/ponte_del_mare", "--out", folder + "/s1_model", "--quiet",
                        "--set", "variant=refined", "--set", "meshes=[]", "--export-matrices"], check=True)
        export = time.perf_counter() - start
        step = []
        for _ in range(count):
            start = time.perf_counter()
            subprocess.run([binaries / "s1_model", "--study", "workflows/ponte_del_mare", "--out", folder + "/plain", "--quiet",
                            "--set", "meshes=[]", "--threads", "2"], check=True)
            step.append(time.perf_counter() - start)
        ours, peers = [], []
        for _ in range(count):  # by turns, so that both meet the same neighbours on the machine
            ours.append(measures(bench))
            peers.append(measures(sys.executable, "-c", PEER, folder + "/s1_model"))
    us, peer = medians(ours), medians(peers)
    apart = max(abs(us[f"frequency_{i}_Hz"] / peer[f"frequency_{i}_Hz"] - 1) for i in range(1, 16))
    rows = [
        ("degrees of freedom", us["degrees_of_freedom"], "-", ""),
        ("whole s1_model, two threads", statistics.median(step), "s", "without the mesh study"),
        ("s1_model with K.mtx and M.mtx", export, "s", "once"),
        ("generate, assemble, prestress", us["assemble_s"], "s", ""),
        ("15 modes, first solve", us["first_solve_s"], "s", "ordering, factorisation, eigenvectors"),
        ("15 modes, SciPy eigsh (ARPACK, SuperLU)", peer["first_solve_s"], "s", "shift-invert, sigma = 0, same K and M"),
        ("SciPy over ours", peer["first_solve_s"] / us["first_solve_s"], "-", "more is better; aim 2.5"),
        ("largest difference of frequencies", apart, "-", "relative"),
        ("solve after a 1 % change", us["resolve_s"], "s", ""),
        ("solve after a change over first solve", us["resolve_s"] / us["first_solve_s"], "-", "less is better; aim 0.5"),
        ("Jacobian, 15 frequencies by 15 parameters", us["jacobian_s"], "s", "exact"),
        ("Jacobian over one solve", us["jacobian_s"] / us["first_solve_s"], "-", "less is better; aim 0.25"),
        ("Jacobian by forward differences", us["jacobian_by_differences_s"], "s", ""),
        ("differences over exact", us["jacobian_by_differences_s"] / us["jacobian_s"], "-", "more is better"),
        ("peak memory, ours", us["peak_MB"], "MB", "assembly included"),
        ("peak memory, SciPy", peer["peak_MB"], "MB", "reading included"),
        ("peak memory, SciPy over ours", peer["peak_MB"] / us["peak_MB"], "-", "more is better"),
    ]
    with open(out / "bench.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["quantity", "median", "unit", "note"])
        writer.writerows((name, f"{value:.6g}", unit, note) for name, value, unit, note in rows)
    for name, value, unit, note in rows:
        print(f"{name:44} {value:12.4g} {unit:3} {note}")


main()
