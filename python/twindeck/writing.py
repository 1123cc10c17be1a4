"""Folders written whole: every text is made before the first file is touched, and each file is replaced in one piece."""
import math
import os
from pathlib import Path

import pandas as pd

from .contract import is_empty
from .errors import InputError


def write_files(folder: Path, files: dict, stale=()) -> None:
    """Writes {name: text or bytes} into a folder and removes the files named in `stale`, which would else belong to the folder's new content.

    Each file is written beside its target and then put in its place, so that a reader sees the earlier or the new file, never a part.
    """
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is a file, expected a folder to write to")
    folder.mkdir(parents=True, exist_ok=True)
    made = {name: folder / f".{name}.part" for name in files}
    try:
        for name, content in files.items():
            made[name].write_bytes(content if isinstance(content, bytes) else content.encode("utf-8"))
        for name, part in made.items():
            os.replace(part, folder / name)
    finally:
        for part in made.values():
            part.unlink(missing_ok=True)
    for name in stale:
        (folder / name).unlink(missing_ok=True)


def csv_text(frame: pd.DataFrame) -> str:
    """A table as twindeck's files are: comma, header row, 12 significant digits, empty cells for missing values."""
    return pd.DataFrame({column: [_cell(value) for value in frame[column]] for column in frame.columns}, dtype=str).to_csv(index=False, lineterminator="\n")


def _cell(value) -> str:
    if is_empty(value):
        return ""
    if hasattr(value, "item"):  # a NumPy number
        value = value.item()
    if isinstance(value, bool):
        return str(int(value))
    if isinstance(value, float):
        return f"{value:.12g}"
    return str(value)


def toml_text(table: dict, path: str = "") -> str:
    """A dictionary as TOML: plain values first, then tables, then arrays of tables; keys without a value (None) are left out."""
    plain = {k: v for k, v in table.items() if v is not None and not isinstance(v, dict) and not _is_table_list(v)}
    text = "".join(f"{_key(k)} = {_value(v)}\n" for k, v in plain.items())
    for key, value in table.items():
        name = f"{path}.{_key(key)}" if path else _key(key)
        if isinstance(value, dict):
            text += f"\n[{name}]\n{toml_text(value, name)}"
        elif _is_table_list(value):
            text += "".join(f"\n[[{name}]]\n{toml_text(entry, name)}" for entry in value)
    return text


def _is_table_list(value) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, dict) for v in value)


def _key(key: str) -> str:
    bare = key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return key if bare else _string(key)


def _string(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n").replace("\t", "\\t")
    return f'"{escaped}"'


def toml_value(value) -> str:
    """One value as TOML writes it: true, 0.5, "text", ["a", "b"].

    >>> toml_value(["k_base", "m_floor"])
    '["k_base", "m_floor"]'
    """
    return _value(value)


def _value(value) -> str:
    if hasattr(value, "item"):  # a NumPy number
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if not math.isfinite(value):
            raise InputError(f"{value} has no place in a TOML file; give a finite number")
        return repr(value)
    if isinstance(value, str):
        return _string(value)
    raise InputError(f"a {type(value).__name__} has no place in a TOML file; give text, numbers, true or false, or lists of these")
