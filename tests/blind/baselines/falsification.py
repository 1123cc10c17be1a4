"""Error-domain model falsification (Goulet and Smith 2013, Struct. Saf. 43, 20-29) over candidate sets of losses.

Each candidate predicts the change of every row. It is falsified if one residual leaves its interval, which holds a combined error with
probability phi^(1/rows) (Sidak), phi = 0.95. The combined error is a normal one (the deviations of both records) and a uniform one (the model):
3 per mille and a tenth of the predicted change of a frequency, 0.02 of a shape of unit norm. What is not falsified is the answer; all are alike.

Candidates: nothing; one part; the parts of a group (a storey, its faces of one direction); two parts; two groups. Shares in steps.
"""
import functools
import itertools

import numpy as np
from changed_parts import relative, spread, turned
from measured_modes import LEAST_MAC
from scipy.optimize import brentq
from scipy.special import ndtr

TARGET = 0.95
FREQUENCY_ERROR, FREQUENCY_SHARE, SHAPE_ERROR = 0.003, 0.1, 0.02  # half widths of the uniform errors [-]
FINE, COARSE = np.linspace(0.0, 0.95, 20), (0.0, 0.25, 0.5, 0.75)  # shares of a part that are tried


def threshold(width, probability):
    """t of P(|n + u| <= t) = probability, n standard normal and u uniform within +- width (in deviations of n)."""
    if width < 1e-6:
        width = 1e-6

    def held(t):
        grid = np.linspace(-width, width, 65)
        return np.mean(ndtr(t - grid) - ndtr(-t - grid)) - probability

    return brentq(held, 0.0, width + 8.0)


class Thresholds:
    """threshold() over a table of widths."""

    def __init__(self, probability):
        self.widths = np.concatenate((np.linspace(0.0, 5.0, 41), np.linspace(6.0, 100.0, 48)))
        self.values = np.array([threshold(w, probability) for w in self.widths])

    def __call__(self, width):
        beyond = np.maximum(width - self.widths[-1], 0.0)
        return np.interp(width, self.widths, self.values) + beyond


def candidates(parts, groups):
    """(indices of the parts that lose, shares of all parts)"""
    def shares(*pairs):
        out = np.ones(parts)
        for which, share in pairs:
            out[list(which)] = share
        return out

    single = [(i,) for i in range(parts)]
    for which in (*single, *groups):
        for share in FINE:
            yield tuple(which), shares((which, share))
    for one, other in (*itertools.combinations(single, 2), *itertools.combinations(groups, 2)):
        if set(one) & set(other):
            continue
        for a, b in itertools.product(COARSE, COARSE):
            yield tuple(sorted((*one, *other))), shares((one, a), (other, b))


def all_modes(structure, shares):
    """ln f (candidates x n) and shapes (candidates x n x n), mass normalised. @param shares  (candidates x parts)"""
    half = np.linalg.inv(np.linalg.cholesky(structure.mass)).T
    parts = np.array([half.T @ part @ half for part in structure.parts])
    stiffness = half.T @ structure.rest @ half + np.tensordot(shares, parts, axes=1)
    squares, shapes = np.linalg.eigh(stiffness)
    return 0.5 * np.log(np.maximum(squares, 1e-6)) - np.log(2.0 * np.pi), half @ shapes


def unit(vectors, axis):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=axis, keepdims=True), 1e-300)


class Predictions:
    """What every candidate predicts, once for all pairs of records."""

    def __init__(self, structure, groups):
        self.places, shares = zip(((), np.ones(len(structure.parts))), *candidates(len(structure.parts), groups))
        self.logs, shapes = all_modes(structure, np.array(shares))
        self.shapes = unit(structure.sensors @ shapes, axis=1)  # candidates x channels x n
        self.origin = np.argmax(np.abs(np.einsum("cij,ik->cjk", shapes, structure.mass @ shapes[0])), axis=2)  # candidates x n


def standing(change, predictions):
    """(candidates) whether each one stands. A candidate that pairs fewer modes than the best one less one is no answer."""
    mac = np.einsum("ai,cij->caj", np.array([m.shape for m in change.after]), predictions.shapes)
    now = np.argmax(mac**2, axis=2)  # candidates x measured modes
    best = np.take_along_axis(mac, now[:, :, None], axis=2)[:, :, 0]
    then = np.take_along_axis(predictions.origin, now, axis=1)
    known = np.array([j in change.before for j in range(predictions.logs.shape[1])])
    paired = (best**2 >= LEAST_MAC) & known[then]
    counted = paired.sum(axis=1)
    out = (counted >= max(1, counted.max() - 1))
    for c in np.flatnonzero(out):
        rest, room, deviation = [], [], []
        for i in np.flatnonzero(paired[c]):
            after, before = change.after[i], change.before[then[c, i]]
            computed = predictions.logs[c, now[c, i]] - predictions.logs[0, then[c, i]]
            rest.append([np.log(after.frequency_Hz / before.frequency_Hz) - computed])
            room.append([FREQUENCY_ERROR + FREQUENCY_SHARE * abs(computed)])
            deviation.append([np.hypot(relative(after), relative(before))])
            new = predictions.shapes[c, :, now[c, i]]
            old = turned(predictions.shapes[0, :, then[c, i]], before.shape)
            sign = np.sign(before.shape @ after.shape) or 1.0
            rest.append(sign * (after.shape - turned(new, after.shape)) - (before.shape - old))
            room.append(np.full(len(new), SHAPE_ERROR))
            deviation.append(np.hypot(spread(after), spread(before)))
        rest, room, deviation = map(np.concatenate, (rest, room, deviation))
        out[c] = np.all(np.abs(rest / deviation) <= law(len(rest))(room / deviation))
    return out


@functools.lru_cache(maxsize=None)
def law(rows):
    return Thresholds(TARGET ** (1.0 / rows))


def not_falsified(change, predictions):
    """Sets of parts (tuples of indices) of which a candidate stands; () is no loss. Empty: all are falsified."""
    return sorted({predictions.places[c] for c in np.flatnonzero(standing(change, predictions))})
