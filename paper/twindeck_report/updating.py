"""What is to be said of the updating beside Tables 8 and 9: bounds, resolution and costs; how well the updated model predicts the pairs
that it was not fitted to."""
from .study import Study

# share of a bound in percent within which the printed change lies on it: two decimals are printed
ON_BOUND_PCT = 0.005


def bounds(study: Study) -> list:
    """Parameters with where they ended, where the paper's ended (its change against the same bounds), and what of each the compared
    frequencies determine."""
    parameters = study.step_csv("s6_updating/parameters.csv", ["parameter", "initial_value", "change_pct", "lower", "upper", "bound"])
    paper = {r["parameter"]: r["change_pct"] for r in study.paper_table(8).to_dict("records")}
    resolution = _resolution(study)
    rows = []
    for row in parameters.to_dict("records"):
        low, high = (100.0 * (row[side] / row["initial_value"] - 1.0) for side in ("lower", "upper"))
        printed = paper.get(row["parameter"])
        theirs = "" if printed is None else _side(float(printed), low, high)
        ours = row["bound"] if row["bound"] in ("lower", "upper") else ""
        rows.append({"name": row["parameter"], "low": low, "high": high, "change": row["change_pct"], "bound": ours, "paper": printed or "",
                     "theirs": theirs, "same": bool(ours) and ours == theirs, "resolution": resolution.get(row["parameter"])})
    return rows


def _side(change: float, low: float, high: float) -> str:
    if abs(change - low) < ON_BOUND_PCT:
        return "lower"
    return "upper" if abs(change - high) < ON_BOUND_PCT else ""


def _resolution(study: Study) -> dict:
    """Diagonal of the resolution matrix of step 5: 1 seen by itself, 0 not at all."""
    if "s5_sensitivity" not in study.steps():
        return {}
    table = study.step_csv("s5_sensitivity/identifiability.csv", ["parameter", "resolution"])
    return dict(zip(table["parameter"], table["resolution"]))


def costs(study: Study) -> dict:
    """{start, published, optimum}: what each costs in our model, as far as it was computed."""
    if not (study.results / "s6_updating/costs.csv").is_file():
        return {}
    table = study.step_csv("s6_updating/costs.csv", ["point", "cost"])
    return dict(zip(table["point"], table["cost"]))


ERRORS = {"before": "error_before_pct", "fitted": "error_fitted_pct", "predicted": "error_predicted_pct"}


def left_out(study: Study) -> dict | None:
    """Each pair left out of the updating and predicted, beside no updating; None where no pair was left out."""
    if not (study.results / "s6_updating/leave_one_out.csv").is_file():
        return None
    table = study.step_csv("s6_updating/leave_one_out.csv", ["experimental_mode", "numerical_mode", "measured_Hz", *ERRORS.values(),
                                                             "parameters_on_bounds", "converged"])
    means = {name: float(table[column].abs().mean()) for name, column in ERRORS.items()}
    closer = int((table["error_predicted_pct"].abs() < table["error_before_pct"].abs()).sum())
    return {"rows": table.to_dict("records"), "means": means, "closer": closer, "pairs": len(table), "regularised": _another(study, "regularised"),
            "selected": _another(study, "selected")}


def _another(study: Study, name: str) -> dict | None:
    """Predictions of the update that is held to the parameters' ranges (regularised), or of that of the parameters which step 5 selected; None where
    step 6 made none."""
    file = f"s6_updating/leave_one_out_{name}.csv"
    if not (study.results / file).is_file():
        return None
    errors = study.step_csv(file, ["error_fitted_pct", "error_predicted_pct"])
    names = study.step_csv(f"s6_updating/{name}.csv", ["parameter"])["parameter"]
    return {"errors": list(errors["error_predicted_pct"]), "mean": float(errors["error_predicted_pct"].abs().mean()),
            "fitted": float(errors["error_fitted_pct"].abs().mean()), "parameters": list(names)}
