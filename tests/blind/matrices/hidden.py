"""What a trial hides: the bridge that is tested, one cause that the catalogue knows or none, and how the test was made. A cause's effect on the measured rows,
whitened by their deviations, is known before any run; causes below six deviations are drawn anew. Between two states the deviations are those of a difference. A part that
is wrong in one state counts with what it is beyond its bound: up to there it is no cause.

A seed holds sixteen trials: four sound ones (one state at all channels and at few, two states, three temperatures) and twelve with a cause. Form errors of 0.5, 1 and 2 %
take turns, so that any three seeds hold each kind with each.
"""
import dataclasses
import sys

import bridge as matrices
import numpy as np
import scipy.sparse
import truth as truths
from scipy.optimize import linear_sum_assignment

sys.path.insert(0, str(matrices.ROOT / "workflows" / "gt_pedestrian_bridge"))
import make_inputs  # noqa: E402

KINDS = (
    "sound", "part_changed", "gain", "spring_changed", "mass", "part_changed", "sound_states", "part", "swap", "mass_changed", "oscillator", "sound_warm",
    "spring_changed", "temperature", "part_changed", "sound_few",
)
FORM_ERRORS = (0.005, 0.01, 0.02)
SOUND = ("sound", "sound_states", "sound_warm", "sound_few")
TWO_STATES = ("sound_states", "part_changed", "spring_changed", "mass_changed")
WARM = ("sound_warm", "temperature")
ALL_CHANNELS = ("sound", "part")  # the others are tested at some of them
FEW = (16, 31)
TEMPERATURES_C, REFERENCE_C = (-8.0, 6.0, 22.0), 15.0
FREQUENCY = 0.002           # deviation of a measured frequency [-]
VISIBLE_SIGMA = 6.0
ALIKE = 0.8                 # MAC from which two shapes are compared entry by entry
SEVERAL = 40                # draws of a cause before a trial is given up


@dataclasses.dataclass(frozen=True)
class Cause:
    kind: str      # part, spring, mass, oscillator, temperature, gain, polarity, swap
    place: str     # a part, a joint, channels
    size: float
    more: float = 0.0  # of an oscillator: its frequency [Hz]
    sigma: float = 0.0


@dataclasses.dataclass(frozen=True)
class Trial:
    seed: int
    number: int
    kind: str
    form_error: float
    truth: truths.Truth
    cause: Cause | None
    channels: tuple    # degrees of freedom
    modes: int
    shape_deviation: float  # of the largest entry

    def conditions(self):
        """(condition, state or None, temperature or None, whether the cause acts)"""
        if self.kind in TWO_STATES:
            return [("before", "before", None, False), ("after", "after", None, True)]
        if self.kind in WARM:
            return [(f"at_{i + 1}", None, t, True) for i, t in enumerate(TEMPERATURES_C)]
        return [("tested", None, None, True)]


def trial_of(position, seed):
    """(seed, number in it) of the trial at a position, counted from the first of a seed."""
    return seed + position // len(KINDS), position % len(KINDS)


def structure(bridge, truth, cause, temperature=None):
    """(stiffness, mass, degrees of freedom that were added) of the truth with a cause in it."""
    if cause is None or cause.kind in ("gain", "polarity", "swap"):
        return truth.stiffness(), truth.mass, 0
    if cause.kind in ("part", "spring"):
        return truth.stiffness({cause.place: cause.size}), truth.mass, 0
    if cause.kind == "temperature":
        factor = 1.0 + cause.size * (temperature - REFERENCE_C)
        return truth.stiffness({part: factor for part in truth.parts}), truth.mass, 0
    joint = int(cause.place)
    if cause.kind == "mass":
        added = np.zeros(len(bridge.mass))
        added[bridge.dofs_of(joint, matrices.X, matrices.Y, matrices.Z)] = cause.size
        return truth.stiffness(), truth.mass + scipy.sparse.diags(added), 0
    # An oscillator hangs on a spring along z.
    at, spring = bridge.dofs_of(joint, matrices.Z)[0], cause.size * (2.0 * np.pi * cause.more) ** 2
    stiffness = np.pad(truth.stiffness(), (0, 1))
    stiffness[[at, -1, at, -1], [at, -1, -1, at]] += spring * np.array([1.0, 1.0, -1.0, -1.0])
    return stiffness, scipy.sparse.block_diag([truth.mass, scipy.sparse.diags([cause.size])], format="csc"), 1


def measured_modes(bridge, truth, cause, channels, count, temperature=None):
    """(frequencies, shapes (channels x modes) of largest entry one); an oscillator adds a mode."""
    stiffness, mass, added = structure(bridge, truth, cause, temperature)
    found, shapes = matrices.modes(stiffness, mass, count + added)
    seen = faulty(shapes[list(channels)], cause, channels)
    return found, seen / np.abs(seen).max(axis=0)


def faulty(shapes, cause, channels):
    """What is measured where a channel is turned, misread or exchanged."""
    shapes = shapes.copy()
    if cause is not None and cause.kind in ("gain", "polarity"):
        shapes[channels.index(dof_of(cause.place))] *= cause.size
    elif cause is not None and cause.kind == "swap":
        one, other = (channels.index(dof_of(name)) for name in cause.place.split(","))
        shapes[[one, other]] = shapes[[other, one]]
    return shapes


def channel(dof):
    return f"c{dof + 1}"


def dof_of(name):
    return int(name[1:]) - 1


def mac(one, other):
    return (one.T @ other) ** 2 / np.outer(np.sum(one**2, axis=0), np.sum(other**2, axis=0))


def effect(one, other, shape_deviation):
    """Length of the whitened difference of two sets of modes: pairs by shape, a pair's scale free; a shape that is no longer alike counts by its frequency alone."""
    (f, a), (g, b) = one, other
    likeness = mac(a, b)
    rows, columns = linear_sum_assignment(-likeness)
    total = 0.0
    for i, j in zip(rows, columns):
        total += (np.log(f[i] / g[j]) / FREQUENCY) ** 2
        if likeness[i, j] > ALIKE:
            rest = a[:, i] - b[:, j] * (a[:, i] @ b[:, j]) / (b[:, j] @ b[:, j])
            total += np.sum((rest / shape_deviation) ** 2)
    return float(np.sqrt(total))


def cause_drawn(kind, bridge, channels, truth, random):
    """A cause of a kind of trial; masses and oscillators sit at measured joints, where the model offers places."""
    spans = sorted(part for part in bridge.stiffness if part.startswith("Conc"))
    joints = sorted({int(bridge.joint_of[dof]) for dof in channels if bridge.place[bridge.joint_of[dof], 0] % (bridge.length - 1e-6) > 1.0})
    names = [channel(dof) for dof in channels]
    if kind in ("part_changed", "part"):  # a part of the deck acts little: what it loses has to be more
        part = str(random.choice(("Frame", "Truss"))) if random.uniform() < 0.3 else str(random.choice(spans))
        loss = random.uniform(0.6, 0.85) if part in ("Frame", "Truss") else random.uniform(0.25, 0.6)
        return Cause("part", part, float(loss if kind == "part_changed" or random.uniform() < 0.5 else 1.0 / loss))
    if kind == "spring_changed":
        factor = float(np.exp(random.uniform(np.log(2.0), np.log(5.0))))
        return Cause("spring", str(random.choice(matrices.SPRINGS)), float(random.choice((factor, 1.0 / factor))))
    if kind in ("mass", "mass_changed"):
        return Cause("mass", str(random.choice(joints)), float(random.uniform(0.02, 0.06)) * bridge.total_mass())
    if kind == "oscillator":
        upright = [joint for joint in joints if any(bridge.direction[dof] == matrices.Z for dof in channels if bridge.joint_of[dof] == joint)]
        found = matrices.modes(truth.stiffness(), truth.mass, 5)[0]
        return Cause("oscillator", str(random.choice(upright or joints)), float(random.uniform(0.01, 0.03)) * bridge.total_mass(), float(random.choice(found) * random.uniform(0.93, 1.07)))
    if kind == "temperature":
        return Cause("temperature", "global", float(-random.uniform(0.001, 0.004)))
    if kind == "gain":
        return Cause("gain", str(random.choice(names)), float(random.choice((random.uniform(0.45, 0.7), random.uniform(1.4, 2.2)))))
    if random.uniform() < 0.5:
        return Cause("polarity", str(random.choice(names)), -1.0)
    return Cause("swap", ",".join(str(name) for name in sorted(random.choice(names, 2, replace=False))), 1.0)


def sigma_of(bridge, truth, cause, kind, channels, count, shape_deviation):
    def seen(which, temperature):
        return measured_modes(bridge, truth, which, channels, count, temperature)

    without = None
    if kind == "part":
        least, most = make_inputs.bounds(cause.place)
        within = float(np.clip(truth.theta[cause.place] * cause.size, least, most))
        without = Cause("part", cause.place, within / truth.theta[cause.place])
    temperatures = TEMPERATURES_C if kind in WARM else (None,)
    whole = float(np.linalg.norm([effect(seen(cause, t), seen(without, t), shape_deviation) for t in temperatures]))
    return whole / np.sqrt(2.0) if kind in TWO_STATES else whole


def hide(seed, number, bridge):
    """The trial of a seed and a number below sixteen."""
    random = np.random.default_rng([91, seed, number])
    kind, form_error = KINDS[number], FORM_ERRORS[(seed + number) % len(FORM_ERRORS)]
    truth = truths.draw_truth(bridge, random, form_error)
    channels = tuple(bridge.measured)
    if kind not in ALL_CHANNELS:
        channels = tuple(sorted(int(dof) for dof in random.choice(bridge.measured, random.integers(*FEW), replace=False)))
    count, shape_deviation = int(random.integers(6, 9)), float(random.uniform(0.01, 0.02))
    cause = None
    if kind not in SOUND:
        for _ in range(SEVERAL):
            cause = cause_drawn(kind, bridge, channels, truth, random)
            sigma = sigma_of(bridge, truth, cause, kind, channels, count, shape_deviation)
            if sigma >= VISIBLE_SIGMA:
                break
        else:
            raise ValueError(f"seed {seed}, {number}: no visible {kind} in {SEVERAL} draws")
        cause = dataclasses.replace(cause, sigma=sigma)
    return Trial(seed, number, kind, form_error, truth, cause, channels, count, shape_deviation)


def in_words(cause):
    if cause is None:
        return "nothing"
    at = f" at {cause.more:.2f} Hz" if cause.kind == "oscillator" else ""
    return f"{cause.kind}@{cause.place} {cause.size:.3g}{at} ({cause.sigma:.0f} sigma)"
