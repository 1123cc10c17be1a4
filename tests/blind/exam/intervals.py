"""Exact (Clopper-Pearson) intervals of a share."""
from scipy.stats import beta


def exact_interval(hits, trials, level=0.95):
    """(low, high) of hits of trials; (0, 1) where there is none."""
    tail = 0.5 * (1.0 - level)
    low = beta.ppf(tail, hits, trials - hits + 1) if hits > 0 else 0.0
    high = beta.ppf(1.0 - tail, hits + 1, trials - hits) if hits < trials else 1.0
    return float(low), float(high)


def share(hits, trials):
    """"14 of 25 (35 to 76 %)", or "-" where there is none."""
    if trials == 0:
        return "-"
    low, high = exact_interval(hits, trials)
    return f"{hits} of {trials} ({100.0 * low:.0f} to {100.0 * high:.0f} %)"
