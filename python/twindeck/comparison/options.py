"""What two runs of a step were asked to do: configuration, seeds, versions, inputs by their hashes, and how they ended."""
import re
import tomllib
from pathlib import PurePosixPath

from ..results import StepResults
from .rows import text_row

# Options of the command line that say where things lie or how they run, or stand in the configuration anyway
_NO_OPTION = ("--out", "--results", "--threads", "--set", "--seed", "--study")
shown_digits = 12  # of a hash: enough to tell files apart, short enough for a line


def option_rows(a: StepResults, b: StepResults) -> list:
    """Rows of what differs or agrees between the manifests of one step in two runs."""
    step = a.step
    rows = _both("options", step, "configuration", _configuration(a), _configuration(b))
    rows += _both("options", step, "command line", _command_line(a), _command_line(b))
    rows += _both("options", step, "program", _program(a), _program(b))
    rows += _both("inputs", step, "file", *matched(_inputs(a), _inputs(b)))
    rows.append(text_row("outcome", step, "step", "status", a.manifest.get("status"), b.manifest.get("status")))
    both = dict.fromkeys([*a.warnings, *b.warnings])
    rows += [text_row("outcome", step, "warning", "", w if w in a.warnings else None, w if w in b.warnings else None) for w in both]
    return rows


def _both(part, step, item, a: dict, b: dict) -> list:
    return [text_row(part, step, item, key, a.get(key), b.get(key)) for key in dict.fromkeys([*a, *b])]


def _configuration(result: StepResults) -> dict:
    """The resolved configuration as {dotted key: text}, with the unit that the manifest states."""
    text = result.manifest.get("config_toml", "")
    units = dict(re.findall(r"^(\S+) = .*  # (\S+)$", text, re.M))
    flat = _flat(tomllib.loads(text), "")
    return {key: f"{value} {units[key]}" if key in units else value for key, value in flat.items()}


def _flat(value, name: str) -> dict:
    if isinstance(value, dict):
        return {k: v for key, part in value.items() for k, v in _flat(part, f"{name}.{key}" if name else key).items()}
    if isinstance(value, list) and value and all(isinstance(v, dict) for v in value):
        return {k: v for i, part in enumerate(value, 1) for k, v in _flat(part, f"{name}[{i}]").items()}
    return {name: _shown(value)}


def _shown(value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return "[" + ", ".join(map(_shown, value)) + "]"
    return f"{value:.12g}" if isinstance(value, float) else str(value)


def _program(result: StepResults) -> dict:
    manifest = result.manifest
    told = {key: str(manifest[key]) for key in ("seed", "version", "commit") if key in manifest}
    return told | {str(name): str(version) for name, version in manifest.get("libraries", {}).items()}


def _command_line(result: StepResults) -> dict:
    """Options that choose what is looked at: --condition, --state, folders given by hand."""
    words = [str(w) for w in result.manifest.get("command_line", [])][1:]
    found, place = {}, 0
    while place < len(words):
        option, _, value = words[place].partition("=")
        place += 1
        if not value and option.startswith("--") and place < len(words) and not words[place].startswith("--"):
            value = words[place]
            place += 1
        if option.startswith("--") and option not in (*_NO_OPTION, "--quiet"):
            found[option] = _in_run(value, _recorded_root(result)) or "given"
    return found


def _recorded_root(result: StepResults) -> "PurePosixPath | None":
    """The results folder as the step knew it: the one above its --out."""
    words = [str(w) for w in result.manifest.get("command_line", [])]
    for place, word in enumerate(words):
        if word.startswith("--out="):
            return PurePosixPath(word[len("--out="):]).parent
        if word == "--out" and place + 1 < len(words):
            return PurePosixPath(words[place + 1]).parent
    return None


def _in_run(name: str, root) -> str:
    """A path below the run's own folder begins with {results}, so that two runs' paths can be equal."""
    path = PurePosixPath(name)
    return f"{{results}}/{path.relative_to(root)}" if root is not None and root.parts and path.is_relative_to(root) else name


def _inputs(result: StepResults) -> dict:
    root = _recorded_root(result)
    return {_in_run(name, root): str(sha)[:shown_digits] for name, sha in result.manifest.get("inputs", {}).items()}


def matched(a: dict, b: dict) -> tuple:
    """Two lists of input files under common names.

    Files that lie in different folders are the same input if they are called alike: by their last two parts (`model/nodes.csv`), or else by
    the file's name alone, where that is unique on both sides.
    """
    a, b = dict(a), dict(b)
    for parts in (2, 1):
        left = {name: _tail(name, parts) for name in a if name not in b}
        right = {name: _tail(name, parts) for name in b if name not in a}
        for name, tail in left.items():
            others = [n for n, t in right.items() if t == tail]
            if len(others) == 1 and list(left.values()).count(tail) == 1:
                b[name] = b.pop(others[0])
    return a, b


def _tail(name: str, parts: int) -> tuple:
    return PurePosixPath(name).parts[-parts:]
