"""Modes of a structure whose parts keep shares of their stiffness, and the rows that compare its change with a measured one.

    K = K_rest + sum theta_i K_i, theta = 1 before

The rows, in this order for each measured mode of `after` that has a partner in the model, and whose partner is measured in `before` too:
ln f, and the shape of unit norm, each measured change minus the model's. A constant error of the model thus cancels to first order.
"""
import dataclasses

import numpy as np
from scipy.linalg import eigh
from scipy.optimize import linear_sum_assignment

from measured_modes import pairs_by_shape

FREQUENCY_FLOOR, SHAPE_FLOOR = 0.001, 0.01  # least relative deviations: those of twindeck's defaults, so that all methods believe the rows alike


@dataclasses.dataclass
class Structure:
    rest: np.ndarray     # (n x n)
    parts: list          # of (n x n)
    mass: np.ndarray     # (n x n)
    sensors: np.ndarray  # (channels x n)

    def modes(self, shares):
        """ln f (n), mass-normalised shapes (n x n)."""
        stiffness = self.rest + sum(share * part for share, part in zip(shares, self.parts))
        squares, shapes = eigh(stiffness, self.mass)
        return 0.5 * np.log(np.maximum(squares, 1e-6)) - np.log(2.0 * np.pi), shapes


@dataclasses.dataclass
class Change:
    """Measured change of the modes that both states have."""
    structure: Structure
    before: dict  # model mode -> measured mode
    after: list   # measured modes
    sound: tuple = None

    @classmethod
    def of(cls, structure, before, after):
        sound = structure.modes(np.ones(len(structure.parts)))
        paired = pairs_by_shape(before, structure.sensors @ sound[1])
        return cls(structure, {j: before[i] for i, j in paired.items()}, after, sound)

    def pairs(self, shares):
        """(measured mode of after, model mode with these shares, model mode before) of all that can be compared."""
        _, shapes = self.structure.modes(shares)
        same = np.abs(shapes.T @ self.structure.mass @ self.sound[1])
        origin = dict(zip(*linear_sum_assignment(-same)))
        found = pairs_by_shape(self.after, self.structure.sensors @ shapes)
        return [(i, j, origin[j]) for i, j in found.items() if origin[j] in self.before]

    def rows(self, shares, pairs):
        """Measured minus computed change, and its deviation."""
        logs, shapes = self.structure.modes(shares)
        rest, deviation = [], []
        for i, now, then in pairs:
            after, before = self.after[i], self.before[then]
            rest.append([np.log(after.frequency_Hz / before.frequency_Hz) - (logs[now] - self.sound[0][then])])
            deviation.append([np.hypot(relative(after), relative(before))])
            old = turned(self.structure.sensors @ self.sound[1][:, then], before.shape)
            new = turned(self.structure.sensors @ shapes[:, now], after.shape)
            sign = np.sign(before.shape @ after.shape) or 1.0
            rest.append(sign * (after.shape - new) - (before.shape - old))
            deviation.append(np.sqrt(spread(after) ** 2 + spread(before) ** 2))
        if not rest:
            return np.zeros(0), np.ones(0)
        return np.concatenate(rest), np.concatenate(deviation)


def relative(mode):
    return max(mode.frequency_std_Hz / mode.frequency_Hz, FREQUENCY_FLOOR)


def spread(mode):
    return np.maximum(mode.shape_std, SHAPE_FLOOR * np.abs(mode.shape).max())


def turned(shape, like):
    """Unit norm, with the sign of `like`."""
    return shape / np.linalg.norm(shape) * (np.sign(shape @ like) or 1.0)
