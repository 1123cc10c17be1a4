"""What the paper's trust region radius of 2 means when parameters are divided by their initial values and bounded."""
from .errors import InputError
from .study import Study


def trust_region_facts(study: Study) -> dict:
    """Size of the box of admissible parameters beside the radius, and what the iterations' records say about it.

    Norms are Euclidean in the normalised parameters x = p / p_initial, those of `step_norm` and `trust_radius`.
    """
    bounds = study.step_csv("s6_updating/parameters.csv", ["parameter", "initial_value", "lower", "upper"])
    history = study.step_csv("s6_updating/history.csv", ["start", "outer", "iteration", "step_norm", "trust_radius"])
    if history.empty:
        raise InputError(f"{study.results / 's6_updating/history.csv'}: no iteration")
    down = 1.0 - bounds["lower"] / bounds["initial_value"]
    up = bounds["upper"] / bounds["initial_value"] - 1.0
    farthest = [max(d, u) for d, u in zip(down, up)]
    steps = history[history["step_norm"] > 0]
    return {
        "count": len(bounds),
        "smallest_range": min(farthest),
        "largest_range": max(farthest),
        "reach": sum(f**2 for f in farthest) ** 0.5,
        "diameter": float(((down + up) ** 2).sum() ** 0.5),
        "radius": float(history["trust_radius"].iloc[0]),
        "steps": len(steps),
        "longest_step": float(steps["step_norm"].max()) if len(steps) else 0.0,
        "smallest_radius": float(history["trust_radius"].min()),
    }
