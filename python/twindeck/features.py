"""Features folders as data frames: measured quantities with their standard deviations, where the sensors sat, what the conditions were."""
import io
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np  # pandas brings it
import pandas as pd

from .contract import CHANNELS, CONDITION_KEYS, ROW_TYPES, ROWS, check_table, is_empty, nearest
from .errors import InputError
from .tables import read_table
from .writing import csv_text, toml_text, write_files


@dataclass
class Features:
    """A features folder in memory.

    Attributes
    ----------
    rows : pandas.DataFrame
        `type,mode,channel,condition,value,std`; the unit of a row's value is in the name of its type.
    channels : pandas.DataFrame or None
    conditions : dict of dict
        A table a condition, as in `conditions.toml`.
    quality : pandas.DataFrame or None
        `quality.csv` of step 3.
    covariance : numpy.ndarray or None
        rows x rows, in the order and units of `rows`.
    """

    rows: pd.DataFrame
    channels: "pd.DataFrame | None" = None
    conditions: dict = field(default_factory=dict)
    quality: "pd.DataFrame | None" = None
    covariance: "np.ndarray | None" = None

    def write(self, folder) -> Path:
        """Writes the features, as `write_features` does (without `quality`, which only a record can tell)."""
        return write_features(folder, self.rows, channels=self.channels, conditions=self.conditions, covariance=self.covariance)


def read_features(folder) -> Features:
    """A features folder as data frames.

    >>> features = read_features("results/my_bridge/s3_identification/features")     # doctest: +SKIP
    >>> features.rows[features.rows["type"] == "frequency_Hz"]                        # doctest: +SKIP

    Raises
    ------
    InputError
        If the folder has no `rows.csv`, or a file cannot be read.
    """
    path = Path(folder)
    rows = read_table(path / "rows.csv")
    optional = {name: read_table(path / f"{name}.csv") for name in ("channels", "quality") if (path / f"{name}.csv").is_file()}
    conditions = {}
    if (path / "conditions.toml").is_file():
        try:
            conditions = tomllib.loads((path / "conditions.toml").read_text(encoding="utf-8"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
            raise InputError(f"{path / 'conditions.toml'}: not valid TOML: {problem}") from problem
    covariance = np.load(path / "covariance.npy") if (path / "covariance.npy").is_file() else None
    return Features(rows, optional.get("channels"), conditions, optional.get("quality"), covariance)


def write_features(folder, rows: pd.DataFrame, channels=None, conditions=None, covariance=None) -> Path:
    """Writes a features folder from data frames, once all of them were checked.

    Parameters
    ----------
    folder : path
        The folder to write. An earlier `quality.csv` or `covariance.npy` in it, which belonged to other rows, is removed.
    rows : pandas.DataFrame
        One row a measured number: `type` (`frequency_Hz`, `damping_ratio_pct`, `shape`, …), `mode`, `channel`, `condition`, `value`, `std`,
        and if wanted `held_out`. A missing column `channel` means none, a missing `condition` means `as_tested`.
    channels : pandas.DataFrame, optional
        `channel` and, if known, `point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role`. Needed for shapes.
    conditions : dict of dict, optional
        `{"winter": {"temperature_C": -4.0}}`; a condition of `rows` that is not named gets an empty table.
    covariance : array (rows x rows), optional
        Replaces `std`, which may then be empty.

    Returns
    -------
    pathlib.Path
        The folder, ready for `run_step(..., features=folder)`.

    Raises
    ------
    InputError
        For a missing or unknown column, an unknown type, a row without a standard deviation, a channel that `channels` does not have, a
        quantity that stands twice. Nothing is written then.

    Examples
    --------
    >>> rows = pd.DataFrame({"type": "frequency_Hz", "mode": [1, 2], "value": [2.216, 7.598], "std": [0.002, None]})
    >>> write_features("measured", rows)
    Traceback (most recent call last):
        ...
    twindeck.errors.InputError: rows, row 1, column std: is empty; state the standard deviation, a row without one cannot be weighed
    """
    path = Path(folder)
    table = rows.copy() if isinstance(rows, pd.DataFrame) else rows
    if isinstance(table, pd.DataFrame):
        for column, default in (("channel", ""), ("condition", "as_tested")):
            if column not in table.columns:
                table[column] = default
        if covariance is not None and "std" not in table.columns:
            table["std"] = np.nan
    table = check_table("rows", table, ROWS)
    table = table[[*ROWS.required, *(c for c in table.columns if c not in ROWS.required)]]
    sensors = check_table("channels", channels if channels is not None else pd.DataFrame({"channel": []}), CHANNELS)
    told = _conditions(conditions or {}, table)
    files = {"channels.csv": csv_text(sensors), "conditions.toml": toml_text(told)}
    if covariance is not None:
        files["covariance.npy"] = _covariance(covariance, len(table))
    _check_rows(table, set(map(str, sensors["channel"])), covariance is not None)
    files["rows.csv"] = csv_text(table)
    write_files(path, files, stale=[name for name in ("quality.csv", "covariance.npy") if name not in files])
    return path


def _conditions(given: dict, rows: pd.DataFrame) -> dict:
    for name, table in given.items():
        if not isinstance(table, dict):
            raise InputError(f"conditions: '{name}' is a {type(table).__name__}, expected a dictionary such as {{'temperature_C': 12.0}}")
        for key in table:
            if key not in CONDITION_KEYS:
                raise InputError(f"conditions: '{name}' has an unknown key '{key}'{nearest(key, CONDITION_KEYS)}; known are {', '.join(CONDITION_KEYS)}")
    return {**{str(name): {} for name in rows["condition"]}, **given}


def _covariance(given, rows: int) -> bytes:
    matrix = np.asarray(given, dtype=float)
    if matrix.shape != (rows, rows):
        raise InputError(f"covariance: is {' x '.join(map(str, matrix.shape))}, expected {rows} x {rows}, a row and a column for each row of rows")
    stream = io.BytesIO()
    np.save(stream, matrix)
    return stream.getvalue()


def _check_rows(rows: pd.DataFrame, channels: set, has_covariance: bool) -> None:
    seen = {}
    for label, row in rows.iterrows():
        where = f"rows, row {label}"
        if row["type"] not in ROW_TYPES:
            raise InputError(f"{where}, column type: '{row['type']}' is no type of row{nearest(row['type'], ROW_TYPES)}; known are {', '.join(ROW_TYPES)}")
        if not has_covariance and is_empty(row["std"]):
            raise InputError(f"{where}, column std: is empty; state the standard deviation, a row without one cannot be weighed")
        if not has_covariance and float(row["std"]) <= 0:
            raise InputError(f"{where}, column std: is {row['std']}, expected a value above 0")
        channel = "" if is_empty(row["channel"]) else str(row["channel"])
        if row["type"] in ("shape", "shape_imag") and channel not in channels:
            raise InputError(f"{where}, column channel: '{channel}' is not in channels{nearest(channel, channels)}")
        quantity = (row["type"], str(row["mode"]), channel, row["condition"])
        if quantity in seen:
            raise InputError(f"{where}: {row['type']} of mode {row['mode']} {channel} stands twice (row {seen[quantity]} too); remove one".replace("  ", " "))
        seen[quantity] = label
