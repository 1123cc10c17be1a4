"""The page: one self-contained HTML file in the look of the report."""
from pathlib import Path

import jinja2

from twindeck.comparison import Comparison
from twindeck_report.page.scripts import style

from .numbers import change, in_std, six, size
from .parts import PARTS, words

TEMPLATES = Path(__file__).parent / "templates"
full_bar_std = 3.0  # [-] a bar is full from here on: three standard deviations, beyond which chance is no explanation


def page_text(found: Comparison, names: tuple) -> str:
    """The page as text. The same two runs give the same bytes."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    parts = [p for p in (_part(found, name) for name in PARTS) if p["rows"] or p["same"]]
    return environment.get_template("compare.html.j2").render(
        style=style(), names=names, steps=[s for s in found.a.steps if s in found.b], notes=found.notes, parts=parts,
        tiles=_tiles(found), answers=_answers(found), nothing=not len(found.changed))


def _part(found: Comparison, name: str) -> dict:
    rows = [r for r in found.table[found.table["part"] == name].to_dict("records") if r["item"] != "in words"]  # these stand in the overview
    changed = [r for r in rows if r["status"] != "same"]
    same = [r for r in rows if r["status"] == "same"]
    title, meaning = PARTS[name]
    told, same = [_shown(r) for r in sorted(changed, key=size, reverse=True)], [_shown(r) for r in same]
    return {"id": name.replace(" ", "-"), "title": title, "meaning": meaning, "count": len(rows), "rows": told, "has": _columns(told),
            "same": same, "has_same": _columns(same)}


def _columns(rows: list) -> dict:
    """Which columns have something to show; texts stand to the left, tables with numbers to the right."""
    return {"numbers": any(r["number"] for r in rows), **{name: any(r[name] for r in rows) for name in ("unit", "change", "std")}}


def _shown(row: dict) -> dict:
    std, once = in_std(row), row["status"].startswith("only")
    return {"step": row["step"].split("_")[0], "words": words(row), "a": six(row["a"]), "b": six(row["b"]), "unit": row["unit"],
            "number": isinstance(row["a"], float) and isinstance(row["b"], float), "std": std,
            "change": row["status"] if once else "" if row["status"] == "same" else change(row),
            "bar": min(100, round(100 * abs(row["change_in_std"]) / full_bar_std)) if std else None,
            "over": bool(std) and abs(row["change_in_std"]) > full_bar_std}


def _tiles(found: Comparison) -> list:
    changed, results = found.changed, found.results
    told = results[results["status"].isin(("moved", "differs"))]
    once = results[results["status"].isin(("only in A", "only in B"))]
    return [{"value": int((changed["part"] == "options").sum()), "meaning": "options, seeds or versions differ"},
            {"value": int((changed["part"] == "inputs").sum()), "meaning": "input files differ"},
            {"value": f"{len(told)} of {len(results)}", "meaning": "compared results moved"},
            {"value": len(once), "meaning": "results stand in one run only"}]


def _answers(found: Comparison) -> list:
    """The two diagnoses in words, where both runs have one."""
    rows = found.table[(found.table["part"] == "diagnosis") & (found.table["item"].isin(("verdict", "in words")))].to_dict("records")
    return [{"what": r["quantity"] or "verdict", "a": six(r["a"]), "b": six(r["b"]), "same": r["status"] == "same"} for r in rows]
