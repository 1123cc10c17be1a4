"""report.html: one page that needs nothing beside it."""
import base64
import html
import json
from pathlib import Path

import jinja2

from .check import explain, percent, run_check
from .figures import FIGURES
from .figures.flow import flow
from .study import Study
from .tables import TABLES, table_name
from .trust_region import trust_region_facts

TEMPLATE = Path(__file__).parent / "templates"


def write_report(study: Study) -> Path:
    """Reads tables/, figures/ and the steps' results as they lie there, runs the paper check, writes report/report.html."""
    settings = study.read_toml(study.workflow / "study.toml")
    result = run_check(study)
    tables = [{"number": n, "name": table_name(n), "html": _text(study, f"tables/{table_name(n)}.html")} for n in TABLES]
    declared = study.steps()
    figures = [{"name": f.NAME, "caption": f.CAPTION, "png": _image(study, f.NAME)}
               for f in FIGURES if all(step in declared for step in f.NEEDS)]
    parameters = study.step_csv("s6_updating/parameters.csv", ["parameter", "initial_value", "change_pct", "lower", "upper",
                                                              "bound"])
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    steps = flow(study)
    page = environment.get_template("report.html.j2").render(
        title=settings.get("title", study.name), study=study.name, measured=settings.get("measured", "published"),
        steps=steps, result=result, cells=[_cell(c) for c in result.cells], percent=percent, tables=tables, figures=figures,
        bounds=_bounds(study, parameters), trust=trust_region_facts(study),
        summary=_quantities(study, "s6_updating/summary.csv"),
        errata=study.read_toml(study.data / "errata.toml").get("erratum", []),
        provenance=_provenance(study, steps), model=_quantities(study, "s1_model/summary.csv"))
    target = study.results / "report" / "report.html"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(page, encoding="utf-8")
    return target


def _text(study: Study, name: str) -> str:
    path = study.results / name
    if not path.is_file():
        # a table that is gone is named by the check; the page says so in its place
        return f"<p class='bad'>{html.escape(path.name)} is missing: run make tables.</p>"
    return path.read_text(encoding="utf-8")


def _image(study: Study, name: str) -> str | None:
    path = study.results / "figures" / f"{name}.png"
    return base64.b64encode(path.read_bytes()).decode() if path.is_file() else None


def _cell(cell) -> dict:
    used = cell.used_pct
    return {"table": cell.table, "row": cell.row, "column": cell.column, "paper": cell.paper, "ours": _six(cell.ours),
            "deviation": _six(cell.deviation), "allowed": _six(cell.allowed), "used": used if used != float("inf") else None,
            "kind": cell.kind, "verdict": cell.verdict, "basis": cell.basis,
            "hint": explain(cell) if cell.verdict in ("outside", "stale entry") else ""}


def _six(value) -> str:
    try:
        return f"{float(value):.6g}"
    except (TypeError, ValueError):
        return "" if value is None else str(value)


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


def _quantities(study: Study, name: str) -> list:
    """A step's summary.csv, if it wrote one."""
    if not (study.results / name).is_file():
        return []
    table = study.step_csv(name, ["quantity", "value", "unit"])
    return [{"quantity": r["quantity"].replace("_", " "), "value": _six(r["value"]), "unit": "" if r["unit"] == "-" else r["unit"]}
            for r in table.fillna("").to_dict("records")]


def _provenance(study: Study, steps) -> list:
    """What each step was made with, from its manifest."""
    rows = []
    for step in steps:
        path = study.results / step.token / "manifest.json"
        if not path.is_file():
            continue
        manifest = json.loads(path.read_text(encoding="utf-8"))
        libraries = manifest.get("libraries", {})
        rows.append({"token": step.token, "version": manifest.get("version", ""), "commit": str(manifest.get("commit", "")),
                     "seed": manifest.get("seed", ""), "threads": manifest.get("threads", ""),
                     "libraries": ", ".join(f"{k} {v}" for k, v in libraries.items()) if isinstance(libraries, dict) else "",
                     "inputs": manifest.get("inputs", {}), "outputs": manifest.get("outputs", {}),
                     "config": manifest.get("config_toml", "")})
    return rows
