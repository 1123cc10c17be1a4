"""Where the sensors sat and along what they measured: from a table (CSV, tab, spreadsheet) or from the nodes of a universal file."""
import re
import zipfile
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from .errors import InputError
from .places import along, split_name

PLACE = re.compile(r"([xyz])(?:[ _]*[\[(]?(m|cm|mm)[\])]?)?")  # x, x_m, x [mm], y (cm)
LENGTHS_M = {"m": 1.0, "cm": 1e-2, "mm": 1e-3}
NAMES = {"channel": ("channel", "sensor", "name", "kanal", "id"), "direction": ("direction", "dir", "axis", "richtung"), "node": ("node", "knoten", "grid"), "setup": ("setup", "aufbau"), "dx": ("dx",), "dy": ("dy",), "dz": ("dz",),
         "point": ("point", "location"), "unit": ("unit", "einheit"), "gain": ("gain",), "reference": ("reference", "ref")}
PACKAGES = {".xlsx": "openpyxl", ".ods": "odf"}
NODE = re.compile(r"(\d+)([+-])([xyz])")  # node and direction, as step 3 names a point
FIELDS = ("point", "node", "x_m", "y_m", "z_m", "dx", "dy", "dz", "unit", "gain", "reference")


@dataclass(frozen=True)
class Sensors:
    file: Path
    rows: dict  # channel (as the table or file names it), or the point of several channels -> {field: text}
    of_setup: dict = field(default_factory=dict)  # setup -> the same, of sensors that were moved between setups

    def told(self, names: tuple, setup: str | None) -> dict:
        """The row of the first of `names` that the table has, or of the point that it names: A3 for A3_z."""
        for name in (*names, *(split_name(n)[0] for n in names)):
            for rows in (self.of_setup.get(setup, {}), self.rows):
                if name in rows:
                    return rows[name]
        return {}


def table_of_sensors(file: Path) -> Sensors | None:
    """None where the file is no such table: it needs a column of channels, and of places or directions."""
    try:
        if file.suffix.lower() in PACKAGES:
            frame = pd.read_excel(file, dtype=str)
        elif file.suffix.lower() in (".csv", ".txt", ".tsv"):
            frame = pd.read_csv(file, sep=None, engine="python", dtype=str, nrows=10000, encoding_errors="replace")
        else:
            return None
    except ImportError as problem:
        raise InputError(f"{file}: is a spreadsheet, and the Python package {PACKAGES[file.suffix.lower()]}, which reads it, is not installed; "
                         f"apt-get install python3-{PACKAGES[file.suffix.lower()]}, or save the table as CSV") from problem
    except (ValueError, OSError, KeyError, zipfile.BadZipFile, pd.errors.ParserError):
        return None  # step 3 says of it what is wrong
    columns = {_field(c): c for c in frame.columns if _field(c)}
    if "channel" not in columns or not {"x_m", "direction", "dx", "node"} & set(columns):
        return None
    found = Sensors(file, {})
    length_m = {f: LENGTHS_M[place[2] or "m"] for f, c in columns.items() if (place := PLACE.fullmatch(str(c).strip().lower()))}
    for number, row in enumerate(frame.fillna("").to_dict("records"), 2):
        cells = {f: str(row[c]).strip() for f, c in columns.items()}
        rows = found.of_setup.setdefault(cells["setup"], {}) if cells.get("setup") else found.rows
        if cells["channel"]:
            rows[cells["channel"]] = _sensor(cells, length_m, f"{file}: line {number}")
    return found


def _field(heading) -> str | None:
    plain = str(heading).strip().lower()
    if found := PLACE.fullmatch(plain):
        return f"{found[1]}_m"
    return next((name for name, names in NAMES.items() if plain in names), None)


def _sensor(row: dict, length_m: dict, where: str) -> dict:
    """Cells of a row by field. `length_m`: metres of a unit in the columns of places"""
    found = {f: row[f].replace(",", ".") if f[1:] == "_m" or f in ("dx", "dy", "dz", "gain") else row[f] for f in FIELDS if row.get(f)}
    for number in ("x_m", "y_m", "z_m", "dx", "dy", "dz", "gain"):
        if number in found:
            try:
                value = float(found[number])
                found[number] = found[number] if length_m.get(number, 1.0) == 1.0 else f"{value * length_m[number]:.12g}"
            except ValueError:
                raise InputError(f"{where}: {number} is '{found[number]}', expected a number: correct the cell, or leave it empty where it is not known") from None
    if row.get("direction"):
        cosines = along(row["direction"].lower())
        if cosines is None:
            raise InputError(f"{where}: direction is '{row['direction']}', expected x, y, z, -x, -y, -z, vertical, up or down; other directions as columns dx, dy, dz")
        found |= cosines
    return found


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
    if all(points := [NODE.fullmatch(c) for c in channels]):  # the points of frequency response functions, each in several functions
        functions = [(int(p[1]), ("xyz".index(p[3]) + 1) * (-1 if p[2] == "-" else 1)) for p in points]
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
