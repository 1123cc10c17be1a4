"""The story that step 9 tells: what is wrong, why, how the model was extended, what was gained."""
import json

import pandas as pd

from ..study import Study
from . import raw_errors, telling
from .headline import equally_well, odds_of, odds_of_log, sure
from .heatmap import NAMES, heatmaps
from .numbers import physical, span
from .places import places

VERDICTS = {
    "none": ("good", "Nothing is missing", "The model fitted within its bounds explains the measurement: updating is enough."),
    "named": ("good", "One cause explains the deviations", "What the model fitted within its bounds leaves unexplained is explained by what is named here."),
    "ambiguous": ("warn", "Several causes explain the deviations equally well", "The measured values cannot tell these causes apart."),
    "unknown": ("bad", "The model lacks something that no cause of the catalogue explains",
                "What is named below helps, but the residual test still rejects the extended model: do not take it for the cause."),
}


def verdict_in_words(told: dict, beyond: int = 0) -> tuple:
    """Tone, heading and meaning of a verdict. `beyond`: measured values that the model fitted within its bounds misses by more than it may."""
    tone, title, meaning = VERDICTS.get(told["verdict"], ("warn", told["verdict"], ""))
    if told["verdict"] == "none" and beyond:
        tone, title = "warn", "No cause is named, and the model does not explain all that was measured"
        meaning = f"{beyond} measured value{'s stand' if beyond > 1 else ' stands'} out; no cause of the catalogue explains enough of that to be named."
    if told["verdict"] == "unknown" and not told["effects"]:
        meaning = "No cause is named: with the best one in it the model still misses what was measured. Below is where a change would explain most."
    if told["verdict"] == "named" and len(told["effects"]) > 1:
        title = f"{len(told['effects'])} causes explain the deviations together"
    if told["verdict"] == "ambiguous" and told["effects"] and not any(equally_well(e) for e in told["effects"]):
        title = "One cause is likelier than the others, which stay possible"
    return tone, title, meaning


def diagnosis_data(study: Study, settings: dict) -> dict | None:
    path = study.results / "s9_diagnosis" / "diagnosis.json"
    if "s9_diagnosis" not in study.steps() or not path.is_file():
        return None
    study.used.add(path)
    told = json.loads(path.read_text(encoding="utf-8"))
    rows = study.step_csv("s9_diagnosis/residuals.csv", ["type", "mode", "channel", "condition", "held_out", "residual_before", "residual_after"])
    beyond = {side: _beyond(rows, side) for side in ("before", "after")}
    tone, title, meaning = verdict_in_words(told, beyond["before"])
    raw = raw_errors.raw_errors(telling.telling(study, told)[0]) if told["effects"] else None
    fitted = _fitted(study)
    folder = "s6_updating/model" if "s6_updating" in study.steps() else None
    where = places(study, settings, folder, told.get("localisation", []))
    return {"told": told, "tone": tone, "title": title, "meaning": meaning, "beyond": beyond, "beyond_held_out": _beyond(rows[rows["held_out"] == 1], "before"), "kind": _kind, "block": _block, "rows": len(rows), "raw": raw and raw_errors.in_words(raw), "heatmaps": heatmaps(rows, bool(told["effects"])),
            "tried": _tried(fitted), "causes_tried": len(fitted), "places": where[:12], "where": where, "folder": folder,
            "gain_of": _kinds(study), "sure": sure, "odds": odds_of_log, "odds_of": odds_of, "quantity": _quantity, "size": _size, "physical": physical, "parameters": _parameters(told)}


def residual_counts(study: Study) -> tuple:
    """How many measured rows step 9 used, and how many of them the model fitted within its bounds misses by more than it may."""
    rows = study.step_csv("s9_diagnosis/residuals.csv", ["residual_before"])
    return len(rows), _beyond(rows, "before")


def _parameters(told: dict) -> list:
    """The extended model's parameters in their own units, as the model fitted within its bounds has them and with the causes in it."""
    return [{"name": p["name"], "before": span(p["before"], p["unit"]), "after": span(p["after"], p["unit"])} for p in told.get("model_parameters", [])]


def _kind(name: str) -> str:
    """A kind of row, or of scatter, in words."""
    words = {**NAMES, "workmanship": "Scatter from element to element"}
    return words.get(name, name.replace("_", " "))


def _block(name: str) -> str:
    """A block of rows in words: "damping_ratio_pct in still_air"."""
    kind, inside, condition = name.partition(" in ")
    return (_kind(kind).lower() if kind in NAMES else kind) + inside + condition.replace("_", " ")


def _size(parameter: dict) -> str:
    """Value and interval of an unknown as the data know it: nothing, a limit, or both."""
    value, low, high = (physical(parameter[k], parameter.get("unit", "")) for k in ("value", "low", "high"))
    told = {"open": "not known", "lower limit": f"at least {low}", "upper limit": f"at most {high}"}
    return told.get(parameter.get("one_sided", ""), f"{value} ({low} … {high})")


def _quantity(parameter: dict) -> str:
    """Name of an unknown without the unit that its name ends with."""
    name = parameter["name"]
    unit = parameter.get("unit", "").replace("/", "_").replace("^", "").replace(" ", "_")
    if unit and unit != "-" and name.endswith("_" + unit):
        name = name[:-len(unit) - 1]
    return "times what is modelled" if name == "factor" else name.replace("_", " ")


def _beyond(rows, side: str) -> int:
    return int((rows[f"beyond_{side}"] == 1).sum()) if f"beyond_{side}" in rows else int((rows[f"residual_{side}"].abs() > 3.0).sum())


def _fitted(study: Study):
    """Entries of hypotheses.csv with log odds; others were screened out or have no row that shows them. Empty where the file is not there."""
    if not (study.results / "s9_diagnosis/hypotheses.csv").is_file():
        return pd.DataFrame()
    table = study.step_csv("s9_diagnosis/hypotheses.csv", ["cause", "location", "log_odds"])
    return table[table["log_odds"].notna()].drop_duplicates(["cause", "location"])


def _tried(table) -> list:
    """The likeliest entries in the order of the file: log odds against `nothing` before any cause is in the model. The first entry's are those
    of the detection."""
    most = max(1.0, float(table["log_odds"].max())) if len(table) else 1.0
    return [{"cause": r["cause"], "location": r["location"], "odds": r["log_odds"], "share": max(0.0, 100.0 * r["log_odds"] / most),
             "status": r.get("status", "") if isinstance(r.get("status", ""), str) else ""} for r in table.head(12).to_dict("records")]


def _kinds(study: Study) -> list:
    """Mean square of the standardised residuals, kind by kind."""
    if not (study.results / "s9_diagnosis/misfit.csv").is_file():
        return []
    table = study.step_csv("s9_diagnosis/misfit.csv", ["by", "name", "rows", "mean_square_before", "mean_square_after"])
    return [{"name": _kind(str(r["name"])), "rows": int(r["rows"]), "before": r["mean_square_before"]**0.5,
             "after": r["mean_square_after"]**0.5} for r in table[table["by"] == "type"].to_dict("records")]
