"""What moves under other processors' kernels and in other builds: the tables of `make processors` and `make reproduce-check`, where they have
been run."""
import csv

from ..study import Study

LARGE = 1e-6  # relative; below it a column is the same but for rounding


def processors(study: Study) -> list:
    """One entry a kernel: tests run and failed, columns that move, those that move by more than LARGE with where."""
    folder = study.results.parent / "processors"
    columns, tests = _rows(folder / "columns.csv"), {r["kernel"]: r for r in _rows(folder / "tests.csv")}
    names = list(dict.fromkeys([*tests, *(r["kernel"] for r in columns)]))
    return [{"tests": tests.get(name, {}).get("tests", ""), "failed": tests.get(name, {}).get("failed", ""), **_moved(name, columns, "kernel")}
            for name in names]


def reproduced(study: Study) -> dict:
    """Files of two runs from nothing, those that tell time, those that differ; and one entry a build. Empty where it was not run."""
    folder = study.results.parent / "reproduce"
    files, columns = _rows(folder / "files.csv"), _rows(folder / "columns.csv")
    if not files:
        return {}
    return {"files": len(files), "time": sum(bool(r["why"]) for r in files),
            "different": [r["file"] for r in files if r["same"] == "no" and not r["why"]],
            "builds": [_moved(name, columns, "build") for name in dict.fromkeys(r["build"] for r in columns)]}


def _moved(name: str, columns: list, what: str) -> dict:
    """Columns that move in one run, and those that move by more than LARGE, the largest first."""
    own = [r for r in columns if r[what] == name]
    large = sorted((r for r in own if float(r["relative_change"]) > LARGE), key=lambda r: -float(r["relative_change"]))
    return {"name": name, "moved": len(own),
            "large": [{"column": f"{r['file']} {r['column']}", "change": _words(float(r["relative_change"])), "where": r["where"]} for r in large]}


def _words(change: float) -> str:
    return "text differs" if change == float("inf") else f"{change:.1e}"


def _rows(file) -> list:
    if not file.is_file():
        return []
    with open(file, newline="", encoding="utf-8") as f:
        return list(csv.DictReader(f))
