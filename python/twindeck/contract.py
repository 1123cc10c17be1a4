"""The columns of model and features folders, and what is checked of a table before it is written. The steps check more when they read it."""
import difflib
import math

import pandas as pd

from .errors import InputError


class Columns:
    """What a file's columns may be. `numbers` is decided by the names: those in `texts` hold text, all others numbers."""

    def __init__(self, required: str, optional: str = "", texts: str = "", key: str = "", may_be_empty: str = ""):
        self.required, self.optional = required.split(), optional.split()
        self.texts, self.key, self.may_be_empty = set(texts.split()), key, set(may_be_empty.split())


MODEL = {
    "nodes": Columns("node x_m y_m z_m", key="node"),
    "elements": Columns("element type material section node1 node2",
                        "name group " + " ".join(f"node{i}" for i in range(3, 21)) + " section2 orientation_x orientation_y orientation_z offset1_x_m offset1_y_m "
                        "offset1_z_m offset2_x_m offset2_y_m offset2_z_m releases pull_N free_strain",
                        texts="type material section name group section2", key="element", may_be_empty="section"),
    "materials": Columns("material youngs_modulus_Pa density_kg_m3", "shear_modulus_Pa poisson_ratio", texts="material", key="material"),
    "sections": Columns("section", "area_m2 inertia_y_m4 inertia_z_m4 inertia_yz_m4 torsion_m4 shear_area_y_m2 shear_area_z_m2 thickness_m "
                        "bending_inertia_ratio shear_thickness_ratio", texts="section", key="section"),
    "supports": Columns("node x y z rx ry rz", "support", texts="support"),
    "springs": Columns("spring node direction_x direction_y direction_z stiffness_N_m",
                       "group node2 quantity damping_N_s_m friction_N arrangement active", texts="spring group quantity arrangement", key="spring"),
    "links": Columns("master slave", "link", texts="link"),
    "masses": Columns("node mass_kg", "group inertia_x_kg_m2 inertia_y_kg_m2 inertia_z_kg_m2", texts="group"),
    "points": Columns("point node", texts="point", key="point"),
    "loads": Columns("load node direction value unit", texts="load direction unit"),
}
NEEDED = ("nodes", "elements", "materials", "sections")
PARAMETERS = Columns("name target of initial lower upper", "unit nominal", texts="name target of unit", key="name")

# column of a model's table -> the table and column where its value must stand
REFERS = {**{f"node{i}": ("nodes", "node") for i in ("", *range(1, 9))}, "master": ("nodes", "node"), "slave": ("nodes", "node"),
          "material": ("materials", "material"), "section": ("sections", "section"), "section2": ("sections", "section")}

ROWS = Columns("type mode channel condition value std", "held_out", texts="type mode channel condition", may_be_empty="mode channel std")
CHANNELS = Columns("channel", "point x_m y_m z_m dx dy dz quantity unit gain reference role element xi support",
                   texts="channel point quantity unit role support", key="channel")
ROW_TYPES = ("frequency_Hz", "damping_ratio_pct", "shape", "shape_imag", "stay_frequency_Hz", "rms_m_s2", "psd_floor_m2_s3", "static_m",
             "static_rotation_rad", "static_strain", "static_force_N")
CONDITION_KEYS = ("dampers", "amplitude_m", "amplitude_channel", "temperature_C", "wind_m_s", "direction_deg", "people", "load", "state")


def nearest(name: str, known) -> str:
    """'; did you mean …?' for a name that is close to a known one, else ''."""
    close = difflib.get_close_matches(str(name), [str(k) for k in known], 1)
    return f"; did you mean '{close[0]}'?" if close else ""


def check_table(name: str, frame, columns: Columns) -> pd.DataFrame:
    """A copy of a table whose columns, numbers and key are as the contract says.

    Raises
    ------
    InputError
        It names the table, the row (its label in the frame's index) and the column.
    """
    if not isinstance(frame, pd.DataFrame):
        raise InputError(f"{name}: is a {type(frame).__name__}, expected a pandas DataFrame")
    known = [*columns.required, *columns.optional]
    twice = [c for c in frame.columns if list(frame.columns).count(c) > 1]
    if twice:
        raise InputError(f"{name}: column '{twice[0]}' stands twice; keep one")
    for column in columns.required:
        if column not in frame.columns:
            others = [c for c in frame.columns if c not in known]
            raise InputError(f"{name}: no column '{column}'{_like(column, others)}; it needs {', '.join(columns.required)}")
    for column in frame.columns:
        if column not in known:
            raise InputError(f"{name}: unknown column '{column}'{nearest(column, known)}; known are {', '.join(known)}")
    for column in frame.columns:
        needed = column in columns.required and column not in columns.may_be_empty
        for label, value in frame[column].items():
            _check_cell(f"{name}, row {label}, column {column}", value, needed, column not in columns.texts)
    if columns.key:
        doubled = frame[columns.key][frame[columns.key].duplicated()]
        if len(doubled):
            raise InputError(f"{name}, row {doubled.index[0]}: {columns.key} {doubled.iloc[0]!r} stands twice; give each a name or number of its own")
    return frame.copy()


def is_empty(value) -> bool:
    return value is None or value == "" or (isinstance(value, float) and math.isnan(value)) or value is pd.NA


def _like(column: str, others: list) -> str:
    without_unit = [c for c in others if column.startswith(f"{c}_")]
    if without_unit:
        return f", but '{without_unit[0]}', which lacks the unit in its name"
    close = difflib.get_close_matches(column, [str(c) for c in others], 1)
    return f", but '{close[0]}', which may be it" if close else ""


def _check_cell(where: str, value, needed: bool, number: bool) -> None:
    if is_empty(value):
        if needed:
            raise InputError(f"{where}: is empty; expected a {'number' if number else 'name'}")
        return
    if not number:
        return
    try:
        finite = math.isfinite(float(value))
    except (TypeError, ValueError):
        raise InputError(f"{where}: is {value!r}, expected a number in the unit of the column's name") from None
    if not finite:
        raise InputError(f"{where}: is {value!r}, expected a finite number")


def check_references(tables: dict) -> None:
    """Nodes, materials and sections that are named must be in their tables.

    Raises
    ------
    InputError
        It names the table, the row, the column and the nearest known name.
    """
    known = {(table, column): {_text(v) for v in tables[table][column]} for table, column in set(REFERS.values())}
    for name, frame in tables.items():
        for column in frame.columns:
            target = REFERS.get(column)
            if target is None or target == (name, column):
                continue
            for label, value in frame[column].items():
                if not is_empty(value) and _text(value) not in known[target]:
                    raise InputError(f"{name}, row {label}, column {column}: {_text(value)!r} is not in {target[0]}"
                                     f"{nearest(_text(value), known[target])}")


def _text(value) -> str:
    """A node's number as text: 3 and 3.0 are the same node."""
    return str(int(value)) if isinstance(value, float) and value.is_integer() else str(value)
