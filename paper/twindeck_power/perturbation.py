"""data/<study>/power.toml: which inputs are changed, by how much, and which cells print them."""
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from twindeck_report.errors import InputError

from .edit import csv_edited, scaled, toml_edited

LEAST = 60  # perturbations that the check's power is told from: DESIGN section 5, over all inputs that matter


@dataclass(frozen=True)
class Perturbation:
    name: str
    file: str
    keys: tuple  # of a TOML file, with * for several
    column: str  # of a CSV file
    where: dict
    factor: float | None
    value: str | None  # in place of what stands there
    prints: tuple  # "table_01 row C column damping_constant_kNs_per_m", with *: cells that print this input
    uncheckable: str  # why no cell can notice it; "" where one should

    @property
    def slug(self) -> str:
        return re.sub(r"\W+", "_", self.name).strip("_").lower()

    def apply(self, root: Path) -> None:
        """Changes the file below `root`, which must be a copy."""
        path = root / self.file
        text = path.read_text(encoding="utf-8")
        change = (lambda old: scaled(old, self.factor)) if self.value is None else (lambda old: self.value)
        found = 0
        if self.column:
            text, found = csv_edited(text, self.column, self.where, change)
        for key in self.keys:
            text, count = toml_edited(text, key, change)
            if not count:
                raise InputError(f"power.toml: {self.name}: {self.file} has no key {key}")
            found += count
        if not found:
            raise InputError(f"power.toml: {self.name}: nothing of {self.file} is changed")
        path.write_text(text, encoding="utf-8")


@dataclass(frozen=True)
class Plan:
    perturbations: list
    quick: dict = field(default_factory=dict)  # step -> ["key=value", ...]: settings that change no cell and save time


def read_plan(path: Path) -> Plan:
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as problem:
        raise InputError(f"{path}: {problem.strerror}; the study has no list of inputs to change") from problem
    except tomllib.TOMLDecodeError as problem:
        raise InputError(f"{path}: not valid TOML: {problem}") from problem
    entries = [_one(f"{path}: perturbation {i}", entry) for i, entry in enumerate(content.get("perturbation", []), 1)]
    slugs = [entry.slug for entry in entries]
    twice = next((s for s in slugs if slugs.count(s) > 1), None)
    if twice:
        raise InputError(f"{path}: {twice} stands twice")
    return Plan(entries, content.get("quick", {}))


def _one(where: str, entry: dict) -> Perturbation:
    for key in ("name", "file"):
        if not isinstance(entry.get(key), str) or not entry[key]:
            raise InputError(f"{where}: no {key}")
    keys = entry.get("key", [])
    keys = (keys,) if isinstance(keys, str) else tuple(keys)
    column, value, factor = entry.get("column", ""), entry.get("value"), entry.get("factor")
    if bool(keys) == bool(column):
        raise InputError(f"{where}: expected key (of a TOML file) or column (of a CSV file)")
    if (value is None) == (factor is None):
        raise InputError(f"{where}: expected factor or value")
    return Perturbation(entry["name"], entry["file"], keys, column, entry.get("where", {}), None if factor is None else float(factor),
                        value, tuple(entry.get("prints", [])), entry.get("uncheckable", ""))
