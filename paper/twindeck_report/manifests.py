"""manifest.json: what was read and written, with SHA-256. Same layout as the steps write (src/io/manifest.hpp)."""
import hashlib
import json
import platform
import time
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from .errors import InputError


def sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def write_manifest(step: str, folder: Path, inputs, outputs, started: float, message: str = "") -> None:
    """Written last into `folder`: it is the Make target."""
    manifest = {
        "format": "twindeck-manifest-1",
        "step": step,
        "status": "converged",
        "message": message,
        "inputs": {p.as_posix(): sha256(p) for p in sorted(inputs)},
        "outputs": {p.relative_to(folder).as_posix(): sha256(p) for p in sorted(outputs)},
        "seconds": round(time.monotonic() - started, 3),
        "versions": _versions(),
    }
    (folder / "manifest.json").write_text(json.dumps(manifest, indent=1) + "\n", encoding="utf-8")


def read_manifest(folder: Path) -> dict | None:
    """The manifest of a folder, None when there is none."""
    path = folder / "manifest.json"
    if not path.is_file():
        return None
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as problem:
        raise InputError(f"{path}: not valid JSON: {problem}") from problem
    for part in ("inputs", "outputs"):
        if not isinstance(manifest.get(part, {}), dict):
            raise InputError(f"{path}: {part}: expected a table of path and SHA-256")
    return manifest


def stale_outputs(folder: Path) -> list:
    """[(file, what is wrong)] for the outputs that a folder's manifest names; an absent manifest is itself a finding."""
    manifest = read_manifest(folder)
    if manifest is None:
        return [(folder / "manifest.json", "missing: the folder was not finished")]
    found = []
    for name, recorded in manifest.get("outputs", {}).items():
        path = folder / name
        if not path.is_file():
            found.append((path, "missing, but its manifest names it"))
        elif sha256(path) != recorded:
            found.append((path, "stale hash: changed since its manifest was written"))
    return found


def stale_inputs(folders: list) -> list:
    """[(folder, what is wrong)] for every folder that was made from inputs which changed or were removed since, or from a folder that is
    itself named here."""
    inputs = {folder: (read_manifest(folder) or {}).get("inputs", {}) for folder in folders}
    found = {}
    for folder, read in inputs.items():
        gone = [name for name in read if not Path(name).is_file()]
        changed = [name for name, recorded in read.items() if name not in gone and sha256(Path(name)) != recorded]
        if gone or changed:
            what = " and ".join(_first_three(names) + verb for names, verb in ((changed, " changed"), (gone, " removed")) if names)
            found[folder] = f"stale: {what} since {folder.name} was made; run `make {_target(folder.name)}`"
    while True:  # what was made from something stale is stale too
        later = {folder: next((f for f in found if any(Path(name).is_relative_to(f) for name in read)), None)
                 for folder, read in inputs.items() if folder not in found}
        later = {folder: before for folder, before in later.items() if before is not None}
        if not later:
            return list(found.items())
        found |= {folder: f"stale: made from {before.name}, which is stale; run `make {_target(folder.name)}`"
                  for folder, before in later.items()}


def _first_three(names: list) -> str:
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def _target(name: str) -> str:
    """s8_validation is made by `make s8`, tables by `make tables`."""
    return name.split("_")[0]


def _versions() -> dict:
    found = {"python": platform.python_version()}
    for package in ("pandas", "matplotlib", "jinja2"):
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            pass
    return found
