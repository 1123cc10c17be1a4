"""Identified or measured shapes as vectors at the points of the sensors, and the model's mode that each is most like."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from ..study import Study
from .heatmap import label

FAR = 0.05  # a sensor further than this share of the model's length from every node is not on the model


@dataclass(frozen=True)
class MeasuredSet:
    points: list  # names
    positions: np.ndarray  # (p x 3) [m]
    lines: list  # pairs of positions in `points`, a drawing aid that a campaign may give
    modes: list  # (label, frequency [Hz], damping ratio [%] or None)
    shapes: np.ndarray  # (modes x p x 3) complex, largest component 1
    channels: pd.DataFrame  # channels.csv
    values: np.ndarray  # (modes x channels) complex; NaN where a channel has none


def read_measured(study: Study, settings: dict, step: str = "s3_identification") -> MeasuredSet | None:
    """From s3_identification (`step`: it, or the folder of one of its conditions), else from the folder of features that study.toml names, if it says where
    the sensors are."""
    identified = study.results / step
    if "s3_identification" in study.steps() and (identified / "shapes.csv").is_file() and (study.results / "s3_identification/channels.csv").is_file():
        channels = study.step_csv(f"{step}/channels.csv" if (identified / "channels.csv").is_file() else "s3_identification/channels.csv")
        shapes = study.step_csv(f"{step}/shapes.csv", ["mode", "direction", "value"])
        modes = study.step_csv(f"{step}/modes.csv", ["mode", "frequency_Hz"])
        imaginary = shapes["value_imag"] if "value_imag" in shapes else 0.0
        table = pd.DataFrame(
            {"mode": shapes["mode"], "channel": shapes["direction"].astype(str), "value": shapes["value"] + 1j * imaginary}
        )
        listed = [(str(r["mode"]), r["frequency_Hz"], r.get("damping_ratio_pct")) for r in modes.to_dict("records")]
        return _assembled(channels, table, listed, _wires(study))
    folder = Path(str(settings.get("features", "")))
    if not settings.get("features") or not (folder / "channels.csv").is_file():
        return None
    table, listed = _of_features(study.read_csv(folder / "rows.csv", ["type", "mode", "channel", "condition", "value"]))
    return _assembled(study.read_csv(folder / "channels.csv"), table, listed, [])


def _of_features(rows: pd.DataFrame) -> tuple:
    """Shapes and frequencies of rows.csv: of each mode those of the first condition that has both, since a mode that was measured in several
    conditions stands there once for each."""
    frequency, damping, real, imaginary = (
        rows[rows["type"] == kind] for kind in ("frequency_Hz", "damping_ratio_pct", "shape", "shape_imag")
    )
    place = ["mode", "condition"]
    chosen = frequency[[*place, "value"]].merge(real[place].drop_duplicates(), on=place).drop_duplicates("mode")
    chosen = chosen.merge(damping[[*place, "value"]], on=place, how="left", suffixes=("", "_damping"))
    table = real[[*place, "channel", "value"]].merge(chosen[place], on=place)
    table = table.merge(imaginary[[*place, "channel", "value"]], on=[*place, "channel"], how="left", suffixes=("", "_i"))
    table["value"] = table["value"] + 1j * table["value_i"].fillna(0.0)
    return table, [(label(r["mode"]), r["value"], r["value_damping"]) for r in chosen.to_dict("records")]


def _wires(study: Study) -> list:
    """lines.csv (point,other_point) of the campaign, if it has one: which points to join when nothing else is there to draw."""
    for folder in (study.results / "campaign", study.results / "s0_campaign"):
        if (folder / "lines.csv").is_file():
            return study.read_csv(folder / "lines.csv", ["point", "other_point"], text=True).to_numpy().tolist()
    return []


def _assembled(channels: pd.DataFrame, table: pd.DataFrame, listed: list, wires: list) -> MeasuredSet | None:
    needed = ["x_m", "y_m", "z_m", "dx", "dy", "dz"]
    if not set(needed) <= set(channels.columns) or channels[needed].isna().any(axis=None) or table.empty:
        return None
    channels = channels.assign(channel=channels["channel"].astype(str), point=channels["point"].astype(str))
    channels = (
        channels[channels["channel"].isin(set(table["channel"].astype(str)))].drop_duplicates("channel").reset_index(drop=True)
    )
    column = {name: i for i, name in enumerate(channels["channel"])}
    table = table.assign(mode=table["mode"].map(label), channel=table["channel"].astype(str))
    known = set(table["mode"])
    listed = [entry for entry in listed if entry[0] in known]
    row = {name: i for i, (name, *_) in enumerate(listed)}
    values = np.full((len(listed), len(column)), np.nan, complex)
    for mode, channel, value in zip(table["mode"], table["channel"], table["value"]):
        if mode in row and channel in column:
            values[row[mode], column[channel]] = value
    points = list(dict.fromkeys(channels["point"]))
    positions = channels.groupby("point", sort=False)[["x_m", "y_m", "z_m"]].first().loc[points].to_numpy(float)
    shapes = np.zeros((len(listed), len(points), 3), complex)
    for p, point in enumerate(points):
        rows = np.flatnonzero(channels["point"] == point)
        cosines = channels.loc[rows, ["dx", "dy", "dz"]].to_numpy(float)
        for m in range(len(listed)):
            there = np.isfinite(values[m, rows])
            if there.any():  # least squares: channels may be oblique, and a point may carry fewer than three
                shapes[m, p] = np.linalg.pinv(cosines[there], rcond=1e-6) @ values[m, rows[there]]
    largest = np.abs(shapes).max(axis=(1, 2), keepdims=True)
    place = {name: i for i, name in enumerate(points)}
    lines = [(place[a], place[b]) for a, b in wires if a in place and b in place]
    return MeasuredSet(points, positions, lines, listed, shapes / np.where(largest > 0, largest, 1.0), channels, values)


def partners(measured: MeasuredSet, points: np.ndarray, model_shapes: list) -> list:
    """For each measured mode (index of the model's mode of highest MAC at the sensors, MAC, factor that puts the model's shape onto
    the drawn measured one); an empty list when a sensor stands off the model. MAC = |a^H b|^2 / (a^H a b^H b)."""
    distance = np.linalg.norm(points[None] - measured.positions[:, None], axis=2)
    nearest = distance.argmin(axis=1)
    length = np.linalg.norm(points.max(axis=0) - points.min(axis=0))
    if not model_shapes or (distance.min(axis=1) > FAR * length).any():
        return []
    at = [nearest[measured.points.index(p)] for p in measured.channels["point"]]
    cosines = measured.channels[["dx", "dy", "dz"]].to_numpy(float)
    projected = np.array([(shape[at] * cosines).sum(axis=1) for shape in model_shapes])
    found = []
    for values, shape in zip(measured.values, measured.shapes):
        there = np.isfinite(values)
        a, b = values[there], projected[:, there]
        cross = b @ a
        energy = np.maximum((b**2).sum(axis=1), 1e-300)
        mac = np.abs(cross) ** 2 / energy / max((np.abs(a) ** 2).sum(), 1e-300)
        best = int(mac.argmax())
        drawn = (shape[[measured.points.index(p) for p in measured.channels["point"]]] * cosines).sum(axis=1)[there]
        found.append((best, float(mac[best]), float((b[best] @ drawn).real / energy[best])))
    return found
