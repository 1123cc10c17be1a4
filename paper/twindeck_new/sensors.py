"""Where the sensors sat and along what they measured: from a table (CSV, tab, spreadsheet) or from the nodes of a universal file."""
import re
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from .errors import InputError

NAMES = {"channel": ("channel", "sensor", "name", "kanal", "id"), "x_m": ("x_m", "x", "x [m]", "x (m)"), "y_m": ("y_m", "y", "y [m]", "y (m)"),
         "z_m": ("z_m", "z", "z [m]", "z (m)"), "direction": ("direction", "dir", "axis", "richtung"), "dx": ("dx",), "dy": ("dy",), "dz": ("dz",),
         "point": ("point", "node", "location"), "unit": ("unit", "einheit"), "gain": ("gain",), "reference": ("reference", "ref")}
DIRECTIONS = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "vertical": (0, 0, 1), "up": (0, 0, 1), "down": (0, 0, -1)}
FIELDS = ("point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "unit", "gain", "reference")


@dataclass(frozen=True)
class Sensors:
    file: Path
    rows: dict  # channel (as the table or file names it) -> {field: text}


def table_of_sensors(file: Path) -> Sensors | None:
    """None where the file is no such table: it needs a column of channels, and of places or directions."""
    try:
        if file.suffix.lower() in (".xlsx", ".ods"):
            frame = pd.read_excel(file, dtype=str)
        elif file.suffix.lower() in (".csv", ".txt", ".tsv"):
            frame = pd.read_csv(file, sep=None, engine="python", dtype=str, nrows=10000, encoding_errors="replace")
        else:
            return None
    except ImportError as problem:
        raise InputError(f"{file}: a spreadsheet needs {problem.name}: save the table as CSV") from problem
    except (ValueError, OSError, pd.errors.ParserError):
        return None
    columns = {_field(c): c for c in frame.columns if _field(c)}
    if "channel" not in columns or not {"x_m", "direction", "dx"} & set(columns):
        return None
    rows = {}
    for number, row in enumerate(frame.fillna("").to_dict("records"), 2):
        name = str(row[columns["channel"]]).strip()
        if name:
            rows[name] = _sensor({f: str(row[c]).strip() for f, c in columns.items()}, f"{file}: line {number}")
    return Sensors(file, rows)


def _field(heading) -> str | None:
    plain = str(heading).strip().lower()
    return next((field for field, names in NAMES.items() if plain in names), None)


def _sensor(row: dict, where: str) -> dict:
    found = {f: row[f].replace(",", ".") if f[1:] == "_m" or f in ("dx", "dy", "dz", "gain") else row[f] for f in FIELDS if row.get(f)}
    for field in ("x_m", "y_m", "z_m", "dx", "dy", "dz", "gain"):
        if field in found:
            try:
                float(found[field])
            except ValueError:
                raise InputError(f"{where}: {field} is '{found[field]}', expected a number: correct the cell, or leave it empty where it is not known") from None
    if row.get("direction"):
        found |= _along(row["direction"], where)
    return found


def _along(direction: str, where: str) -> dict:
    text = direction.strip().lower()
    sign = -1 if text.startswith("-") else 1
    axis = DIRECTIONS.get(text.lstrip("+-"))
    if axis is None:
        raise InputError(f"{where}: direction is '{direction}', expected x, y, z, -x, -y, -z, vertical, up or down; other directions as columns dx, dy, dz")
    return dict(zip(("dx", "dy", "dz"), (str(sign * a) for a in axis)))


def of_universal_file(file: Path, channels: tuple) -> Sensors | None:
    """Nodes (data sets 15 and 2411) and the response node and direction of each function (set 58). Coordinates as the file has them, in metres.
    `channels`: names in the order of the functions, as the step reads them."""
    text = file.read_text(encoding="latin-1").splitlines()
    nodes, functions = {}, []
    for kind, lines in _sets(text):
        if kind == "15":
            nodes |= {int(p[0]): p[4:7] for line in lines if len(p := line.split()) >= 7}
        elif kind == "2411":
            nodes |= {int(head.split()[0]): line.replace("D", "E").split()[:3] for head, line in zip(lines[::2], lines[1::2]) if head.split()}
        elif kind in ("58", "58b") and len(lines) > 5:
            found = re.match(r".{31}(.{10})(.{10})(.{4})", lines[5])
            functions.append((int(found[2]), int(found[3])) if found and found[2].strip() and found[3].strip() else None)
    if not nodes or len(functions) != len(channels):
        return None
    rows = {}
    for name, at in zip(channels, functions):
        if at is not None and at[0] in nodes:
            direction = [0, 0, 0]
            if 1 <= abs(at[1]) <= 3:
                direction[abs(at[1]) - 1] = 1 if at[1] > 0 else -1
            known = dict(zip(("dx", "dy", "dz"), map(str, direction))) if any(direction) else {}
            rows[name] = {"point": f"N{at[0]}", **dict(zip(("x_m", "y_m", "z_m"), nodes[at[0]])), **known}
    return Sensors(file, rows)


def _sets(lines: list):
    """(number of the data set, its lines) of each set between two lines of -1."""
    inside = None
    for line in lines:
        if line.strip() == "-1":
            if inside:
                yield inside[0].split()[0] if inside[0].split() else "", inside[1:]
            inside = None if inside is not None else []
        elif inside is not None:
            inside.append(line)
