"""Everything that the steps warned of, worst first: what did not converge, what may make a number wrong, what is to be read with care."""
import json
from dataclasses import dataclass

from ..manifests import read_manifest
from ..study import Study
from .quality import flaws

# Rank of a warning. The words are those that the steps write; a warning with none of them counts as `wrong`, because what nobody has
# judged yet is taken seriously.
STOPPED, WRONG, CARE = 0, 1, 2
TITLES = {STOPPED: ("bad", "not finished"), WRONG: ("bad", "numbers may be wrong"), CARE: ("warn", "read with care")}
WORDS_OF_CARE = ("on a bound", "cannot tell", "are not used", "passed over", "no row in use", "ends at the end of its grid")


@dataclass(frozen=True)
class Warning:
    step: str
    rank: int
    text: str

    @property
    def tone(self) -> str:
        return TITLES[self.rank][0]

    @property
    def title(self) -> str:
        return TITLES[self.rank][1]


def warnings(study: Study, steps) -> list:
    """Worst first, within a rank in the order of the steps. `steps` as figures.flow.flow gives them."""
    found = []
    for step in steps:
        found += _ending(study, step)
    for folder in _folders(study, [s.token for s in steps]):
        told = (read_manifest(folder) or {}).get("warnings") or []
        study.used.add(folder / "manifest.json")
        found += [Warning(folder.name, CARE if any(w in text for w in WORDS_OF_CARE) else WRONG, text) for text in map(str, told)]
    found += [Warning("s9_diagnosis", CARE, text) for text in _of_the_form(study)]
    found += [Warning("s3_identification", WRONG if dead else CARE, text) for text, dead in flaws(study)]
    order = [s.token for s in steps]
    return sorted(dict.fromkeys(found), key=lambda w: (w.rank, order.index(w.step) if w.step in order else len(order)))


def _folders(study: Study, declared: list) -> list:
    """The declared steps' folders, then further runs of a step that a study keeps beside them (a first look)."""
    own = [study.results / token for token in declared if (study.results / token / "manifest.json").is_file()]
    others = [path.parent for path in sorted(study.results.glob("*/manifest.json")) if not path.parent.suffix and path.parent not in own]
    return own + others


def _ending(study: Study, step) -> list:
    """A step that has not run, did not converge, or whose last run did not and left its earlier results in place."""
    found = []
    if step.status == "not run":
        found.append(Warning(step.token, STOPPED, "this step has not run"))
    elif step.status != "converged":
        found.append(Warning(step.token, STOPPED, step.message or "did not converge"))
    beside = study.results / f"{step.token}.unconverged"
    if beside.is_dir():
        told = (read_manifest(beside) or {}).get("message") or "did not converge"
        found.append(Warning(step.token, STOPPED, f"the last run is not what this page shows: {told} (see {beside.name})"))
    return found


def _of_the_form(study: Study) -> list:
    """What step 9 writes beside its verdict."""
    path = study.results / "s9_diagnosis/diagnosis.json"
    if "s9_diagnosis" not in study.steps() or not path.is_file():
        return []
    return [str(text) for text in json.loads(path.read_text(encoding="utf-8")).get("warnings", [])]
