"""Scores what s3_identification found on a virtual campaign against the campaign's truth folder, which nothing else reads.

A mode found at f with standard deviation s is a true one if it lies within the larger of 0.5 % and 3 s of a mode that takes part at the
channels. A true mode counts once. Of a named mode the shape must be its own too. Of all ways to pair found and true modes the one is taken
that pairs the most, named ones first, and among those the one with the smallest distances.
"""
import collections
import csv
import dataclasses
import math
import pathlib

import numpy as np

FREQUENCY, SIGMAS, LEAST_MAC = 0.005, 3.0, 0.5
# Of the variance at some channel: what the sensors' noise has at the level of the quiet records (0.1 of 3 mm/s2).
LEAST_PARTICIPATION = 1e-3
BAND_HZ = 2.6


@dataclasses.dataclass
class Named:
    """A named mode and what was found of it; errors in standard deviations."""
    name: str
    frequency_Hz: float
    damping_pct: float
    found: dict = None
    mac: float = 0.0

    def error(self, value, deviation, truth):
        return (self.found[value] - truth) / self.found[deviation]

    @property
    def frequency_error(self):
        return self.error("frequency_Hz", "frequency_std_Hz", self.frequency_Hz)

    @property
    def damping_error(self):
        return self.error("damping_ratio_pct", "damping_ratio_std_pct", self.damping_pct)

    @property
    def good(self):
        return self.found is not None and abs(self.damping_error) <= SIGMAS


@dataclasses.dataclass
class Score:
    named: list
    spurious: list
    others: int  # true modes without a name that were found too

    @property
    def good(self):
        return [m.name for m in self.named if m.good]


def rows(file):
    with open(file, newline="") as f:
        return list(csv.DictReader(f))


def shapes(file, key, wanted=lambda row: True):
    table = collections.defaultdict(dict)
    for r in rows(file):
        if wanted(r) and r["value"] != "":
            table[r["mode"]][r[key]] = complex(float(r["value"]), float(r["value_imag"] or 0.0))
    return table


def mac(a, b):
    both = [c for c in a if c in b]
    p, q = np.array([a[c] for c in both]), np.array([b[c] for c in both])
    norms = np.vdot(p, p).real * np.vdot(q, q).real
    return abs(np.vdot(p, q))**2 / norms if norms > 0 else 0.0


def assignment(gain):
    """Pairs (row, column) with the largest sum of gains; a pair without gain is not made. Kuhn's method with potentials."""
    n, m = gain.shape
    size = n + m  # a row or column of its own for each that stays without partner
    cost = np.zeros((size, size))
    cost[:n, :m] = -np.maximum(gain, 0.0)
    u, v, row_of, way = np.zeros(size + 1), np.zeros(size + 1), np.zeros(size + 1, int), np.zeros(size + 1, int)
    for i in range(1, size + 1):
        row_of[0], j = i, 0
        least, used = np.full(size + 1, np.inf), np.zeros(size + 1, bool)
        while True:
            used[j] = True
            free = np.flatnonzero(~used[1:]) + 1
            now = cost[row_of[j] - 1, free - 1] - u[row_of[j]] - v[free]
            better = now < least[free]
            least[free[better]], way[free[better]] = now[better], j
            k = free[np.argmin(least[free])]
            delta = least[k]
            u[row_of[used]] += delta
            v[used] -= delta
            least[~used] -= delta
            j = k
            if row_of[j] == 0:
                break
        while j:
            row_of[j], j = row_of[way[j]], way[j]
    return [(row_of[j] - 1, j - 1) for j in range(1, m + 1) if 0 < row_of[j] <= n and gain[row_of[j] - 1, j - 1] > 0.0]


def score(campaign, identified, condition, is_first):
    """@param is_first  the condition's files lie at the top of the folder, those of the others below conditions/"""
    campaign, folder = pathlib.Path(campaign), pathlib.Path(identified)
    folder = folder if is_first else folder / "conditions" / condition
    found = [{**r, **{k: float(r[k]) for k in ("frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct")}}
             for r in rows(folder / "modes.csv")]
    share = collections.defaultdict(float)
    for r in rows(campaign / "truth" / "participation.csv"):
        if r["condition"] == condition:
            share[r["frequency_Hz"]] = max(share[r["frequency_Hz"]], float(r["participation"]))
    true = [r for r in rows(campaign / "truth" / "modes.csv") if r["condition"] == condition and
            (r["mode"] or share[r["frequency_Hz"]] >= LEAST_PARTICIPATION)]
    true_shapes = shapes(campaign / "truth" / "shapes.csv", "channel", lambda r: r["condition"] == condition)
    own_shapes = shapes(folder / "shapes.csv", "direction")
    gain, macs = np.zeros((len(found), len(true))), {}
    for i, f in enumerate(found):
        for j, t in enumerate(true):
            truth = float(t["frequency_Hz"])
            allowed = max(FREQUENCY * truth, SIGMAS * f["frequency_std_Hz"])
            distance = abs(f["frequency_Hz"] - truth) / allowed
            if distance > 1.0:
                continue
            gain[i, j] = 1.0
            if t["mode"]:
                macs[i, j] = mac(own_shapes[f["mode"]], true_shapes[t["mode"]])
                in_damping = abs(f["damping_ratio_pct"] - float(t["damping_ratio_pct"])) <= SIGMAS * f["damping_ratio_std_pct"]
                gain[i, j] = 0.0 if macs[i, j] < LEAST_MAC else 4.0 if in_damping else 3.0
            if gain[i, j] > 0.0:
                # Of a named mode the likeness of shape decides, of the others how much they take part.
                gain[i, j] -= 1e-2 * (distance + (1.0 - macs[i, j] if t["mode"] else -0.1 * math.log(share[t["frequency_Hz"]])))
    pairs = dict(assignment(gain)) if found and true else {}
    found_of = {j: i for i, j in pairs.items()}
    named = []
    for j, t in enumerate(true):
        if not t["mode"]:
            continue
        mode = Named(t["mode"], float(t["frequency_Hz"]), float(t["damping_ratio_pct"]))
        if j in found_of:
            mode.found, mode.mac = found[found_of[j]], macs[found_of[j], j]
        named.append(mode)
    spurious = [f for i, f in enumerate(found) if f["frequency_Hz"] < BAND_HZ and i not in pairs]
    return Score(sorted(named, key=lambda m: int(m.name)), spurious, sum(1 for j in found_of if not true[j]["mode"]))
