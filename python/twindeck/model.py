"""Model folders as data frames: nodes, elements, materials, sections and their neighbours, and the parameters with their bounds."""
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from .contract import MODEL, NEEDED, PARAMETERS, check_references, check_table, is_empty
from .errors import InputError
from .tables import read_table, with_units
from .writing import csv_text, toml_text, write_files

_ELSEWHERE = ("matrices", "matrix_element")  # keys of model.toml that name files of matrices beside it


@dataclass
class Model:
    """A model folder in memory.

    Attributes
    ----------
    tables : dict of str to pandas.DataFrame
        `nodes`, `elements`, `materials`, `sections`, `supports`, `springs`, `links`, `masses`, `points`, `loads`, as far as they are there;
        of a matrix model `dofs`. `model["nodes"]` is `model.tables["nodes"]`.
    parameters : pandas.DataFrame
        What may be updated: `name target of unit initial lower upper`, `of` a list of names. Values are in the unit of the column `unit`.
    settings : dict
        The rest of `model.toml`: title, gravity, prestress, formulation.
    """

    tables: dict
    parameters: pd.DataFrame = field(default_factory=pd.DataFrame)
    settings: dict = field(default_factory=dict)

    def __getitem__(self, name: str) -> pd.DataFrame:
        if name not in self.tables:
            raise InputError(f"the model has no table '{name}'; it has {', '.join(self.tables)}")
        return self.tables[name]

    def __setitem__(self, name: str, frame: pd.DataFrame) -> None:
        self.tables[name] = frame

    def write(self, folder) -> Path:
        """Writes the model, as `write_model` does."""
        return write_model(folder, parameters=self.parameters, settings=self.settings, **self.tables)


def read_model(folder) -> Model:
    """A model folder as data frames.

    Returns
    -------
    Model
        Each table has its units in `attrs["units"]`.

    Raises
    ------
    InputError
        If the folder or `model.toml` is missing, or a file cannot be read.

    Examples
    --------
    >>> model = read_model("data/my_bridge/model")              # doctest: +SKIP
    >>> model["masses"]["mass_kg"] *= 1.1                       # doctest: +SKIP
    >>> model.write("heavier")                                  # doctest: +SKIP
    """
    path = Path(folder)
    if not (path / "model.toml").is_file():
        raise InputError(f"{path / 'model.toml'}: missing; give a model folder")
    try:
        settings = tomllib.loads((path / "model.toml").read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
        raise InputError(f"{path / 'model.toml'}: not valid TOML: {problem}") from problem
    parameters = pd.DataFrame(settings.pop("parameter", []))
    tables = {name: read_table(path / f"{name}.csv") for name in (*MODEL, "dofs") if (path / f"{name}.csv").is_file()}
    return Model(tables, with_units(parameters, file=(path / "model.toml").as_posix()), settings)


def write_model(folder, parameters=None, title: str = "", settings=None, **tables) -> Path:
    """Writes a model folder from data frames, once all of them were checked.

    Parameters
    ----------
    folder : path
        The folder to write. Tables of an earlier model in it that this one does not have are removed; other files stay.
    parameters : pandas.DataFrame, optional
        `name target of initial lower upper` and, if you like, `unit`. `of` is a name or a list of names: materials, sections, or groups of
        springs or masses. Values in SI units.
    title : str, optional
    settings : dict, optional
        Further keys of `model.toml`, for example `{"gravity": 9.81, "prestress": {"displacements": "large"}}`.
    **tables : pandas.DataFrame
        `nodes`, `elements`, `materials` and `sections`; if wanted `supports`, `springs`, `links`, `masses`, `points`, `loads`. Columns as
        docs/my_model.md and `make reference` list them, in SI units.

    Returns
    -------
    pathlib.Path
        The folder, ready for `run_step(..., model=folder)`.

    Raises
    ------
    InputError
        For a missing or unknown table or column, a cell that is no number, a doubled name, a node, material or section that is not there.
        Nothing is written then.

    Examples
    --------
    >>> nodes = pd.DataFrame({"node": [1, 2], "x_m": [0.0, 4.0], "y_m": 0.0, "z_m": 0.0})
    >>> elements = pd.DataFrame({"element": [1], "type": "bar", "material": "steel", "section": "rod", "node1": 1, "node2": 3})
    >>> steel = pd.DataFrame({"material": ["steel"], "youngs_modulus_Pa": 210e9, "density_kg_m3": 7850.0})
    >>> rod = pd.DataFrame({"section": ["rod"], "area_m2": 1e-3})
    >>> write_model("rod", nodes=nodes, elements=elements, materials=steel, sections=rod)
    Traceback (most recent call last):
        ...
    twindeck.errors.InputError: elements, row 0, column node2: '3' is not in nodes
    """
    path, settings = Path(folder), dict(settings or {})
    given = {name: frame for name, frame in tables.items() if frame is not None}
    for name in given:
        if name not in MODEL:
            raise InputError(f"model: unknown table '{name}'; expected one of {', '.join(MODEL)}")
    for key in _ELSEWHERE:
        if key in settings:
            raise InputError(f"model.toml: [{key}] names files of matrices, which are not data frames; copy that folder and change its files")
    for name in NEEDED:
        if name not in given:
            raise InputError(f"model: no table '{name}'; a model needs {', '.join(NEEDED)}")
    checked = {name: check_table(name, frame, MODEL[name]) for name, frame in given.items()}
    check_references(checked)
    if title:
        settings["title"] = title
    settings["parameter"] = _parameters(parameters)
    files = {f"{name}.csv": csv_text(frame) for name, frame in checked.items()}
    files["model.toml"] = toml_text({"title": "model", **settings})
    write_files(path, files, stale=[f"{name}.csv" for name in MODEL if name not in checked])
    return path


def _parameters(frame) -> list:
    """The entries of [[parameter]]."""
    if frame is None or len(frame) == 0:
        return []
    known = frame.copy()
    lists = [[name] if isinstance(name, str) else list(name) for name in known["of"]] if "of" in known.columns else []
    if lists:
        known["of"] = [", ".join(names) for names in lists]
    checked = check_table("parameters", known, PARAMETERS)
    entries = checked.to_dict("records")
    for entry, names, label in zip(entries, lists, checked.index):
        if not entry["lower"] <= entry["initial"] <= entry["upper"]:
            raise InputError(f"parameters, row {label}: lower, initial, upper are {entry['lower']}, {entry['initial']}, {entry['upper']}, "
                             "expected lower <= initial <= upper")
        entry["of"] = names
        for key in ("unit", "nominal"):
            if is_empty(entry.get(key)):
                entry.pop(key, None)
    return entries
