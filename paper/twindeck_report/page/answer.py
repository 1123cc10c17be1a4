"""The first screen of a report, and below it what a diagnosis says in a sentence each; a virtual campaign's is scored against what was hidden in it."""
import json

from ..errors import InputError
from ..manifests import sha256
from ..study import Study
from . import headline, picture, raw_errors, telling
from .diagnosis import residual_counts, verdict_in_words
from .numbers import physical

QUESTIONS = (("what", "What is wrong"), ("why", "Why"), ("how_sure", "How sure"), ("how_much_better", "How much better"), ("next", "What next"))
SCORE = "score/score.json"
MEASURED = {"published": "published measurements", "virtual": "its truth is known"}
MOST_NAMED = 4  # parameters that fit into the sentence
ANSWERS = {"named": "good", "in the set": "good", "missed": "bad"}


def answers(study: Study) -> list:
    """The first screen of the study, then that of its virtual campaign, where there is one with a diagnosis."""
    virtual = study.virtual()
    told = _diagnosis(virtual) if virtual is not None else None
    return [screen(study, _diagnosis(study)), *([screen(virtual, told)] if told is not None else [])]


def _diagnosis(study: Study) -> dict | None:
    path = _path(study)
    if "s9_diagnosis" not in study.steps() or not path.is_file():
        return None
    told = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(told.get("sentences"), dict):
        raise InputError(f"{path}: sentences: missing; it was written by an earlier version: run `make s9 STUDY={study.name}`")
    return told


def _path(study: Study):
    return study.results / "s9_diagnosis" / "diagnosis.json"


def screen(study: Study, told: dict | None) -> dict:
    """Sentence, picture with the place marked, bars of the modes that tell it, states side by side; below them the account in sentences."""
    settings = study.read_toml(study.workflow / "study.toml")
    for_bars, for_table = telling.telling(study, told)
    raw = raw_errors.raw_errors(for_bars)
    found = {"title": settings.get("title", study.name), "kind": _kind(study, settings), "picture": picture.marked(study, settings, told),
             "bars": telling.bars(for_bars), "states": telling.table(for_table), "in_bars": _other_model(for_bars, for_table), "updating": None if study.has_paper() else _updating(study), "sentences": [],
             "raw": raw, "raw_words": raw_errors.in_words, "on_bounds": _on_bounds(study, told), "score": None, "told": told, "tone": "", "sentence": _without_diagnosis(study, for_table)}
    if told is not None:
        rows, beyond = residual_counts(study)
        tone, title, _ = verdict_in_words(told, beyond)
        tone = "warn" if tone == "good" and told["effects"] and raw is not None and raw.worse else tone
        found |= {"tone": tone, "heading": title, "sentence": headline.of_diagnosis(told, rows, beyond, _mean_errors(study), raw),
                  "sentences": [(question, told["sentences"].get(key, "")) for key, question in QUESTIONS], "score": _score(study, _path(study))}
    return found


def _on_bounds(study: Study, told: dict | None) -> list:
    """Parameters whose bounds, not the data, say what they are: of the model that step 9 fitted, else of step 6's."""
    if told is not None:
        return told.get("parameters_on_bounds", [])
    if "s6_updating" not in study.steps() or not (study.results / "s6_updating/parameters.csv").is_file():
        return []
    table = study.step_csv("s6_updating/parameters.csv", ["parameter", "bound"])
    return table.loc[table["bound"].isin(["lower", "upper"]), "parameter"].tolist()


def _other_model(for_bars, for_table) -> str:
    """The model of the bars, where the table of states shows another one."""
    return "" if for_bars is None or for_table is None or for_bars is for_table else for_bars.after or for_bars.before


def _without_diagnosis(study: Study, told) -> str:
    """The first sentence where step 9 is not among the steps."""
    errors = _mean_errors(study)
    if errors is not None:
        return f"Updating took the mean error of the fitted frequencies from {errors[0]:.2g} to {errors[1]:.2g} %; no step looked for a cause of the rest."
    if told is None:
        return "No step has found a mode yet."
    if not told.before:
        return f"{len(told.rows)} modes were identified from the records; no model was compared with them."
    errors = [abs(r.error("before")) for r in told.rows if r.error("before") == r.error("before")]
    if errors:
        mean = sum(errors) / len(errors)
        return f"The model misses {len(errors)} measured frequencies by {mean:.2g} % in the mean; it was not updated."
    return f"The model has {len(told.rows)} modes; nothing measured was compared with them."


def _mean_errors(study: Study) -> tuple | None:
    """Mean error of the frequencies [%] before and after updating; None where step 6 did not run."""
    if "s6_updating" not in study.steps() or not (study.results / "s6_updating/summary.csv").is_file():
        return None
    summary = study.step_csv("s6_updating/summary.csv", ["quantity", "value"]).set_index("quantity")["value"]
    names = ("mean_abs_error_before_pct", "mean_abs_error_after_pct")
    return tuple(float(summary[n]) for n in names) if set(names) <= set(summary.index) else None


def _updating(study: Study) -> str | None:
    """What step 6 gained and what it changed for that, the largest changes first. None where it did not run."""
    if "s6_updating" not in study.steps() or not (study.results / "s6_updating/summary.csv").is_file():
        return None
    summary = study.step_csv("s6_updating/summary.csv", ["quantity", "value"]).set_index("quantity")["value"]
    if not {"pairs", "mean_abs_error_before_pct", "mean_abs_error_after_pct"} <= set(summary.index):
        return None
    changed = study.step_csv("s6_updating/parameters.csv", ["parameter", "unit", "initial_value", "final_value", "change_pct", "bound"])
    changed = changed.loc[changed["change_pct"].abs().sort_values(ascending=False, kind="stable").index].to_dict("records")
    words = [f"{r['parameter']} {_change(r)}" + (f" (on its {r['bound']} bound)" if r["bound"] in ("lower", "upper") else "")
             for r in changed[:MOST_NAMED]]
    more = f" and {len(changed) - MOST_NAMED} more" if len(changed) > MOST_NAMED else ""
    return (f"Mean error of {float(summary['pairs']):.0f} frequencies: {float(summary['mean_abs_error_before_pct']):.2f} % before, "
            f"{float(summary['mean_abs_error_after_pct']):.2f} % after. Changed: {', '.join(words)}{more}.")


def _change(row: dict) -> str:
    """In per cent; of what began at 0, which has no per cent, both values."""
    if row["change_pct"] == row["change_pct"]:
        return f"{row['change_pct']:+.1f} %"
    return f"from {row['initial_value']:g} to {physical(row['final_value'], row['unit'])}"


def _kind(study: Study, settings: dict) -> str:
    """Whose measurements these are: published ones only where the study has a paper."""
    measured = settings.get("measured", "published")
    return MEASURED.get(measured, "") if measured != "published" or study.has_paper() else ""


def _score(study: Study, diagnosis) -> dict | None:
    """What `make score` wrote; None where no truth is known.
    @throws InputError  where it is of another run"""
    path = study.results / SCORE
    if not path.is_file():
        return None
    score = json.loads(path.read_text(encoding="utf-8"))
    if not score.get("scored"):
        return None
    if score.get("diagnosis_sha256") != sha256(diagnosis):
        raise InputError(f"{path}: it scores another run than {diagnosis}; run `make score`")
    return {"hidden": [_hidden(h) for h in score["hidden"]], "not_hidden": score["not_hidden"], "also": score["also"],
            "parameters": _parameters(score["parameters"]) if score.get("parameters") else None}


def _parameters(found: dict) -> dict:
    """The updated parameters beside those of the bridge that the records are of, ready to be shown."""
    rows = []
    for r in found["rows"]:
        known = r.get("true_value") is not None
        spread = f" ({physical(r['true_least'], r['unit'])} to {physical(r['true_largest'], r['unit'])})" if known and r["true_least"] < r["true_largest"] else ""
        rows.append([r["parameter"], *(physical(r[name], r["unit"]) for name in ("initial_value", "updated_value")),
                     physical(r["true_value"], r["unit"]) + spread if known else "no counterpart",
                     *(f"{r[name]:+.1f} %" if known else "" for name in ("error_before_pct", "error_after_pct")),
                     ("closer" if r["closer"] else "further off") if known else ""])
    return {"words": found["words"], "rows": rows}


def _hidden(hidden: dict) -> dict:
    sizes = []
    for s in hidden["sizes"]:
        if s["value"] is not None:  # what was hidden stands in `what` already
            sizes.append(f"{s['words']}: hidden {physical(s['truth'], s['unit'])}, found {physical(s['value'], s['unit'])} "
                         f"({physical(s['low'], s['unit'])} to {physical(s['high'], s['unit'])}, 90 %); "
                         + ("the interval holds it" if s["inside"] else "the interval misses it"))
    return {"what": hidden["what"], "answer": hidden["answer"], "tone": ANSWERS.get(hidden["answer"], "warn"), "sizes": sizes}
