"""Two diagnoses beside each other: verdict, effects with their probabilities and sizes, the gain, the model's parameters."""
from ..results import StepResults
from .quantities import half_width
from .rows import is_missing, larger, number_row, row_of, text_row

PART = "diagnosis"


def diagnosis_rows(a: StepResults, b: StepResults) -> list:
    """Rows of the two `diagnosis.json`."""
    one, other = a.diagnosis, b.diagnosis
    rows = [_row("verdict", "", "", one.get("verdict"), other.get("verdict"))]
    for part, name in (("detection", "log_odds"), ("detection", "probability"), ("residual_test", "p_value")):
        rows.append(_row(part.replace("_", " "), name, "", one.get(part, {}).get(name), other.get(part, {}).get(name)))
    rows += _effects(_by(one.get("effects", []), _effect), _by(other.get("effects", []), _effect))
    rows += _gain(one.get("gain") or {}, other.get("gain") or {})
    rows += _parameters(_by(one.get("model_parameters", []), _name), _by(other.get("model_parameters", []), _name))
    rows += _form(_by(one.get("form") or [], _name), _by(other.get("form") or [], _name))
    rows += _listed("parameter on a bound", one.get("parameters_on_bounds", []), other.get("parameters_on_bounds", []))
    rows += _listed("correction of a channel", *([_correction(c) for c in d.get("measurement_corrections", [])] for d in (one, other)))
    told = one.get("sentences", {}), other.get("sentences", {})
    rows += [_row("in words", key.replace("_", " "), "", *(t.get(key) for t in told)) for key in dict.fromkeys([*told[0], *told[1]])]
    return [row for row in rows if not (is_missing(row["a"]) and is_missing(row["b"]))]


def _row(item, quantity, unit, a, b, std=None):
    return row_of(PART, "s9_diagnosis", item, quantity, unit, a, b, std)


def _by(entries: list, name) -> dict:
    return {name(entry): entry for entry in entries}


def _name(entry: dict) -> str:
    return str(entry.get("name"))


def _effect(entry: dict) -> str:
    states = entry.get("states") or [entry["state"]] if entry.get("state") else []
    state = f" in state {', '.join(states)}" if states else ""
    return f"{entry.get('cause')} at {entry.get('location')}{state}"


def _effects(a: dict, b: dict) -> list:
    rows = []
    for name in dict.fromkeys([*a, *b]):
        one, other = a.get(name, {}), b.get(name, {})
        rows.append(_row(f"effect {name}", "probability", "", one.get("probability"), other.get("probability")))
        sizes = [_by(effect.get("parameters", []), _name) for effect in (one, other)]
        for size in dict.fromkeys([*sizes[0], *sizes[1]]):
            values = [s.get(size, {}) for s in sizes]
            unit = next((v["unit"] for v in values if v.get("unit") and v["unit"] != "-"), "")
            rows.append(_row(f"effect {name}", size, unit, *(v.get("value") for v in values), larger(*(_std(v) for v in values))))
    return rows


def _std(estimate: dict, level=None) -> "float | None":
    low, high, level = estimate.get("low"), estimate.get("high"), estimate.get("level", level)
    return None if None in (low, high, level) else half_width(low, high, level)


def _gain(a: dict, b: dict) -> list:
    rows = [_row("gain", name, "", a.get(name), b.get(name)) for name in ("held_out", "rows", "before", "after")]
    intervals = [g.get("interval_pct") or [None, None] for g in (a, b)]
    deviations = [_std({"low": low, "high": high, "level": g.get("level")}) for (low, high), g in zip(intervals, (a, b))]
    rows.append(number_row(PART, "s9_diagnosis", "gain", "reduction_pct", "%", a.get("reduction_pct"), b.get("reduction_pct"), larger(*deviations)))
    return rows


def _parameters(a: dict, b: dict) -> list:
    rows = []
    for name in dict.fromkeys([*a, *b]):
        entries = [d.get(name, {}) for d in (a, b)]
        unit = next((e["unit"] for e in entries if e.get("unit") and e["unit"] != "-"), "")
        after = [e.get("after") or {} for e in entries]
        std = larger(*(_std(value, entry.get("level")) for value, entry in zip(after, entries)))
        rows.append(_row(f"parameter {name}", "after", unit, *(value.get("value") for value in after), std))
    return rows


def _form(a: dict, b: dict) -> list:
    """Scales of the classes of errors."""
    return [number_row(PART, "s9_diagnosis", "errors of", name, "%", *(d.get(name, {}).get("scale") for d in (a, b)),
                       larger(*(_std(d.get(name, {})) for d in (a, b)))) for name in dict.fromkeys([*a, *b])]


def _correction(entry: dict) -> str:
    more = f" with {entry['with']}" if entry.get("with") else f" by {entry['factor']:.6g}" if entry.get("action") == "scale" else ""
    state = f" in state {entry['state']}" if entry.get("state") else ""
    return f"{entry.get('action')} {entry.get('channel')}{more}{state}"


def _listed(item: str, a: list, b: list) -> list:
    return [text_row(PART, "s9_diagnosis", item, "", name if name in a else None, name if name in b else None) for name in dict.fromkeys([*a, *b])]
