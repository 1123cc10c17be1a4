"""What moves under other processors' kernels: the tables of `make processors`, where it has been run."""
import csv

from ..study import Study

LARGE = 1e-6  # relative; below it a column is the same but for rounding


def processors(study: Study) -> list:
    """One entry a kernel: tests run and failed, columns that move, those that move by more than LARGE with where."""
    folder = study.results.parent / "processors"
    columns, tests = _rows(folder / "columns.csv"), {r["kernel"]: r for r in _rows(folder / "tests.csv")}
    names = list(dict.fromkeys([*tests, *(r["kernel"] for r in columns)]))
    out = []
    for name in names:
        own = [r for r in columns if r["kernel"] == name]
        large = sorted((r for r in own if float(r["relative_change"]) > LARGE), key=lambda r: -float(r["relative_change"]))
        out.append({"name": name, "tests": tests.get(name, {}).get("tests", ""), "failed": tests.get(name, {}).get("failed", ""), "moved": len(own),
                    "large": [{"column": f"{r['file']} {r['column']}", "change": _words(float(r["relative_change"])), "where": r["where"]} for r in large]})
    return out


def _words(change: float) -> str:
    return "text differs" if change == float("inf") else f"{change:.1e}"


def _rows(file) -> list:
    if not file.is_file():
        return []
    with open(file, newline="", encoding="utf-8") as f:
        return list(csv.DictReader(f))
