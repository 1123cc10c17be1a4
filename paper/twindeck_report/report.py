"""report.html: one page that needs nothing beside it."""
from pathlib import Path

from .check import explain, percent, run_check
from .conclusions import conclude
from .deviations import KIND_HEADER, kind_rows, simplest_rows
from .figures import figures_of
from .ladder import ladder
from .page.parts import common_parts
from .page.pieces import image, quantities, render, six, text
from .page.reliability import PICTURES, reliability
from .statements import critical_rows, ranges_of_table_13
from .power import power_page
from .study import Study
from .tables import TABLES, table_name
from .trust_region import trust_region_facts
from .updating import bounds, costs, left_out


def write_report(study: Study) -> Path:
    """Reads tables/, figures/ and the steps' results as they lie there, runs the paper check, writes report/report.html."""
    settings = study.read_toml(study.workflow / "study.toml")
    result = run_check(study)
    tables = [{"number": n, "name": table_name(n), "html": text(study, f"tables/{table_name(n)}.html")} for n in TABLES]
    figures = [{"name": f.NAME, "caption": f.CAPTION, "png": image(study, f.NAME)} for f in figures_of(study) if f.NAME not in PICTURES]
    page = render(
        "report.html.j2", **common_parts(study, settings), paper_sections=True, measured=settings.get("measured", "published"), result=result,
        cells=[_cell(c) for c in result.cells], kinds=(KIND_HEADER, kind_rows(result)), simplest=simplest_rows(result), percent=percent, tables=tables, figures=figures, tiles=_tiles(result),
        critical=critical_rows(study), ranges=ranges_of_table_13(study), conclusions=conclude(study, result), ladder=ladder(study), reliability=reliability(study),
        bounds=bounds(study), costs=costs(study), left_out=left_out(study), power=power_page(study), trust=trust_region_facts(study), summary=quantities(study, "s6_updating/summary.csv"),
        errata=study.read_toml(study.data / "errata.toml").get("erratum", []), model=quantities(study, "s1_model/summary.csv"))
    target = study.results / "report" / "report.html"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(page, encoding="utf-8")
    return target


def _tiles(result) -> list:
    """The shortest account of how far ours are from the paper's."""
    own = result.counts.kinds.get("predicted")
    return [{"value": f"{own.inside} of {own.compared}" if own else "none", "meaning": "numbers computed without a fit to the paper agree with it"},
            {"value": sum(o.holds for o in result.orders), "meaning": f"of {len(result.orders)} orderings and signs that carry conclusions hold"}]


def _cell(cell) -> dict:
    used = cell.used_pct
    return {"table": cell.table, "row": cell.row, "column": cell.column, "paper": cell.paper, "ours": six(cell.ours),
            "deviation": six(cell.deviation), "allowed": six(cell.allowed), "used": used if used != float("inf") else None,
            "kind": cell.kind, "verdict": cell.verdict, "basis": cell.basis,
            "hint": explain(cell) if cell.verdict in ("outside", "stale entry") else ""}
