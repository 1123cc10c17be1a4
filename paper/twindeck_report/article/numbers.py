"""Numbers that the article's text names, as LaTeX macros: `\\valName` is ours, `\\paperName` the paper's. What a study did not compute
stands as n/a, so that the text compiles and says so."""
import json

from ..cells import decimals, number, shown
from ..check import CheckResult
from ..claims import COMPUTED
from ..ladder import set_level
from ..study import Study
from ..tables.writer import tex
from ..tolerances import KINDS
from ..updating import costs, left_out

ABSENT = "n/a"
DIGITS = ("Zero", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine")
MODELS = "ACDGHI"  # rows of Table 12
ERROR_TABLES = (6, 7, 9)


def camel(name: str) -> str:
    """preliminary_f10 -> PreliminaryFOneZero: a macro's name holds letters alone."""
    words = name.replace("-", "_").split("_")
    return "".join(DIGITS[int(c)] if c.isdigit() else c for word in words for c in word[:1].upper() + word[1:])


def numbers(study: Study, result: CheckResult) -> dict:
    """{macro: text} of everything below, in an order that does not change."""
    found = {name: ABSENT for name in names()}
    found |= _claims(result) | _check(result) | _errors(study) | _critical(study) | _bounds(study) | _diagnosis(study)
    return found


def names() -> list:
    """Every macro that numbers() defines, whatever the study holds."""
    claims = [f"{who}{camel(name)}" for name in COMPUTED for who in ("val", "paper")]
    check = ["valCellsCompared", "valCellsInside", "valCellsKnown", "valCellsShown", "valPrintedNumbers", "valClaims", "valClaimsComputed", "valClaimsCompared",
             "valIndependentTold", "valIndependentKinds", "valNullToo", "valRepetitions", "valRatchetHeld", "valRatchetExcused",
             "valOrdersHolding", "valOrders", "valRmsTableTwo", "valRmsTableSeven", "valRmsTableOneTwo"]
    kinds = [f"valKind{camel(kind)}" for kind in KINDS]
    errors = [f"{who}MeanError{camel(str(n))}" for n in ERROR_TABLES for who in ("val", "paper")] + ["valMeanErrorCommonBefore", "valMeanErrorCommonAfter", "valMeanErrorNotUpdated",
                                                                                               "valMeanErrorLeftOut", "valCostPublished", "valCostOptimum",
                                                                                               "valCostStart", "valStandInLevel"]
    critical = [f"{who}Critical{model}" for model in MODELS for who in ("val", "paper")] + ["valQuasiSteadyD"]
    rest = ["valParametersOnBounds", "valParametersOnBoundsList", "valParametersUpdatedCount", "valVerdict", "valDiagnosisMessage", "valDiagnosisCause",
            "valDiagnosisProbability", "valGainBefore", "valGainAfter", "valGainReduction"]
    return claims + check + kinds + errors + critical + rest


def macros(found: dict) -> str:
    lines = ["% Made from the results; do not edit."]
    return "\n".join(lines + [f"\\newcommand{{\\{name}}}{{{text}}}" for name, text in found.items()]) + "\n"


def _claims(result: CheckResult) -> dict:
    found = {}
    for claim in result.claims:
        if claim.name in COMPUTED:
            found[f"paper{camel(claim.name)}"] = tex(claim.paper)
            if claim.ours is not None:
                # a difference that the paper's digits would hide is shown with one digit more
                text = claim.shown if number(claim.shown) else f"{claim.ours:.{decimals(claim.paper) + 1}f}"
                found[f"val{camel(claim.name)}"] = tex(text)
    return found


def _check(result: CheckResult) -> dict:
    computed = [c for c in result.claims if c.ours is not None]
    found = {"valCellsCompared": sum(not c.shown for c in result.cells), "valCellsInside": result.count("inside"),
             "valCellsKnown": result.count("known"), "valCellsShown": result.count("shown"),
             "valPrintedNumbers": sum(printed for _, printed, *_ in result.numbers), "valClaims": len(result.claims),
             "valClaimsComputed": len(computed), "valClaimsCompared": sum(c.allowed is not None for c in computed),
             "valIndependentTold": tex(result.counts.told), "valIndependentKinds": tex(result.counts.by_kind), "valNullToo": result.counts.null_too, "valRepetitions": result.counts.repetitions, "valRatchetHeld": result.ratchet.held or 0,
             "valRatchetExcused": len(result.ratchet.excused),
             "valOrdersHolding": sum(o.holds for o in result.orders), "valOrders": len(result.orders)}
    for kind in KINDS:
        found[f"valKind{camel(kind)}"] = sum(kinds.get(kind, 0) for *_, kinds in result.numbers)
    for rms in result.rms:
        name = f"valRmsTable{camel(str(int(rms.rule.table.split('_')[1])))}"
        if rms.value is not None and name in names():
            found[name] = f"{100 * rms.value:.1f}"
    return {name: str(value) for name, value in found.items()}


def _errors(study: Study) -> dict:
    """Mean absolute errors of frequency in percent; over the pairs that Tables 7 and 9 share too."""
    found, by_pair = {}, {}
    for n in ERROR_TABLES:
        table = study.step_csv(f"tables/table_{n:02d}.csv", ["error_pct", "error_pct_paper"])
        found[f"valMeanError{camel(str(n))}"] = f"{table['error_pct'].abs().mean():.2f}"
        found[f"paperMeanError{camel(str(n))}"] = f"{table['error_pct_paper'].abs().mean():.2f}"
        if "experimental_mode" in table:
            by_pair[n] = table.set_index("experimental_mode")["error_pct"].abs()
    common = by_pair[7].index.intersection(by_pair[9].index)
    found["valMeanErrorCommonBefore"], found["valMeanErrorCommonAfter"] = (f"{by_pair[n][common].mean():.2f}" for n in (7, 9))
    predicted = left_out(study)
    if predicted:
        found["valMeanErrorNotUpdated"], found["valMeanErrorLeftOut"] = (f"{predicted['means'][name]:.2f}" for name in ("before", "predicted"))
    found |= {f"valCost{camel(point)}": f"{cost:.5f}" for point, cost in costs(study).items()}
    return found


def _critical(study: Study) -> dict:
    table = study.step_csv("tables/table_12.csv", text=True).set_index("ns")
    found = {f"paperCritical{m}": table.at[m, "V_cr_m_per_s_paper"] for m in MODELS if m in table.index}
    found |= {f"valCritical{m}": shown(table.at[m, "V_cr_m_per_s"], table.at[m, "V_cr_m_per_s_paper"]) for m in MODELS if m in table.index}
    steady = study.step_csv("tables/table_12_quasi_steady.csv", text=True).set_index("ns")
    found["valQuasiSteadyD"] = shown(steady.at["D", "V_cr_m_per_s"], "0.00")
    level = set_level(study, "standin")
    if level is not None:
        found["valStandInLevel"] = f"{level:.4f}"
    return found


def _bounds(study: Study) -> dict:
    table = study.step_csv("s6_updating/parameters.csv", ["parameter", "bound"])
    ends = table[table["bound"].isin(["lower", "upper"])]
    words = [f"{tex(p)} ({b})" for p, b in zip(ends["parameter"], ends["bound"])]
    return {"valParametersOnBounds": str(len(ends)), "valParametersOnBoundsList": ", ".join(words) or "none", "valParametersUpdatedCount": str(len(table))}


def _diagnosis(study: Study) -> dict:
    path = study.results / "s9_diagnosis" / "diagnosis.json"
    if "s9_diagnosis" not in study.steps() or not path.is_file():
        return {}
    study.used.add(path)
    told = json.loads(path.read_text(encoding="utf-8"))
    found = {"valVerdict": told["verdict"], "valDiagnosisMessage": tex(told.get("message", "")) or ABSENT}
    if told.get("effects"):
        first = told["effects"][0]
        found |= {"valDiagnosisCause": tex(f"{first['cause']}@{first['location']}"), "valDiagnosisProbability": f"{first['probability']:.2f}"}
    gain = told.get("gain", {})
    for macro, key in (("valGainBefore", "before"), ("valGainAfter", "after"), ("valGainReduction", "reduction_pct")):
        if isinstance(gain.get(key), (int, float)):
            found[macro] = f"{gain[key]:.1f}"
    return found
