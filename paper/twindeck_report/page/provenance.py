"""What each step was made with, from its manifest."""
import json

from ..study import Study


def provenance(study: Study, steps) -> list:
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
