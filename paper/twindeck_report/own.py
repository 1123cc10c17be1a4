"""held.toml: computed numbers of ours that the paper has no counterpart of (stay forces, errors of left-out pairs, critical speeds beside
Table 12). Nothing is claimed of them; the ratchet holds them where they are."""
from .cells import csv_text, number
from .errors import InputError
from .ratchet import Held
from .study import Study
from .tolerances import CARRIED, KINDS


def own_numbers(study: Study) -> list:
    """Of the files that are there; one whose step has not run, or has nothing to tell, gives none."""
    path = study.data / "held.toml"
    if not path.is_file():
        return []
    found = []
    for i, entry in enumerate(study.read_toml(path).get("held", []), 1):
        found += _numbers(study, f"{path}: held {i}", entry)
    keys = [cell.key for cell in found]
    twice = next((key for key in keys if keys.count(key) > 1), None)
    if twice:
        raise InputError(f"{path}: {' '.join(twice)} stands twice; add a column to `key` that tells the rows apart")
    return found


def _numbers(study: Study, where: str, entry: dict) -> list:
    for name in ("name", "file", "key", "kind", "meaning"):
        if not isinstance(entry.get(name), str) or not entry[name]:
            raise InputError(f"{where}: no {name}")
    if entry["kind"] not in KINDS or entry["kind"] in CARRIED:
        raise InputError(f"{where}: kind {entry['kind']!r}; expected a kind of computed number")
    file = entry["file"]
    if not study.has(file.split("/")[0]) or not study.path_of(file).is_file():
        return []
    keys, columns, only = entry["key"].split("+"), entry.get("columns", []), entry.get("where", {})
    table = study.step_csv(file, [*keys, *columns, *only], text=True)
    rows = [r for r in table.to_dict("records") if all(r[column] in wanted for column, wanted in only.items())]
    found = []
    for row in rows:
        for column in columns:
            value = number(row[column])
            if value is not None:
                found.append(Held(entry["name"], " ".join(row[k] for k in keys), column, entry["kind"], csv_text(value)))
    return found
