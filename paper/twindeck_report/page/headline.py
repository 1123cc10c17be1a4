"""The first sentence of a report, of at most 25 words: what is wrong, where and how much, also of a second cause, how sure that is, how much better
the model becomes. Plain odds and words; log odds stay in the account for experts."""
import itertools
import math
import re
import tomllib
from pathlib import Path

from .numbers import physical
from .places import place_of, stays_of
from .raw_errors import RawErrors

MOST_WORDS = 25  # of the first sentence: what a reader takes in at a glance
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


def causes_in_words(effects: list) -> list:
    """Ways to tell the causes, each with place and size where there is room, the one that says most first. Of more than two, two are named."""
    told, more = [_claims(e) for e in effects[:2]], len(effects) - 2
    rest = [f"and {more} more cause{'s' if more > 1 else ''}"] if more > 0 else []
    several = sorted(itertools.product(*map(enumerate, told)), key=lambda ways: sum(at for at, _ in ways))
    return [" ".join([_listed([text for _, text in ways]), *rest]) for ways in several]


def _claims(effect: dict) -> list:
    """The cause's own sentence without its asides, with its place shorter and shorter, then its title in the catalogue with size and place."""
    told, title, size = in_runs(re.sub(r"\s*\([^()]*\)", "", effect.get("sentence") or "").split(";")[0].strip().rstrip(".")), _title(effect), _size(effect)
    places = [] if stays_of(effect) and len(stays_of(effect)) > 1 else _places(place_of(effect)[1])
    within = told[:1].lower() + told[1:] if places and told.lower().startswith(places[0].lower()) else told
    sentences = [_capitalised(within.replace(places[0], shorter)) for shorter in places if places[0] in within] or [told]
    titles = [f"{what}: {where}" for what in ([f"{title}, {size}"] if size else []) + [title] for where in places] + ([f"{title}, {size}"] if size else [])
    return list(dict.fromkeys([t for t in (*sentences, *titles) if t] + [title]))


def _size(effect: dict) -> str:
    """The cause's first unknown with its unit, '0.55 times' of a factor; "" where the data do not bound it or the title tells it."""
    first = next(iter(effect.get("parameters", [])), None)
    if first is None or stays_of(effect) or first.get("one_sided") == "open":
        return ""
    end = {"lower limit": ("at least ", "low"), "upper limit": ("at most ", "high")}.get(first.get("one_sided"), ("", "value"))
    number = physical(first[end[1]], first.get("unit", ""), 2)
    return end[0] + (f"{number} times" if first["name"] == "factor" else number)


def _capitalised(text: str) -> str:
    return text[:1].upper() + text[1:]


def _listed(told: list) -> str:
    return "; ".join([told[0], *(t[:1].lower() + t[1:] for t in told[1:])])


def _places(told: str) -> list:
    """A place in words, and shorter: without what stands in brackets, up to the first coordinate, its name alone."""
    whole = in_runs(re.sub(r"\s*\([^()]*\)", "", told))
    name = re.split(r",? anchored| at | round ", whole)[0]
    return [w for w in (whole, re.split(r"(?<= m),", whole)[0], name if re.search(r"[A-Z\d]", name) else "") if w]


def in_runs(told: str) -> str:
    """'C1 to C4' for 'C1, C2, C3 and C4'."""
    def short(found):
        numbers = [int(n) for n in re.findall(r"\d+", found[0])]
        return f"{found[1]}{numbers[0]} to {found[1]}{numbers[-1]}" if numbers == list(range(numbers[0], numbers[-1] + 1)) else found[0]
    return re.sub(r"\b([A-Za-z]+)\d+(?:, \1\d+)+ and \1\d+\b", short, told)


def _title(effect: dict) -> str:
    stays = stays_of(effect)
    if stays:  # step 9 finds these by themselves, without an entry of the catalogue
        return f"{len(stays)} stays modelled as bars vibrate" if len(stays) > 1 else "1 stay modelled as a bar vibrates"
    path = CATALOGUE / f"{effect['cause']}.toml"
    title = tomllib.loads(path.read_text(encoding="utf-8"))["hypothesis"].get("title") if path.is_file() else None
    factor = next((p["value"] for p in effect.get("parameters", []) if p["name"] == "factor"), None)
    if title and factor is not None:
        title = re.sub(r"\b(?:softer or stiffer|stiffer or softer)\b", "softer" if factor < 1.0 else "stiffer", title)
    return title or f"Cause {effect['cause']}"


def of_diagnosis(told: dict, rows: int, beyond: int, updating: tuple | None, raw: RawErrors | None) -> str:
    """`rows` measured values, `beyond` of which the fitted model misses by more than it may; `updating`: mean error of the frequencies [%] before
    and after step 6, where it ran; `raw`: errors without and with the causes, where frequencies were measured."""
    effects = told["effects"]
    if told["verdict"] == "none" or (told["verdict"] != "unknown" and not effects):
        first = (f"None of the {rows} measured values contradicts the fitted model" if not beyond else
                 f"None of the known causes is named, though {beyond} of {rows} measured values stand out")
        against = told["detection"]["log_odds"]
        return _joined(first, [f"no cause needed: {odds_of_log(-against)}" if against < 0 and not beyond else "", _updated(updating)])
    if told["verdict"] == "unknown":
        first = _joined(f"None of the known causes explains the {rows} measured values", [f"something is missing, {odds_of_log(told['detection']['log_odds'])}"])
        near = _places((told.get("localisation") or [{}])[0].get("words", ""))
        return next((whole for where in near if (whole := _joined(first[:-1], [f"look at {where}"])) != first), first)
    leader, alike = effects[0], equally_well(effects[0])
    certain = f"not told apart from {len(alike)} other{'s' if len(alike) > 1 else ''}" if alike else sure(leader["probability"])
    odds_too = certain if alike else f"{certain}, {odds_of(leader['probability'])}"
    tails = [[sureness, gain] for gain in _gained(told.get("gain") or {}, raw) for sureness in (odds_too, certain)]
    firsts = causes_in_words(effects)
    return next((_joined(first, parts) for first in firsts for parts in tails if words(first) + sum(map(words, parts)) <= MOST_WORDS), _joined(firsts[-1], [certain]))


def _gained(gain: dict, raw: RawErrors | None) -> list:
    """Ways to tell what the causes gain, the one that says most first. A gain is claimed by errors that anyone can check, and none where they grow."""
    if not gain.get("rows"):
        return ["gain not measured"]
    if raw is None:
        return [text + on_what for text in ([f"error {gain['reduction_pct']:.0f} % smaller"] if gain["interval_pct"][0] > 0 else ["no gain shown"]) for on_what in (" on unfitted data", "")]
    which = "unfitted" if raw.held_out else "fitted"
    falls = raw.frequency[1] < raw.frequency[0]
    no = "no gain: " if raw.worse else "" if gain["interval_pct"][0] > 0 else "gain not certain: " if falls else "no gain shown: "
    before, after = (f"{error:.2g}" for error in raw.frequency)
    errors = f"stay at {after} %" if before == after else f"{'fall' if falls else 'rise'} from {before} to {after} %"
    return [f"{no}{which} frequency errors {errors}{_but(raw)}"] + ([f"{no}errors {errors}"] if raw.held_out and not _but(raw) else [])


def _but(raw: RawErrors) -> str:
    """The frequencies whose error grows, where the mean does not."""
    if raw.frequency[1] > raw.frequency[0] or not raw.further_off:
        return ""
    return f", but mode {raw.further_off[0].mode}'s grows" if len(raw.further_off) == 1 else f", but {len(raw.further_off)} grow"


def _updated(updating: tuple | None) -> str:
    return f"mean frequency error {updating[1]:.2g} %, before updating {updating[0]:.2g} %" if updating else ""


def _joined(first: str, parts: list) -> str:
    """The parts that fit, the first ones first."""
    for part in parts:
        if part and words(first) + words(part) <= MOST_WORDS:
            first += f"; {part}"
    return first + "."
