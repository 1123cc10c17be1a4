"""Finished steps: their tables, their manifest, and what else they wrote."""
import hashlib
import json
import tomllib
from pathlib import Path

import pandas as pd

from .errors import InputError
from .features import Features, read_features
from .model import Model, read_model
from .tables import read_table

# Tables with a column a parameter, named by the parameter. Its values there are divided by the size of the initial value and have no unit, whatever
# the name ends with (k_m).
_BY_PARAMETER = ("history.csv", "starts.csv")


class StepResults:
    """What a finished step wrote. `result["modes"]` is the data frame of `modes.csv`.

    Every file is held against the hash in the step's manifest when it is read, so that a table that was changed afterwards is refused.

    Attributes
    ----------
    folder : pathlib.Path
    step : str
        Name of the step, for example `s6_updating`.
    manifest : dict
        `manifest.json`: inputs and outputs with SHA-256, configuration, seed, versions, status, warnings.
    log : str
        What the step printed, if `run_step` ran it.

    Examples
    --------
    >>> updated = read_step("results/my_bridge/s6_updating")     # doctest: +SKIP
    >>> updated.tables                                           # doctest: +SKIP
    ['comparison', 'costs', 'history', 'mac', 'modes', 'parameters', 'shapes', 'smooth_bounds', 'starts', 'summary']
    >>> updated["parameters"][["parameter", "final_value"]]      # doctest: +SKIP
    >>> updated.config["starts"]                                 # doctest: +SKIP
    8
    """

    def __init__(self, folder, log: str = ""):
        self.folder, self.log = Path(folder), log
        self.manifest = _manifest(self.folder)
        self.step = str(self.manifest["step"])

    def __repr__(self) -> str:
        return f"<{self.step} in {self.folder}: {', '.join(self.tables)}>"

    def __getitem__(self, name: str) -> pd.DataFrame:
        return self.table(name)

    def __contains__(self, name: str) -> bool:
        return f"{name}.csv" in self.manifest["outputs"]

    @property
    def tables(self) -> list:
        """Names of the step's own tables; those in its subfolders are read by `model`, `features` or `table("folder/name")`."""
        return sorted(name[:-4] for name in self.manifest["outputs"] if name.endswith(".csv") and "/" not in name)

    @property
    def warnings(self) -> list:
        return list(self.manifest.get("warnings", []))

    @property
    def config(self) -> dict:
        """The configuration that the step ran with, as nested dictionaries."""
        return tomllib.loads(self.manifest.get("config_toml", ""))

    @property
    def model(self) -> Model:
        """The model folder that the step wrote (`model/`, of step 9 `extended_model/`)."""
        return read_model(self._folder_of("model.toml"))

    @property
    def features(self) -> Features:
        """The features folder that step 3 wrote."""
        return read_features(self._folder_of("rows.csv"))

    @property
    def diagnosis(self) -> dict:
        """`diagnosis.json` of step 9."""
        return json.loads(self.path("diagnosis.json").read_text(encoding="utf-8"))

    def table(self, name: str) -> pd.DataFrame:
        """A table by its name, with or without `.csv`: `table("modes")`, `table("features/quality")`.

        Raises
        ------
        InputError
            If the step wrote no such table, or the file was changed since.
        """
        file = name if name.endswith(".csv") else f"{name}.csv"
        if file not in self.manifest["outputs"]:
            raise InputError(f"{self.folder}: {self.step} wrote no table '{name}'; it has {', '.join(self.tables)}")
        frame = read_table(self.path(file))
        frame.attrs["step"] = self.step
        if file in _BY_PARAMETER and "parameters" in self:
            for parameter in read_table(self.path("parameters.csv"))["parameter"]:
                frame.attrs["units"].pop(str(parameter), None)
        return frame

    def path(self, file: str) -> Path:
        """The path of a file that the step wrote, once its content was found to be what the manifest says."""
        recorded, path = self.manifest["outputs"].get(file), self.folder / file
        if recorded is None:
            raise InputError(f"{self.folder}: {self.step} wrote no {file}")
        if not path.is_file():
            raise InputError(f"{path}: missing, but manifest.json names it; run {self.step} again")
        if hashlib.sha256(path.read_bytes()).hexdigest() != recorded:
            raise InputError(f"{path}: changed since {self.step} wrote it; run the step again")
        return path

    def _folder_of(self, file: str) -> Path:
        found = [name for name in self.manifest["outputs"] if name.endswith(f"/{file}")]
        if not found:
            raise InputError(f"{self.folder}: {self.step} wrote no folder with {file}")
        return self.path(found[0]).parent


class Run:
    """A results folder: `run["s6_updating"]` is that step. `run.steps` lists the finished ones, `run.unfinished` the others."""

    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise InputError(f"{self.folder}: no such folder; give a results folder such as results/my_bridge, or the folder of one step")
        if (self.folder / "manifest.json").is_file():
            one = StepResults(self.folder)
            self._steps, self.unfinished = {one.step: one}, []
            return
        folders = sorted(p for p in self.folder.glob("s[0-9]*_*") if p.is_dir() and "." not in p.name)  # not s6_updating.unconverged
        self._steps = {p.name: StepResults(p) for p in folders if (p / "manifest.json").is_file()}
        self.unfinished = [p.name for p in folders if p.name not in self._steps]
        if not self._steps:
            raise InputError(f"{self.folder}: no manifest.json of a step in it or in its folders s1_model, …; give a folder that a step has finished")

    def __repr__(self) -> str:
        return f"<run in {self.folder}: {', '.join(self.steps)}>"

    def __getitem__(self, step: str) -> StepResults:
        found = [name for name in self._steps if step in (name, name.split("_")[0])]
        if not found:
            raise InputError(f"{self.folder}: no finished {step}; there are {', '.join(self._steps)}")
        return self._steps[found[0]]

    def __contains__(self, step: str) -> bool:
        return step in self._steps

    @property
    def steps(self) -> list:
        return list(self._steps)


def read_step(folder) -> StepResults:
    """The results of a finished step.

    >>> read_step("results/my_bridge/s1_model")["modes"]         # doctest: +SKIP

    Raises
    ------
    InputError
        If the folder is missing or has no readable manifest.
    """
    return StepResults(folder)


def read_run(folder) -> Run:
    """All finished steps of a results folder; the folder of one step is a run of that step.

    >>> run = read_run("results/my_bridge")                      # doctest: +SKIP
    >>> run["s6"]["parameters"]                                  # doctest: +SKIP
    """
    return Run(folder)


def _manifest(folder: Path) -> dict:
    path = folder / "manifest.json"
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; give the folder of a finished step")
    if not path.is_file():
        raise InputError(f"{path}: missing; the step has not finished, run it again")
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as problem:
        raise InputError(f"{path}: not valid JSON ({problem}); run the step again") from problem
    if not isinstance(manifest, dict) or not isinstance(manifest.get("step"), str) or not isinstance(manifest.get("outputs"), dict):
        raise InputError(f"{path}: not the manifest of a step: it names no step or no outputs; run the step again")
    return manifest
