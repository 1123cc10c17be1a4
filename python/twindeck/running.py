"""Steps as functions: the executables of build/bin, with their results as data frames."""
import os
import shutil
import subprocess
from pathlib import Path

from .errors import InputError, StepError
from .results import StepResults, read_step
from .writing import toml_value

_REPOSITORY = Path(__file__).resolve().parents[2]
_INSTALLED = Path(__file__).resolve().parent / "../../../../bin"  # of <prefix>/lib/python3/dist-packages/twindeck
_FOLDERS = ("study", "model", "campaign", "modes", "features", "results", "correct")  # options that take a path


def find_step(step: str) -> Path:
    """The executable of a step, `s6_updating` or `s6` for short.

    It is looked for in the folder that the environment variable TWINDECK_BIN names, in `build/bin` of the repository that this package
    lies in, in `build/bin` of the current folder, in the prefix that the package was installed to, and on the PATH, in this order.

    Raises
    ------
    InputError
        If there is none; it lists where it was looked for.
    """
    folders = [Path(p) for p in (os.environ.get("TWINDECK_BIN"), _REPOSITORY / "build/bin", Path.cwd() / "build/bin", _INSTALLED) if p]
    for folder in folders:
        found = [p for p in (folder / step, *sorted(folder.glob(f"{step}_*"))) if p.is_file() and os.access(p, os.X_OK)]
        if found:
            return found[0]
    on_path = shutil.which(step)
    if on_path:
        return Path(on_path)
    raise InputError(f"{step}: no such executable in {', '.join(str(f) for f in folders)} or on the PATH; run `make build`, or name its folder in "
                     "TWINDECK_BIN")


def run_step(step: str, out, set=None, *, study=None, model=None, campaign=None, modes=None, features=None, results=None, correct=None,
             condition=None, state=None, seed=None, threads=None, accept_unconverged=False, options=()) -> StepResults:
    """Runs a step and returns its results.

    Parameters
    ----------
    step : str
        `s1_model` … `s9_diagnosis`, or `s1` … `s9` for short.
    out : path
        The folder to write. Earlier results of the step in it are replaced when the step has finished, and stay if it fails.
    set : dict, optional
        Keys of the step's configuration: `{"n_modes": 8, "parameters": ["k_base"]}`. `s6_updating --describe` tells which there are.
    study, model, campaign, modes, features, results : path, optional
        Folders that the step reads instead of its study's. `model` may be an `.inp` file.
    correct, condition, state
        Of steps 4, 6 and 9: a file of corrections, the condition and the state to look at.
    seed, threads : int, optional
    accept_unconverged : bool
        Publish results that did not converge, marked as such, instead of an error.
    options : sequence of str
        Further options, as on the command line: `["--export-matrices"]`.

    Returns
    -------
    StepResults
        Its tables by name; `result.warnings` lists what the step warned of, `result.log` what it printed.

    Raises
    ------
    InputError
        If there is no such executable.
    StepError
        If the step ends with another exit code than 0. Its text is the step's own message.

    Examples
    --------
    >>> result = run_step("s1_model", out="results/s1_model", model="my_model", set={"n_modes": 4})    # doctest: +SKIP
    >>> result["modes"]["frequency_Hz"]                                                               # doctest: +SKIP
    """
    paths = dict(zip(_FOLDERS, (study, model, campaign, modes, features, results, correct)))
    command = [str(find_step(step)), "--out", str(out)]
    for option, value in paths.items():
        if value is not None:
            command += [f"--{option}", str(value)]
    for option, value in (("condition", condition), ("state", state), ("seed", seed), ("threads", threads)):
        if value is not None:
            command += [f"--{option}", str(value)]
    command += ["--accept-unconverged"] if accept_unconverged else []
    for key, value in (set or {}).items():
        command += ["--set", f"{key}={value if isinstance(value, str) else toml_value(value)}"]
    done = subprocess.run([*command, *map(str, options)], capture_output=True, text=True)
    if done.returncode != 0:
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        message = lines[-1] if lines else f"{step} ended with exit code {done.returncode} and no message"
        raise StepError(message, done.returncode, command, done.stderr)
    finished = read_step(out)
    finished.log = done.stderr
    return finished
