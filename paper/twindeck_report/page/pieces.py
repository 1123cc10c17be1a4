"""Small pieces of a page: a picture, a step's summary, the template engine."""
import base64
import html
import struct
from pathlib import Path

import jinja2
from markupsafe import Markup

from ..study import Study

TEMPLATES = Path(__file__).resolve().parents[1] / "templates"


def environment() -> jinja2.Environment:
    found = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    found.globals["sized"] = sized
    found.tests["cannot_be_asked"] = lambda words: words.startswith("Cannot be asked")
    return found


def render(template: str, **values) -> str:
    return environment().get_template(template).render(**values)


def text(study: Study, name: str) -> str:
    path = study.results / name
    if not path.is_file():
        # a table that is gone is named by the check; the page says so in its place
        return f"<p class='bad'>{html.escape(path.name)} is missing: run make tables.</p>"
    return path.read_text(encoding="utf-8")


def image(study: Study, name: str) -> str | None:
    path = study.results / "figures" / f"{name}.png"
    return base64.b64encode(path.read_bytes()).decode() if path.is_file() else None


def sized(png: str) -> Markup:
    """Width and height of a base64 PNG as attributes, so that the page keeps its place before the picture is decoded."""
    width, height = struct.unpack(">II", base64.b64decode(png[:64])[16:24])  # of the IHDR chunk, which comes first
    return Markup(f'width="{width}" height="{height}"')


def six(value) -> str:
    """Six significant digits of a number; text stays text."""
    try:
        return f"{float(value):.6g}"
    except (TypeError, ValueError):
        return "" if value is None else str(value)


def quantities(study: Study, name: str) -> list:
    """A step's summary.csv, if it wrote one."""
    if not (study.results / name).is_file():
        return []
    table = study.step_csv(name, ["quantity", "value", "unit"])
    return [{"quantity": r["quantity"].replace("_", " "), "value": six(r["value"]), "unit": "" if r["unit"] == "-" else r["unit"]}
            for r in table.fillna("").to_dict("records")]
