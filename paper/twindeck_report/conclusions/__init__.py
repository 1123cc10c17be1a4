"""conclusions.toml: what the paper states in sections 2 to 7 and a result can decide, and whether ours says the same: reproduced, not
reproduced, or cannot be tested."""
from collections import Counter
from dataclasses import dataclass

from ..errors import InputError
from ..study import Study
from . import identification, updating, wind

REPRODUCED, NOT, UNTESTED = "reproduced", "not reproduced", "cannot be tested"


@dataclass(frozen=True)
class Conclusion:
    statement: str
    where: str
    verdict: str
    why: str


def conclude(study: Study, result) -> list:
    """Empty for a study without conclusions.toml. @param result  of run_check"""
    path = study.data / "conclusions.toml"
    if not path.is_file():
        return []
    return [_one(study, result, f"{path}: conclusion {i}", entry)
            for i, entry in enumerate(study.read_toml(path).get("conclusion", []), 1)]


def summed_up(conclusions: list) -> str:
    found = Counter(c.verdict for c in conclusions)
    return f"{len(conclusions)} statements of the paper: " + ", ".join(f"{found[v]} {v}" for v in (REPRODUCED, NOT, UNTESTED))


def _one(study: Study, result, where: str, entry: dict) -> Conclusion:
    for key in ("statement", "where", "rule"):
        if not isinstance(entry.get(key), str) or not entry[key]:
            raise InputError(f"{where}: no {key}")
    name, _, argument = entry["rule"].partition(": ")
    if name not in RULES:
        raise InputError(f"{where}: rule {entry['rule']!r}; expected one of {', '.join(RULES)}")
    holds, found = RULES[name](study, result, argument)
    if holds is None or "cannot_be_tested" in entry:
        why = entry.get("cannot_be_tested", entry.get("open", "") if found else "") or "The step that decides it was not run."
        return Conclusion(entry["statement"], entry["where"], UNTESTED, why.replace("{found}", found or "not computed"))
    words = entry.get("reproduced" if holds else "not_reproduced")
    if not words:
        raise InputError(f"{where}: says neither why it is reproduced nor why not, nor that it cannot be tested")
    return Conclusion(entry["statement"], entry["where"], REPRODUCED if holds else NOT, words.replace("{found}", found))


def _order(study, result, name):
    order = next((o for o in result.orders if o.name == name), None)
    return (None, "") if order is None else (order.holds, order.found)


RULES = {"order": _order, **identification.RULES, **updating.RULES, **wind.RULES, "none": lambda *_: (None, "")}
