"""Where a study's data come from (workflows/<study>/source.toml), and its authors' figures beside ours."""
from ..errors import InputError
from ..study import Study

KEYS = ("what", "repository", "licence", "credit", "published_by")


def read_source(study: Study) -> dict | None:
    path = study.workflow / "source.toml"
    if not path.is_file():
        return None
    told = study.read_toml(path)
    return {
        **{key: told.get(key, "") for key in KEYS},
        "tables": [_compared(study, path, entry) for entry in told.get("published", [])],
    }


def _compared(study: Study, path, entry: dict) -> dict:
    """Published values beside the step's: in the file's order, or each beside the nearest."""
    for key in ("what", "unit", "file", "column", "values"):
        if key not in entry:
            raise InputError(f"{path}: published: no key {key}")
    table = study.step_csv(entry["file"], [entry["column"], *entry.get("where", {})])
    for column, value in entry.get("where", {}).items():
        table = table[table[column] == value]
    ours, rows = table[entry["column"]].to_numpy(float), []
    stds = table[entry["std"]].to_numpy(float) if entry.get("std") in table else None
    for i, value in enumerate(entry["values"]):
        at = int(abs(ours - value).argmin()) if entry.get("nearest") and len(ours) else i
        if at < len(ours):
            rows.append(
                {
                    "published": value,
                    "published_std": entry.get("stds", [None] * (i + 1))[i],
                    "ours": ours[at],
                    "std": None if stds is None or stds[at] != stds[at] else stds[at],
                    "deviation_pct": 100.0 * (ours[at] / value - 1.0),
                }
            )
    return {"what": entry["what"], "unit": entry["unit"], "rows": rows}
