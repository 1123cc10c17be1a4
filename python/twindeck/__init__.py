"""twindeck for people who work in notebooks: results, models and features as pandas data frames, and steps as functions.

It needs pandas and nothing else of Python's packages. It computes nothing itself: the steps are the executables of `build/bin`.

    >>> import twindeck                                                        # doctest: +SKIP
    >>> result = twindeck.run_step("s1_model", model="my_model", out="results/s1_model")   # doctest: +SKIP
    >>> result["modes"]                                                        # doctest: +SKIP

| function | gives |
|---|---|
| `read_table` | one CSV file as a data frame, its units in `frame.attrs["units"]` |
| `read_step`, `read_run` | all tables of a finished step, all steps of a results folder |
| `read_model`, `write_model` | a model folder as data frames, and back |
| `read_features`, `write_features` | a features folder as data frames, and back |
| `run_step` | runs a step and returns its results; its message as `StepError` where it fails |
| `openseespy.write_openseespy`, `openseespy.write_npz` | a live OpenSeesPy model, or matrices of an .npz file, as a matrix model |
| `compare` | what differs between two runs: options, modes, parameters, predictions, diagnosis |

docs/tutorial_python.md goes through all of them on a small structure.
"""
try:
    import pandas  # noqa: F401
except ModuleNotFoundError as missing:
    import sys

    raise ModuleNotFoundError(f"twindeck needs pandas, which {sys.executable} does not have; install it there, or take an interpreter that has it "
                              "(/usr/bin/python3 with Debian's python3-pandas)", name="pandas") from missing

from .comparison import Comparison, compare
from .errors import InputError, StepError
from .features import Features, read_features, write_features
from .model import Model, read_model, write_model
from .results import Run, StepResults, read_run, read_step
from .running import find_step, run_step
from .tables import read_table
from .units import unit_of_column

__all__ = ["Comparison", "Features", "InputError", "Model", "Run", "StepError", "StepResults", "compare", "find_step", "read_features", "read_model",
           "read_run", "read_step", "read_table", "run_step", "unit_of_column", "write_features", "write_model"]
