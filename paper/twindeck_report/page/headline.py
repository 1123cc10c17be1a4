"""The first sentence of a report, of at most 25 words: what is wrong, where, how sure that is, how much better the model becomes. Plain odds and
words; log odds stay in the account for experts."""
import math
import re
import tomllib
from pathlib import Path

MOST_WORDS = 25  # of the first sentence: what a reader takes in at a glance
MOST_OF_THE_CAUSE = 16  # words, so that odds and gain still fit behind them
ALIKE = 3.0  # ratio of probabilities up to which two causes explain the data equally well: by less no one would bet on either
LARGEST_ODDS = 1e6  # beyond it odds are told as "over a million to 1": the catalogue is not that complete
CATALOGUE = Path(__file__).resolve().parents[3] / "workflows/common/hypotheses"
SURE = ((0.99, "almost certain"), (0.9, "very likely"), (0.5, "likely"), (0.0, "one of several"))


def odds(ratio: float) -> str:
    """'40 to 1' of a ratio of probabilities; '1 to 4' where it is below one."""
    if not ratio > 0.0:
        return "0 to 1"
    if ratio < 1.0:
        return " to ".join(reversed(odds(1.0 / ratio).rsplit(" to ", 1)))
    if ratio > LARGEST_ODDS:
        return "over a million to 1"
    digits = max(0, 1 - int(math.floor(math.log10(ratio)))) if ratio < 10.0 else 0
    rounded = round(ratio, digits) if ratio < 10.0 else float(f"{ratio:.2g}")
    return f"{rounded:,.{0 if rounded == int(rounded) else digits}f} to 1"


def odds_of(probability: float) -> str:
    """Odds of a probability against all else."""
    return odds(probability / (1.0 - probability)) if probability < 1.0 else odds(math.inf)


def odds_of_log(log_odds: float) -> str:
    return odds(math.exp(min(log_odds, 700.0)))  # 700: what a double holds


def sure(probability: float) -> str:
    return next(words for least, words in SURE if probability >= least)


def equally_well(effect: dict) -> list:
    """The rivals that explain the data as well as the leader does."""
    return [r for r in effect.get("rivals", []) if effect["probability"] <= ALIKE * r["probability"]]


def words(text: str) -> int:
    return len(text.split())


def cause_in_words(effect: dict) -> str:
    """The cause's own sentence without its asides where it is short, else its title in the catalogue with the place."""
    told = re.sub(r"\s*\([^()]*\)", "", effect.get("sentence") or "").split(";")[0].strip().rstrip(".")
    if told and words(told) <= MOST_OF_THE_CAUSE:
        return told
    place = re.sub(r"\s*\([^()]*\)", "", (effect.get("place") or {}).get("words") or "")
    title = _title(effect["cause"])
    for where in (place, re.split(" at | round |,", place)[0]):  # the name of a place says more than its coordinates
        if where and words(f"{title}: {where}") <= MOST_OF_THE_CAUSE:
            return f"{title}: {where}"
    return title


def _title(cause: str) -> str:
    path = CATALOGUE / f"{cause}.toml"
    if not path.is_file():
        return f"Cause {cause}"
    return tomllib.loads(path.read_text(encoding="utf-8"))["hypothesis"].get("title", f"Cause {cause}")


def of_diagnosis(told: dict, rows: int, beyond: int, updating: tuple | None) -> str:
    """`rows` measured values, `beyond` of which the fitted model misses by more than it may; `updating`: mean error of the frequencies [%] before
    and after step 6, where it ran."""
    effects = told["effects"]
    if told["verdict"] == "none" or (told["verdict"] != "unknown" and not effects):
        first = (f"None of the {rows} measured values contradicts the fitted model" if not beyond else
                 f"None of the known causes is named, though {beyond} of {rows} measured values stand out")
        against = told["detection"]["log_odds"]
        return _joined(first, [f"no cause needed: {odds_of_log(-against)}" if against < 0 and not beyond else "", _updated(updating)])
    if told["verdict"] == "unknown":
        near = re.sub(r"\s*\([^()]*\)", "", (told.get("localisation") or [{}])[0].get("words", "")).split(",")[0]
        first = f"None of the known causes explains the {rows} measured values"
        return _joined(first, [f"that something is missing: {odds_of_log(told['detection']['log_odds'])}", f"look at {near}" if near else ""])
    leader, alike = effects[0], equally_well(effects[0])
    first = cause_in_words(leader)
    if len(effects) > 1:
        first += f" and {len(effects) - 1} more cause{'s' if len(effects) > 2 else ''}"
    certain = f"not told apart from {len(alike)} other{'s' if len(alike) > 1 else ''}" if alike else sure(leader["probability"])
    odds_too = certain if alike else f"{certain}, {odds_of(leader['probability'])}"
    gain, on_what = _gained(told.get("gain") or {})
    whole = [_joined(first, parts) for parts in ([odds_too, gain + on_what], [odds_too, gain], [certain, gain])]
    return max(whole, key=lambda text: text.count(";"))  # of those that say most the first


def _gained(gain: dict) -> tuple:
    """What the cause gains, and on which data."""
    if not gain.get("rows"):
        return "gain not measured", ""
    if gain["interval_pct"][0] <= 0:
        return "no gain shown", " on unfitted data"
    return f"error {gain['reduction_pct']:.0f} % smaller", " on unfitted data"


def _updated(updating: tuple | None) -> str:
    return f"mean frequency error {updating[1]:.2g} %, before updating {updating[0]:.2g} %" if updating else ""


def _joined(first: str, parts: list) -> str:
    """The parts that fit, the first ones first."""
    for part in parts:
        if part and words(first) + words(part) <= MOST_WORDS:
            first += f"; {part}"
    return first + "."
