"""The model as step 1 reads it: a model folder, or a deck, which gets a file of parameters beside it."""
import json
import re
import shutil
import subprocess
import tempfile
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from .errors import InputError
from .places import Nodes, nodes_of

DECKS = (".inp", ".bdf", ".nas", ".blk", ".cdb", ".s2k", ".$2k")
OTHERS = (".dat", ".mac", ".ans", ".txt")  # a deck, a record or a table
CARDS = re.compile(rb"^\s*(BEGIN BULK|GRID[ ,*]|/PREP|NBLO|EBLO|ETBL|ET,)", re.IGNORECASE | re.MULTILINE)  # as step 1 tells a deck
UNITS = (("m", "N"), ("mm", "N"), ("m", "kN"), ("in", "lbf"))  # length and force of a deck that does not say them
SPRING_LIMITS, MASS_LIMITS = (0.2, 5.0), (0.8, 1.25)  # [-] of a stiffness of bearings or soil, and of what a structure carries; stated as a start
MOST_GROUPS = 8  # of springs or of masses that get a parameter each; more are bound to be details of the mesh
STIFFNESS_RANGE, DENSITY_RANGE = 0.2, 0.1  # [-] either way: what a modulus of elasticity and a density of a usual material may be off; stated as a start


@dataclass(frozen=True)
class Model:
    source: Path
    is_folder: bool
    parameters: str  # text of model.toml, or of the file beside a deck
    missing: list  # lines of what the engineer has to state
    nodes: Nodes | None = None
    read: list = field(default_factory=list)  # what was filled in, a line each


def is_deck(path: Path) -> bool:
    """By its ending, or where loggers use that too, by its cards."""
    return path.suffix.lower() in DECKS or (path.suffix.lower() in OTHERS and CARDS.search(path.read_bytes()) is not None)


def is_model_folder(path: Path) -> bool:
    return path.is_dir() and any((path / name).is_file() for name in ("model.toml", "nodes.csv", "elements.csv"))


def read_model(bin_folder: Path, source: Path, title: str) -> Model:
    """@throws InputError  with step 1's own line where it cannot read the model"""
    beside = source / "model.toml" if source.is_dir() else source.with_suffix(".toml")
    own, read = beside.read_text(encoding="utf-8") if beside.is_file() else "", []
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "s1_model"
        refusal = _step_1(bin_folder, source, out)
        if "write [units]" in refusal and (units := _likely_units(bin_folder, source, own)) is not None:
            own, refusal = own + units, _step_1(bin_folder, _with_text(source, own + units, Path(folder) / "deck"), out)
            read.append(f"{beside.name}: {' '.join(units.split())}: the only units in which the materials of {source.name} are those of a structure")
        if refusal:
            raise InputError(refusal)
        has = tomllib.loads(own)
        materials, nodes = out / "model/materials.csv", nodes_of(out / "model")
        if has.get("parameter") or has.get("matrices") or not materials.is_file():
            return Model(source, source.is_dir(), own, [] if "parameter" in has else [f"parameters with bounds in {beside.name}: without them steps 5 and 6 have nothing to update"], nodes, read)
        text = ("" if "title" in has else f'title = "{title}"\n') + own
        return Model(source, source.is_dir(), *_parameters(out / "model", text), nodes, read)


def _step_1(bin_folder: Path, source: Path, out: Path) -> str:
    """Runs step 1. @return its line where it refuses the model, else \"\""""
    run = subprocess.run([str(bin_folder / "s1_model"), "--model", str(source), "--out", str(out), "--set", "n_modes=1", "--quiet"], capture_output=True, text=True, check=False)
    return "" if run.returncode in (0, 1) else (run.stderr.strip().splitlines() or [f"{source}: step 1 cannot read it"])[-1]


def _with_text(deck: Path, text: str, folder: Path) -> Path:
    """`deck` in `folder`, with all files that lie beside it, and `text` in the file of its name."""
    folder.mkdir()
    for file in deck.resolve().parent.iterdir():
        if file.name != deck.with_suffix(".toml").name:
            (folder / file.name).symlink_to(file)
    (folder / deck.with_suffix(".toml").name).write_text(text, encoding="utf-8")
    return folder / deck.name


def _likely_units(bin_folder: Path, deck: Path, own: str) -> str | None:
    """The table [units] with which step 1 has no doubt of the model; None where it doubts all, or several are possible."""
    found = []
    for length, force in UNITS:
        text = f'\n[units]\nlength = "{length}"\nforce = "{force}"\n'
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "s1_model"
            if not _step_1(bin_folder, _with_text(deck, own + text, Path(folder) / "deck"), out) and not json.loads((out / "manifest.json").read_text(encoding="utf-8")).get("warnings"):
                found.append(text)
    return found[0] if len(found) == 1 else None


def _parameters(folder: Path, text: str) -> tuple:
    """`text` of the model's own file with a start of parameters, one a modulus, a density, a group of springs and a group of masses, and what is left to
    state. `folder`: the model as step 1 writes it."""
    materials = pd.read_csv(folder / "materials.csv")
    column = next((c for c in materials.columns if c.startswith("youngs_modulus") or c.startswith("E_")), None)
    density = next((c for c in materials.columns if c.startswith("density")), None)
    for row in materials.to_dict("records"):
        for name, target, key, share, unit in (("E", "youngs_modulus", column, STIFFNESS_RANGE, "Pa"), ("rho", "density", density, DENSITY_RANGE, "kg/m3")):
            if key and row[key] == row[key] and row[key] > 0:
                text += _parameter(name, target, row["material"], unit, row[key], (1 - share, 1 + share))
    missing = "bounds of the parameters: those of materials, springs and masses are a start (modulus ±20 %, density ±10 %, springs 0.2 to 5 times, masses 0.8 to 1.25 times)"
    for name, target, file, limits in (("k", "spring_stiffness", "springs.csv", SPRING_LIMITS), ("m", "point_mass", "masses.csv", MASS_LIMITS)):
        groups = list(dict.fromkeys(pd.read_csv(folder / file, dtype=str)["group"])) if (folder / file).is_file() else []
        if len(groups) > MOST_GROUPS:
            missing += f"; {file} has {len(groups)} groups: add those that may be wrong"
            continue
        for group in groups:
            text += _parameter(name, target, group, "-", 1.0, limits)
    return text, [missing]


def _parameter(name: str, target: str, of: str, unit: str, initial: float, limits: tuple) -> str:
    """A table [[parameter]]. `limits`: lower and upper bound over `initial`"""
    return (f'\n[[parameter]]\nname = "{name}_{of}"\ntarget = "{target}"\nof = ["{of}"]\nunit = "{unit}"\n'
            f"initial = {initial:.12g}\nlower = {initial * limits[0]:.12g}  # a start: state your own bounds\nupper = {initial * limits[1]:.12g}\n")


def copy_model(model: Model, target: Path) -> str:
    """Copies the model below `target` (data/NAME). @return the line of study.toml's [model] table, with {data} for that folder"""
    if model.is_folder:
        shutil.copytree(model.source, target / "model")
        beside = target / "model/model.toml"
    else:
        shutil.copy2(model.source, target / model.source.name)
        beside = target / model.source.with_suffix(".toml").name
    if model.parameters:
        beside.write_text(model.parameters, encoding="utf-8")
    return 'folder = "{data}/model"' if model.is_folder else f'inp = "{{data}}/{model.source.name}"'
