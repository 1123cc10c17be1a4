"""Benchmark of the identification: CPU seconds and peak memory on the record of identification_record.hpp, beside a NumPy SSI of the same work in
the same run and the peers' published figures; tests/bench/run.py runs it.
"""
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

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


def rows(binaries, runs):
    import table
    executable, out = binaries / "bench_identification", []
    part = "identification: 16 channels x 60,000 samples, 14 modes, 50 block rows, orders 2 to 60"
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "record.npy"
        subprocess.run([executable, "write", file], check=True)
        for task in ("covariance", "data", "clustering", "deviations"):
            lines = [subprocess.run(table.launched(executable, task, file), check=True, capture_output=True, text=True).stdout.split() for _ in range(runs)]
            seconds = statistics.median(float(line[0]) for line in lines)
            megabytes = statistics.median(float(line[1]) for line in lines)
            found = f"{lines[0][2]} modes, {lines[0][3]} spurious"
            target_s, target_MB = TARGETS[task]
            if task in ("covariance", "data"):
                environment = {"OPENBLAS_NUM_THREADS": "1", "PATH": "/usr/bin:/bin"}
                done = subprocess.run(table.launched(sys.executable, __file__, "--numpy", file, task), check=True, capture_output=True, text=True, env=environment)
                numpy_s, numpy_MB = map(float, done.stdout.split())
                out.append(table.row(part, f"{task}, time", seconds, "s", numpy_s, "NumPy, same run; " + found))
                out.append(table.row(part, f"{task}, peak memory", megabytes, "MB", numpy_MB, "NumPy, same run"))
            name, peer_s, peer_MB = PEERS[task]
            out.append(table.row(part, f"{task}, time", seconds, "s", peer_s, name + ", published", aim=f"<= {target_s:g} s"))
            if peer_MB:
                out.append(table.row(part, f"{task}, peak memory", megabytes, "MB", peer_MB, name + ", published", aim=f"<= {target_MB:g} MB"))
    return out


if __name__ == "__main__":
    numpy_ssi(sys.argv[2], sys.argv[3])
