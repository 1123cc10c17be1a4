"""conclusions.toml: what the paper concludes, and whether ours says the same: reproduced, not reproduced, or cannot be tested."""
from dataclasses import dataclass

from .errors import InputError
from .ladder import critical_speeds
from .statements import design_speed, least_damping
from .study import Study

REPRODUCED, NOT, UNTESTED = "reproduced", "not reproduced", "cannot be tested"
RUNS = ("NS1", "NS2", "NS3")  # the paper's deployments of Table 13


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


def _one(study: Study, result, where: str, entry: dict) -> Conclusion:
    for key in ("statement", "where", "rule"):
        if not isinstance(entry.get(key), str) or not entry[key]:
            raise InputError(f"{where}: no {key}")
    name, _, argument = entry["rule"].partition(": ")
    if name not in RULES:
        raise InputError(f"{where}: rule {entry['rule']!r}; expected one of {', '.join(RULES)}")
    holds, found = RULES[name](study, result, argument)
    if holds is None or "cannot_be_tested" in entry:
        why = entry.get("cannot_be_tested", "The step that decides it was not run.")
        return Conclusion(entry["statement"], entry["where"], UNTESTED, why.replace("{found}", found or "not computed"))
    words = entry.get("reproduced" if holds else "not_reproduced")
    if not words:
        raise InputError(f"{where}: says neither why it is reproduced nor why not, nor that it cannot be tested")
    return Conclusion(entry["statement"], entry["where"], REPRODUCED if holds else NOT, words.replace("{found}", found))


def _order(study, result, name):
    order = next((o for o in result.orders if o.name == name), None)
    return (None, "") if order is None else (order.holds, order.found)


def _galloping(study, result, _):
    speeds = critical_speeds(study)
    return (None, "") if "A" not in speeds.index else (True, f"{speeds['A']:.2f} m/s")


def _least_damping(study, result, _):
    speed = design_speed(study) if "s7_aerodynamics" in study.steps() else None
    least = least_damping(study, speed) if speed else []
    if not len(least):
        return None, ""
    low = least[least < 2.0]
    found = f"least {least.min():.2f} % in mode {least.idxmin()}"
    return not len(low), found + (f", {len(low)} of {len(least)} modes below 2 %" if len(low) else "")


def _comfort(study, result, direction):
    if "s8_validation" not in study.steps():
        return None, ""
    table = study.step_csv("s8_validation/comfort.csv", ["event", "run", "direction", "peak_m_s2", "limit_m_s2"])
    own = table[(table["direction"] == direction) & table["run"].isin(RUNS)]
    if own.empty:
        return None, ""
    above = int((~(own["peak_m_s2"] <= own["limit_m_s2"])).sum())  # an unstable bridge has no peak and is not within
    return above == 0, f"largest mean peak {own['peak_m_s2'].max():.3f} m/s², {above} of {len(own)} cases above the limit"


def _spread(study, result, _):
    said = []
    for name, words in (("standin", "the shaped set"), ("quasi_steady", "quasi-steady derivatives")):
        speeds = critical_speeds(study, name)
        speeds = speeds[speeds.index.isin(list("ACDGHI"))]
        if len(speeds):
            said.append(f"{speeds.min():.1f} to {speeds.max():.1f} m/s with {words}")
    return (True if said else None), ", ".join(said)


def _errors(study, event):
    if "s8_validation" not in study.steps():
        return None
    table = study.step_csv("s8_validation/rms.csv", ["event", "run", "channel", "direction", "error_pct"])
    table = table[(table["event"] == event) & (table["direction"] == "z") & table["run"].isin(RUNS) & table["error_pct"].notna()]
    return table if len(table) else None


def _august(study, result, _):
    table = _errors(study, "August")
    if table is None:
        return None, ""
    apart = table["channel"].isin(["M1", "M8"]) | ((table["channel"] == "M7") & (table["run"] == "NS2"))
    largest = table[~apart]["error_pct"].abs().max()
    return bool(largest < 26.0), f"{largest:.0f} %"


def _april(study, result, _):
    table = _errors(study, "April")
    if table is None:
        return None, ""
    over = int((table["error_pct"] > 0).sum())
    return over == len(table), f"{over} of {len(table)} cells"


RULES = {"order": _order, "galloping": _galloping, "least damping": _least_damping, "comfort": _comfort,
         "spread of critical speeds": _spread, "August": _august, "April": _april, "none": lambda *_: (None, "")}
