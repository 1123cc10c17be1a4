"""Benchmark of the identification: CPU seconds and peak memory on the record of sysid_record.hpp, beside a NumPy SSI of the same work in
the same run and the peers' published figures. Prints ratios; judges nothing.

    python3 tests/bench/sysid.py [path of bench_sysid] [runs]
"""
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
# CPU seconds and MB on two cores, OpenBLAS, same kind of record (pyOMA2 1.4.2, KOMA).
PEERS = {"covariance": ("pyOMA2 cov, correlations", 1.1, 212), "data": ("pyOMA2 data-driven", 20.0, 3096),
         "clustering": ("pyOMA2 hierarchical", 4.6, None), "deviations": ("pyOMA2 with uncertainty, 50 block rows", 257.0, 4390)}
TARGETS = {"covariance": (0.3, 60), "data": (3.0, 300), "clustering": (0.1, None), "deviations": (2.0, 300)}


def numpy_ssi(file, method):
    """Covariance- or data-driven SSI as it is usually written with NumPy: poles of orders 2 to 60 in steps of 2."""
    import numpy as np
    y = np.load(file)
    y = y - y.mean(0)
    n, l = y.shape
    p = 50
    start = time.process_time()
    if method == "covariance":
        r = [y[k:].T @ y[:n - k] / (n - k) for k in range(2 * p)]
        h = np.block([[r[p + i - j] for j in range(p)] for i in range(p)])
    else:
        columns = n - 2 * p + 1
        stacked = np.vstack([y[i:i + columns].T for i in range(2 * p)]) / np.sqrt(columns)
        lower = np.linalg.qr(stacked.T, mode="r").T
        h = lower[l * p:, :l * p]
    u, s, _ = np.linalg.svd(h)
    for order in range(2, 62, 2):
        o = u[:, :order] * np.sqrt(s[:order])
        a = np.linalg.pinv(o[:-l]) @ o[l:]
        np.linalg.eig(a)
    print(time.process_time() - start, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


def main(executable, runs):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "record.npy"
        subprocess.run([executable, "write", file], check=True)
        print("identification: 16 channels x 60,000 samples, 14 modes, 50 block rows, orders to 60 in steps of 2; medians of", runs, "runs")
        print(f"{'task':<12} {'CPU s':>7} {'MB':>6} {'modes':>6} {'spurious':>8}   {'target':>12}  beside")
        for task in ("covariance", "data", "clustering", "deviations"):
            rows = [subprocess.run([executable, task, file], check=True, capture_output=True, text=True).stdout.split() for _ in range(runs)]
            seconds = statistics.median(float(r[0]) for r in rows)
            megabytes = statistics.median(float(r[1]) for r in rows)
            beside = []
            if task in ("covariance", "data"):
                env = {"OPENBLAS_NUM_THREADS": "1", "PATH": "/usr/bin:/bin"}
                done = subprocess.run([sys.executable, __file__, "--numpy", file, task], check=True, capture_output=True, text=True, env=env)
                numpy_s, numpy_mb = map(float, done.stdout.split())
                beside.append(f"NumPy {numpy_s:.2f} s {numpy_mb:.0f} MB (ratio {numpy_s / max(seconds, 1e-3):.1f})")
            name, peer_s, peer_mb = PEERS[task]
            beside.append(f"{name} {peer_s:g} s" + (f" {peer_mb} MB" if peer_mb else "") + f" (ratio {peer_s / max(seconds, 1e-3):.0f})")
            target_s, target_mb = TARGETS[task]
            target = f"{target_s:g} s" + (f" {target_mb} MB" if target_mb else "")
            print(f"{task:<12} {seconds:>7.3f} {megabytes:>6.0f} {rows[0][2]:>6} {rows[0][3]:>8}   {target:>12}  {'; '.join(beside)}", flush=True)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--numpy"]:
        numpy_ssi(sys.argv[2], sys.argv[3])
    else:
        main(sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build" / "bin" / "bench_sysid"), int(sys.argv[2]) if len(sys.argv) > 2 else 3)
