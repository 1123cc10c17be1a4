"""report.html: one page that needs nothing beside it."""
from pathlib import Path

from .check import explain, percent, run_check
from .figures import figures_of
from .page.parts import common_parts
from .page.pieces import image, quantities, render, six, text
from .statements import critical_rows, ranges_of_table_13
from .study import Study
from .tables import TABLES, table_name
from .trust_region import trust_region_facts


def write_report(study: Study) -> Path:
    """Reads tables/, figures/ and the steps' results as they lie there, runs the paper check, writes report/report.html."""
    settings = study.read_toml(study.workflow / "study.toml")
    result = run_check(study)
    tables = [{"number": n, "name": table_name(n), "html": text(study, f"tables/{table_name(n)}.html")} for n in TABLES]
    figures = [{"name": f.NAME, "caption": f.CAPTION, "png": image(study, f.NAME)} for f in figures_of(study)]
    parameters = study.step_csv("s6_updating/parameters.csv", ["parameter", "initial_value", "change_pct", "lower", "upper",
                                                              "bound"])
    page = render(
        "report.html.j2", **common_parts(study, settings), paper_sections=True, measured=settings.get("measured", "published"), result=result,
        cells=[_cell(c) for c in result.cells], percent=percent, tables=tables, figures=figures, tiles=_tiles(result),
        critical=critical_rows(study), ranges=ranges_of_table_13(study),
        bounds=_bounds(study, parameters), trust=trust_region_facts(study), summary=quantities(study, "s6_updating/summary.csv"),
        errata=study.read_toml(study.data / "errata.toml").get("erratum", []), model=quantities(study, "s1_model/summary.csv"))
    target = study.results / "report" / "report.html"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(page, encoding="utf-8")
    return target


def _tiles(result) -> list:
    """The shortest account of how far ours are from the paper's."""
    inside = sum(c.verdict == "inside" for c in result.cells)
    judged = sum(not c.shown for c in result.cells)
    return [{"value": f"{inside} of {judged}", "meaning": "compared cells inside their tolerance"},
            {"value": sum(o.holds for o in result.orders), "meaning": f"of {len(result.orders)} orderings and signs that carry conclusions hold"}]


def _cell(cell) -> dict:
    used = cell.used_pct
    return {"table": cell.table, "row": cell.row, "column": cell.column, "paper": cell.paper, "ours": six(cell.ours),
            "deviation": six(cell.deviation), "allowed": six(cell.allowed), "used": used if used != float("inf") else None,
            "kind": cell.kind, "verdict": cell.verdict, "basis": cell.basis,
            "hint": explain(cell) if cell.verdict in ("outside", "stale entry") else ""}


def _bounds(study: Study, parameters) -> list:
    """Parameters with where they ended, and where the paper's ended: its change against the same bounds."""
    paper = {r["parameter"]: r["change_pct"] for r in study.paper_table(8).to_dict("records")}
    rows = []
    for row in parameters.to_dict("records"):
        low, high = (100.0 * (row[side] / row["initial_value"] - 1.0) for side in ("lower", "upper"))
        printed = paper.get(row["parameter"])
        theirs = "" if printed is None else _side(float(printed), low, high)
        rows.append({"name": row["parameter"], "low": low, "high": high, "change": row["change_pct"],
                     "bound": row["bound"] if row["bound"] in ("lower", "upper") else "", "paper": printed or "",
                     "theirs": theirs})
    return rows


def _side(change: float, low: float, high: float) -> str:
    if abs(change - low) < 0.005:
        return "lower"
    return "upper" if abs(change - high) < 0.005 else ""
