"""How far an updated parameter may lie from the paper's, given what the frequencies can tell about it.

Relative sensitivities J = d ln f / d ln p (modes x parameters) = U S V'. Directions of V that s5_sensitivity found
identifiable are resolved: a scatter e of the frequencies moves a parameter by e sqrt(sum_k (V_pk / S_k)^2). The remaining
directions are not seen by any frequency, so along them every value inside the bounds is as good as the paper's. With the
resolution r_p = sum_k V_pk^2 over the identifiable k:

    allowed_p = min(range_p, 100 e sqrt(sum_k (V_pk / S_k)^2) + (1 - r_p) range_p)      [percent of the initial value]

range_p is the distance between the bounds. A parameter that s5_sensitivity calls unidentifiable gets the whole range.
"""
import numpy as np

from .errors import InputError
from .study import Study


def allowed_changes(study: Study, frequency_scatter: float) -> dict:
    """{parameter: (allowed deviation of change_pct in points, in words)} for the updated parameters."""
    bounds = study.step_csv("s6_updating/parameters.csv", ["parameter", "initial_value", "lower", "upper"])
    sensitivity = study.step_csv("s5_sensitivity/sensitivity.csv", ["mode", "parameter", "relative"])
    values = study.step_csv("s5_sensitivity/singular_values.csv", ["index", "value", "identifiable"])
    verdicts = study.step_csv("s5_sensitivity/identifiability.csv", ["parameter", "identifiable"])
    names = list(bounds["parameter"])
    matrix = sensitivity.pivot(index="mode", columns="parameter", values="relative")
    lacking = [n for n in names if n not in matrix.columns]
    if lacking:
        raise InputError(f"{study.results / 's5_sensitivity/sensitivity.csv'}: no parameter {lacking[0]}, which was updated")
    kept = int(sum(truth(v) for v in values["identifiable"]))
    _, s, vt = np.linalg.svd(matrix[names].to_numpy(), full_matrices=False)
    kept = min(kept, int(np.sum(s > 1e-12 * s[0])))
    identifiable = {r["parameter"]: truth(r["identifiable"]) for r in verdicts.to_dict("records")}
    allowed = {}
    for i, row in enumerate(bounds.to_dict("records")):
        span = 100.0 * (row["upper"] - row["lower"]) / row["initial_value"]
        if not identifiable.get(row["parameter"], False):
            allowed[row["parameter"]] = (span, "not identifiable: any value between the bounds")
            continue
        resolved = float(np.sum(vt[:kept, i] ** 2))
        spread = 100.0 * frequency_scatter * float(np.sqrt(np.sum((vt[:kept, i] / s[:kept]) ** 2)))
        total = min(span, spread + (1.0 - resolved) * span)
        allowed[row["parameter"]] = (total, f"range {span:.3g} %, resolution {resolved:.2f}, scatter {spread:.3g} %")
    return allowed


def truth(value) -> bool:
    """0/1, true/false, yes/no as a step writes them."""
    return str(value).strip().lower() in ("1", "1.0", "true", "yes")
