"""Plain least squares: the share of its stiffness that each part keeps, fitted to the measured change of the modes.

Weights are the rows' deviations; no model error, bounds 0 and 1.3. Parts that the rows do not see are kept where they are by a pull with a deviation of 0.3,
which takes 0.4 % of a loss that the rows know to 0.02. Modes are paired anew at each solution until the pairs stay.
"""
import numpy as np
from scipy.optimize import least_squares

LARGEST_SHARE = 1.3  # a part may come out stiffer by noise; what is beyond is no loss in any case
PULL = 0.3           # [-] deviation that a share has before the rows speak
ROUNDS = 6           # of pairing; two or three are usual


def fit_shares(change):
    """Shares (parts) that each part keeps, and how many modes they rest on."""
    shares = np.ones(len(change.structure.parts))

    def misfit(x):
        return np.concatenate((np.divide(*change.rows(x, pairs)), (x - 1.0) / PULL))

    pairs = change.pairs(shares)
    for _ in range(ROUNDS):
        if not pairs:
            return shares, 0
        found = least_squares(
            misfit, np.clip(shares, 1e-3, LARGEST_SHARE - 1e-3), bounds=(0.0, LARGEST_SHARE), x_scale=1.0
        )
        shares = found.x
        again = change.pairs(shares)
        if again == pairs:
            break
        pairs = again
    return shares, len(pairs)
