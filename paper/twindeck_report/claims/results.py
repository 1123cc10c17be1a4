"""What claims are computed from: numbers of a step's tables, settings that a step ran with, and tolerances by the printed digits.
Each gives None where the study does not hold it."""
import tomllib

from ..cells import decimals
from ..manifests import read_manifest
from ..study import Study

ROUNDING = "Carried over from the paper through the study's data: the rounding of the printed digits."
COUNT = "A count: equal or not."
SYNTHETIC = "The aerodynamic coefficients are synthetic: shown beside the paper's."


def rounding(text: str) -> float:
    return 0.5 * 10.0 ** -decimals(text)


def exact(text: str) -> float:
    return 0.0


def relative(share: float):
    return lambda text: share * abs(float(text))


def table(study: Study, name: str, columns=()):
    """A step's CSV file; None where the study lacks the step or the file."""
    if not study.has(name.split("/")[0]) or not study.path_of(name).is_file():
        return None
    return study.step_csv(name, columns)


def from_table(name: str, columns, pick):
    """`pick(table)` as a number."""
    def compute(study: Study):
        rows = table(study, name, columns)
        found = None if rows is None else pick(rows)
        return None if found is None else float(found)
    return compute


def quantity(name: str, wanted: str, factor: float = 1.0):
    """A number of a step's summary.csv."""
    def pick(rows):
        values = rows.set_index("quantity")["value"]
        return factor * float(values[wanted]) if wanted in values.index else None
    return from_table(f"{name}/summary.csv", ["quantity", "value"], pick)


def settings(study: Study, step: str) -> dict:
    """The resolved configuration that a step ran with, from its manifest."""
    folder = study.path_of(step)
    manifest = read_manifest(folder) if study.has(step) else None
    if manifest is None:
        return {}
    study.used.add(folder / "manifest.json")
    return tomllib.loads(manifest.get("config_toml", ""))


def setting(step: str, key: str, factor: float = 1.0):
    """A number of it by its dotted key; a list counts as its length."""
    def compute(study: Study):
        found = settings(study, step)
        for part in key.split("."):
            found = found.get(part) if isinstance(found, dict) else None
        if isinstance(found, list):
            return float(len(found))
        return factor * float(found) if isinstance(found, (int, float)) and not isinstance(found, bool) else None
    return compute


def entry(step: str, list_name: str, name: str, key: str):
    """A number of the entry called `name` in a list of tables: [[event]] name = "August", speed = ..."""
    def compute(study: Study):
        rows = [row for row in settings(study, step).get(list_name, []) if row.get("name") == name]
        return float(rows[0][key]) if rows else None
    return compute
