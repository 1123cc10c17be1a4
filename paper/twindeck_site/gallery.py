"""The gallery: each study with what its diagnosis says, as far as it was run here."""
import json
import shutil
import tomllib
from pathlib import Path

PICTURES = ("fig_05.png", "mode_shapes.png")  # the model's modes; a study of one's own has the second


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def verdict(results: Path) -> tuple:
    """(verdict, sentence) of a results folder; ("not run here", "") where there is no diagnosis."""
    file = results / "s9_diagnosis" / "diagnosis.json"
    if not file.is_file():
        return "not run here", ""
    said = json.loads(file.read_text(encoding="utf-8"))
    return said["verdict"], said.get("sentences", {}).get("why") or said.get("message", "")


def page(workflows: Path, results: Path, pictures: Path) -> str:
    """gallery.md; pictures that it shows are copied into the folder `pictures`."""
    lines = ["# Studies and their verdicts", "", "The verdicts are those of the results that were here when this page was made. A study of measured records needs",
             "their folder: `make all STUDY=name DATA=folder` (see the guides on [real](real_structures.md) and [changed](changed_structures.md) structures).",
             "", "| study | title | verdict | what the diagnosis says |", "|---|---|---|---|"]
    shown = []
    for file in sorted(workflows.glob("*/study.toml")):
        name = file.parent.name
        found, why = verdict(results / name)
        title = tomllib.loads(file.read_text(encoding="utf-8")).get("title", "")
        lines.append(f"| `{name}` | {_cell(title)} | {found} | {_cell(why)} |")
        picture = next((p for p in (results / name / "figures" / f for f in PICTURES) if p.is_file()), None)
        if picture:
            pictures.mkdir(parents=True, exist_ok=True)
            shutil.copy(picture, pictures / f"gallery_{name}.png")
            shown += ["", f"## {title}", "", f"![Modes of the model of {name}](pictures/gallery_{name}.png)"]
    return "\n".join(lines + shown) + "\n"
