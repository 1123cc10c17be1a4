"""Wind field, 60 points x 3 components x 600 s at 16 Hz: ours against the direct cosine sum and against NumPy, same run, same work.

Run by tests/bench/run.py. The direct sum is measured on 2000 of its 26 million waves and scaled. NumPy does what is usual there:
batched Cholesky factors and one inverse FFT a point, with a factor at every frequency and with factors interpolated from 40 anchors.
Both sides run on one thread (set here); seconds are processor time.
"""
import os
import statistics
import subprocess
import time

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np  # noqa: E402  (after the number of threads is set)

import table  # noqa: E402

N, RATE, SAMPLES, V = 60, 16.0, 9600, 19.1


def points():
    part = (np.arange(30) + 0.5) / 15.0 - 1.0
    foot, cycle = 0.9495 * part, 0.6381 * part
    return np.concatenate([
        np.column_stack([80 * np.cos(foot) - 80, 80 * np.sin(foot), np.full(30, 12.0)]),
        np.column_stack([100 * np.cos(cycle) - 84, 100 * np.sin(cycle), np.full(30, 13.0)])])


def spectrum(component, f, sigma, length):
    n = f * length / V
    if component == 0:
        return sigma**2 / f * 4 * n / (1 + 70.8 * n**2) ** (5 / 6)
    return sigma**2 / f * 4 * n * (1 + 755.2 * n**2) / (1 + 283.2 * n**2) ** (11 / 6)


def numpy_field(anchors, generator):
    """One sample of three components; anchors = 0: a factor at every frequency."""
    x = points()
    scaled = np.linalg.norm((x[:, None, :] - x[None, :, :]) * np.array([3.0, 6.5, 3.0]), axis=2) / V
    f = np.arange(1, SAMPLES // 2) * RATE / SAMPLES
    out = []
    for component in range(3):
        at = np.geomspace(f[0], f[-1], anchors) if anchors else f
        factor = np.linalg.cholesky(np.exp(-at[:, None, None] * scaled))
        wave = np.exp(2j * np.pi * generator.random((len(f), N)))
        if anchors:
            low = np.clip(np.searchsorted(at, f, side="right") - 1, 0, anchors - 2)
            share = np.clip(np.log(f / at[low]) / np.log(at[low + 1] / at[low]), 0, 1)[:, None]
            sums = np.empty_like(wave)
            for a in range(anchors - 1):
                rows = np.flatnonzero(low == a)
                if len(rows):
                    sums[rows] = ((1 - share[rows]) * (wave[rows] @ factor[a].T) + share[rows] * (wave[rows] @ factor[a + 1].T))
        else:
            sums = np.einsum("fjm,fm->fj", factor, wave, optimize=True)
        s = spectrum(component, f, 2.0 / (1 + component), 103.0 / 3.0**component)
        sums *= np.sqrt(2 * RATE / SAMPLES * s)[:, None] * np.exp(-2j * np.pi * f[:, None] * x[None, :, 0] / V)
        bins = np.zeros((SAMPLES // 2 + 1, N), complex)
        bins[1:-1] = 0.5 * SAMPLES * sums
        out.append(np.fft.irfft(bins, SAMPLES, axis=0))
    return out


def ours(program, what, runs):
    lines = subprocess.run([program, what, str(runs)], check=True, capture_output=True, text=True).stdout.split()
    return statistics.median(float(line) for line in lines)


def numpy_median(anchors, runs):
    generator = np.random.default_rng(1)
    times = []
    for _ in range(runs):
        start = time.process_time()
        numpy_field(anchors, generator)
        times.append(time.process_time() - start)
    return statistics.median(times)


def rows(binaries, runs):
    program = binaries / "bench_wind_field"
    part = f"wind field: {N} points x 3 components x 600 s at {RATE:g} Hz, one thread"
    fast, each = ours(program, "interpolated", runs), ours(program, "every_frequency", runs)
    direct = ours(program, "direct_cosine_sum", runs)
    every, interpolated = numpy_median(0, runs), numpy_median(40, runs)
    return [table.row(part, "factors at anchors, interpolated", fast, "s", interpolated, "NumPy FFT, the same 40 anchors"),
            table.row(part, "a factor at every frequency", each, "s", every, "NumPy FFT, a factor at every frequency"),
            table.row(part, "interpolated, against the direct sum", fast, "s", direct, "direct cosine sum in C++, 2000 waves scaled")]
