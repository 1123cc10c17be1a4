"""What every report page shows, ready for templates/parts/."""
from ..figures.flow import flow
from ..study import Study
from . import answer, diagnosis, flowchart, model_facts, picture, places, poles, processors, provenance, scripts, shapes, still
from . import warnings as warned


def common_parts(study: Study, settings: dict) -> dict:
    """The variables of templates/base.html.j2 and of every part that it includes."""
    steps = flow(study)
    told = diagnosis.diagnosis_data(study, settings)
    modes = shapes.shape_data(study, settings, picture.causes(study, settings, picture.model_folder(study), told and told["told"]))
    data = {"modes": modes, "poles": poles.pole_data(study), "where": None}
    if (
        told
        and told["folder"]
        and modes
        and modes["meshes"]
        and any(entry["spots"] or entry["nodes"] for entry in told["where"])
    ):
        nodes = next((s for s in modes["sets"] if s["kind"] == "model"), None)
        if nodes is not None and nodes["id"] == "s6_updating":
            data["where"] = places.where_data(told["where"], _nodes(modes["meshes"][0]))
    timed = [s for s in steps if s.seconds is not None]
    return {
        "title": settings.get("title", study.name),
        "study": study.name,
        "steps": steps,
        "flowchart": flowchart.flowchart(steps),
        "duration": flowchart.duration,
        "seconds": sum(s.seconds for s in timed),
        "slowest": sorted(timed, key=lambda s: -s.seconds)[:3],
        "provenance": provenance.provenance(study, steps),
        "processors": processors.processors(study),
        "reproduced": processors.reproduced(study),
        "pulls": model_facts.pulls(study),
        "convergence": model_facts.convergence(study),
        "warnings": warned.warnings(study, steps),
        "answers": answer.answers(study),
        "diagnosis": told,
        "modes": modes,
        "poles": data["poles"],
        "where": data["where"],
        "stills": still.stills(modes) if modes else None,
        "embedded": scripts.embedded(data),
        "style": scripts.style(),
        "scripts": scripts.scripts(),
        "three": scripts.three() if modes else "",
    }


def _nodes(mesh: dict) -> int:
    return len(mesh["points"]) * 3 // 4 // 12  # base64 of three 4-byte floats a node
