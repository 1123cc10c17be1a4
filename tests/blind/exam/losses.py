"""Which losses of the benchmark frame the sensors can see, and whether they tell the face: written down before any run.

    losses.py losses.csv

For each case, pattern and face that lost braces, the pattern is compared with the same pattern without the loss of that face: logarithms of frequencies and
shapes (unit norm) of the modes that are seen in both, whitened by the deviations of two records. `effect_sigma` is the length of that vector; a
loss along the load is visible from six on. One across the load (x in cases 1 and 2) is not counted as visible: it acts through the turning that another
loss excites, or not at all. `mirror_sigma` is the same against the pattern with the loss moved to the opposite face; the sensors tell the face from six on.

Deviations. Frequency: zeta / (2 pi N) of its square, N cycles in the record (Au 2014, Mech. Syst. Signal Process. 48, 15-33: long data, small damping, wide band), and no less
than 0.1 % (the catalogue's own floor). Shapes of unit norm: (2/pi) (S_e/S) zeta / N a channel (same source, S_e and S the spectral densities of noise and of the
modal force), and 1 % of the largest component (gain and alignment of a sensor, step 9's default). Two modes nearer than 6 % turn into each
other by an angle of deviation 0.015 over their relative gap, at most 26 degrees (docs/diagnosis.md, section 1).

Seen is a mode whose response at resonance stands ten times above the noise at the best sensor (power spectral densities).
"""
import csv
import dataclasses
import math
import pathlib
import sys

import numpy as np
from scipy.optimize import linear_sum_assignment

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "workflows" / "iasc_asce"))
import frame  # noqa: E402
import records  # noqa: E402

VISIBLE_SIGMA = 6.0           # the length of a whitened effect that is called visible
SEEN_RATIO = 10.0             # power spectral density of a mode's peak over the noise's
FREQUENCY_FLOOR, SHAPE_FLOOR = 0.001, 0.01
NEAR, ANGLE, LARGEST_ANGLE = 0.06, 0.015, 0.4538
LEAST_MAC = 0.5               # modes less alike than this are not one mode
HIGHEST_HZ = records.LOAD_HZ
HEADER = ("case", "pattern", "storey", "face", "loss_pct", "modes_seen", "effect_sigma", "visible", "mirror_sigma", "face_told")
OPPOSITE = {"x0": "x2", "x2": "x0", "y0": "y2", "y2": "y0"}


def spectrum_of_motion(found, case):
    """(modes x 16): power spectral density [m^2/s^3 per unit of the load's] of each mode's peak."""
    push = np.abs(records.load_shapes(case).T @ found.floors)  # loads x modes
    return ((push**2).sum(axis=0) * (frame.at_sensors(found.floors) / (2.0 * frame.DAMPING)) ** 2).T


@dataclasses.dataclass(frozen=True)
class Seen:
    frequencies_Hz: np.ndarray  # (n)
    shapes: np.ndarray          # (16 x n), unit norm
    noise: np.ndarray           # (n) S_e / S


def seen(case, damage):
    """The modes that stand above the noise."""
    found = frame.modes(case, damage)
    peaks = spectrum_of_motion(found, case)
    inside = found.frequencies_Hz < HIGHEST_HZ
    # A white load gives a mode the variance of its peak's density times (pi/2) zeta f, one-sided densities.
    variance = 0.5 * np.pi * frame.DAMPING * found.frequencies_Hz[inside, None] * peaks[inside, -4:]
    noise = records.NOISE**2 * variance.sum(axis=0).max() / (0.5 * records.RATE_HZ)
    keep = inside & (peaks.max(axis=1) > SEEN_RATIO * noise)
    shapes = frame.at_sensors(found.floors)[:, keep]
    ratio = noise / (4.0 * frame.DAMPING**2 * peaks[keep].sum(axis=1))
    return Seen(found.frequencies_Hz[keep], shapes / np.linalg.norm(shapes, axis=0), ratio)


def covariance(modes):
    """Of one record's rows: ln f of each mode, then each shape."""
    frequencies, shapes = modes.frequencies_Hz, modes.shapes
    count, channels = len(frequencies), len(shapes)
    out = np.zeros((count * (1 + channels),) * 2)
    cycles = frequencies * records.LENGTH_S
    out[range(count), range(count)] = np.maximum(frame.DAMPING / (2.0 * np.pi * cycles), FREQUENCY_FLOOR**2)
    where = [slice(count + channels * i, count + channels * (i + 1)) for i in range(count)]
    by_noise = 2.0 / np.pi * modes.noise * frame.DAMPING / cycles
    for at, shape, variance in zip(where, shapes.T, by_noise):
        out[at, at] = ((SHAPE_FLOOR * np.abs(shape).max()) ** 2 + variance) * np.eye(channels)
    for i in range(count):
        for j in range(i):
            gap = abs(np.log(frequencies[i] / frequencies[j]))
            if gap < NEAR:
                turn = np.zeros(len(out))
                turn[where[i]], turn[where[j]] = shapes[:, j], -shapes[:, i]
                out += min(ANGLE / gap, LARGEST_ANGLE) ** 2 * np.outer(turn, turn)
    return out


def chosen(modes, which, signs=1.0):
    return Seen(modes.frequencies_Hz[which], modes.shapes[:, which] * signs, modes.noise[which])


def effect(case, one, other):
    """Length of the whitened difference of two states of damage, and how many modes it rests on."""
    first, second = seen(case, one), seen(case, other)
    mac = (first.shapes.T @ second.shapes) ** 2
    rows, columns = linear_sum_assignment(1.0 - mac)
    rows, columns = np.array([(i, j) for i, j in zip(rows, columns) if mac[i, j] > LEAST_MAC]).T
    first = chosen(first, rows)
    second = chosen(second, columns, np.sign(np.sum(first.shapes * second.shapes[:, columns], axis=0)))
    rest = np.concatenate((np.log(second.frequencies_Hz / first.frequencies_Hz), (second.shapes - first.shapes).T.ravel()))
    law = covariance(first) + covariance(second)
    return float(np.sqrt(rest @ np.linalg.solve(law, rest))), len(rows)


def with_face(damage, storey, face, instead):
    """The damage with one face's loss of a storey left out (instead: None) or moved to another face."""
    losses = []
    for loss in damage.losses:
        if loss.storey == storey and face in loss.faces:
            rest = tuple(f for f in loss.faces if f != face)
            losses += [dataclasses.replace(loss, faces=rest)] if rest else []
            losses += [dataclasses.replace(loss, faces=(instead,))] if instead and instead not in rest else []
        else:
            losses.append(loss)
    return dataclasses.replace(damage, losses=tuple(losses))


def table(cases=tuple(frame.CASES)):
    for case in cases:
        for pattern, damage in frame.PATTERNS.items():
            for loss in damage.losses:
                for face in loss.faces:
                    sigma, count = effect(case, damage, with_face(damage, loss.storey, face, None))
                    both = OPPOSITE[face] in loss.faces  # a loss on both faces has no mirror image
                    mirror = math.inf if both else effect(case, damage, with_face(damage, loss.storey, face, OPPOSITE[face]))[0]
                    across = frame.CASES[case].load == "floors" and face[0] == "y"  # the braces of y0 and y2 work along x
                    share = len(loss.braces) / 2.0 * (1.0 - loss.remaining)
                    yield {
                        "case": case, "pattern": pattern, "storey": loss.storey, "face": face, "loss_pct": f"{100.0 * share:.1f}",
                        "modes_seen": count, "effect_sigma": f"{sigma:.1f}", "visible": int(sigma >= VISIBLE_SIGMA and not across),
                        "mirror_sigma": "" if both else f"{mirror:.1f}", "face_told": int(mirror >= VISIBLE_SIGMA),
                    }


def main(path):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, HEADER, lineterminator="\n")
        writer.writeheader()
        writer.writerows(table())


if __name__ == "__main__":
    main(*sys.argv[1:2])
