"""The modes that tell what the diagnosis says: measured, model before, model after, state by state. From step 9's rows where it ran, else from the
comparison of step 6 or 4, else from the identified modes alone."""
from dataclasses import dataclass, field

import numpy as np
import pandas as pd

from ..study import Study
from .heatmap import label
from .mac import mac
from .side_by_side import lines_of

MOST_BARS, MOST_ROWS, MOST_STATES = 4, 5, 3  # what the first screen has room for; all of them stand in the tables
ROOM = 1.25  # of the bars' range beyond the largest error, so that the longest bar does not touch the edge
NO_COUNTERPART = "no counterpart in the model"
LEAST_RANGE = 0.01  # [-] of the measured frequency: below it bars would make differences look large that nobody measures


@dataclass
class Told:
    """A measured mode in a state; NaN where something is not known, or where the model has no such mode."""
    mode: str
    state: str
    measured: float  # [Hz]
    before: float  # [Hz]
    after: float  # [Hz]
    mac_before: float = float("nan")
    mac_after: float = float("nan")
    weight: float = 0.0  # how much the mode says: the larger of the standardised residuals, or of the errors
    std: float = float("nan")  # [Hz] of the measured frequency
    held_out: bool = False  # neither model was fitted to the mode

    def error(self, side: str) -> float:
        """[%]"""
        return 100.0 * (getattr(self, side) / self.measured - 1.0)


@dataclass
class Telling:
    rows: list  # of Told
    before: str  # what `before` is
    after: str  # what `after` is, empty where there is no such model
    damping: tuple | None = None  # (before, after) mean of the absolute errors of the damping ratios [%]
    damping_held_out: bool = False  # those that no fit has seen; else the fitted ones
    shapes: dict = field(default_factory=dict)  # (mode, state) -> {channel: complex component}, as measured


def telling(study: Study, told: dict | None) -> tuple:
    """(Telling for the bars, Telling for the table of states)"""
    diagnosed = _of_rows(study, told) if told is not None else None
    compared = _of_comparison(study)
    if diagnosed is not None and (told["effects"] or compared is None):
        return diagnosed, diagnosed
    several = diagnosed is not None and len({r.state for r in diagnosed.rows}) > 1
    return compared or _of_modes(study), (diagnosed if several else compared) or _of_modes(study)


def _of_rows(study: Study, told: dict) -> Telling | None:
    """The rows that step 9 used; frequencies and MAC of held-out predictions in the place of fitted ones where step 9 tells them (gain.raw).
    Cells of a mode without counterpart in the model are empty."""
    table = study.step_csv("s9_diagnosis/residuals.csv", ["type", "mode", "channel", "condition", "held_out", "value", "std", "before", "after", "residual_before", "residual_after"])
    table = table.assign(mode=table["mode"].map(_mode), condition=table["condition"].fillna("").astype(str))
    shapes = _shapes(table)
    held = {(_mode(r["mode"]), str(r["condition"])): r for r in (told.get("gain") or {}).get("raw") or []}
    rows = []
    for r in table[table["type"] == "frequency_Hz"].to_dict("records"):
        key = (r["mode"], r["condition"])
        raw = held.get(key, {})
        macs = shapes.get(key, (np.nan, np.nan))
        at = [_predicted(r["value"], raw.get(f"frequency_error_pct_{side}"), r[side]) for side in ("before", "after")]
        found = [_or(raw.get(f"mac_{side}"), macs[i]) for i, side in enumerate(("before", "after"))]
        rows.append(Told(*key, r["value"], *at, *found, float(np.nanmax([0.0, abs(r["residual_before"]), abs(r["residual_after"])])), r["std"],
                         bool(raw) or r["held_out"] == 1))
    if not rows:
        return None
    after = ("model with the causes in it" if len(told["effects"]) > 1 else "model with the cause in it") if told["effects"] else ""
    before = "model fitted to all other modes" if held else "model fitted within its bounds"
    held_damping = [[r.get(f"damping_error_pct_{side}") for side in ("before", "after")] for r in held.values()]
    held_damping = np.abs([pair for pair in held_damping if None not in pair])
    if len(held_damping):
        return Telling(rows, before, after, tuple(map(float, held_damping.mean(axis=0))), True, _measured_shapes(table))
    return Telling(rows, before, after, _damping(table[table["type"] == "damping_ratio_pct"]), shapes=_measured_shapes(table))


def _damping(table: pd.DataFrame) -> tuple | None:
    table = table[table["before"].notna() & table["after"].notna()]
    return tuple(float(100.0 * (table[side] / table["value"] - 1.0).abs().mean()) for side in ("before", "after")) if len(table) else None


def _predicted(measured: float, error_pct, fitted: float) -> float:
    return fitted if error_pct is None else measured * (1.0 + error_pct / 100.0)


def _or(value, otherwise: float) -> float:
    return otherwise if value is None else value


def _mode(value) -> str:
    return "" if value is None or value != value else label(value)


def _shapes(table: pd.DataFrame) -> dict:
    """(mode, condition) -> MAC of the measured shape with the model's before and after."""
    found = {}
    real, imaginary = (table[table["type"] == kind] for kind in ("shape", "shape_imag"))
    parts = {key: part.set_index("channel")[["value", "before", "after"]] for key, part in imaginary.groupby(["mode", "condition"])}
    for key, part in real.groupby(["mode", "condition"]):
        values = part.drop_duplicates("channel").set_index("channel")[["value", "before", "after"]].astype(complex)
        if key in parts:
            values = values + 1j * parts[key].reindex(values.index).fillna(0.0)
        if len(values) > 1:  # one channel is like any other
            found[key] = tuple(mac(values["value"].to_numpy(), values[side].to_numpy()) if values[side].notna().any() else np.nan for side in ("before", "after"))
    return found


def _measured_shapes(table: pd.DataFrame) -> dict:
    """(mode, condition) -> {channel: complex component}"""
    found = {}
    for kind, unit in (("shape", 1.0), ("shape_imag", 1j)):
        for r in table[table["type"] == kind].to_dict("records"):
            shape = found.setdefault((r["mode"], r["condition"]), {})
            shape[r["channel"]] = shape.get(r["channel"], 0.0) + unit * r["value"]
    return found


def _of_comparison(study: Study) -> Telling | None:
    for token, stages, before, after in (("s6_updating", ("before", "after"), "model before updating", "model after updating"),
                                         ("s4_refinement", (None,), "model", "")):
        name = f"{token}/comparison.csv"
        if token not in study.steps() or not (study.results / name).is_file():
            continue
        table = study.step_csv(name, ["stage", "experimental_mode", "numerical_mode", "measured_Hz", "computed_Hz", "mac"])
        if table.empty:
            continue
        at = [table[table["stage"] == (stage or table["stage"].iloc[-1])].set_index("experimental_mode") for stage in stages]
        rows = []
        for mode in dict.fromkeys([*at[0].index, *at[-1].index]):
            first, last = (part.loc[mode] if mode in part.index else {"computed_Hz": np.nan, "mac": np.nan} for part in (at[0], at[-1]))
            measured = (first if "measured_Hz" in first else last)["measured_Hz"]
            row = Told(str(mode).removesuffix("X"), "", measured, first["computed_Hz"], last["computed_Hz"], first["mac"], last["mac"])
            row.weight = float(np.nanmax([0.0, abs(row.error("before")), abs(row.error("after"))]))
            rows.append(row)
        if rows:
            return Telling(rows, before, after)
    return None


def _of_modes(study: Study) -> Telling | None:
    for token in ("s3_identification", "s1_model"):
        if token in study.steps() and (study.results / token / "modes.csv").is_file():
            table = study.step_csv(f"{token}/modes.csv", ["mode", "frequency_Hz"])
            nan = float("nan")
            measured = token == "s3_identification"
            return Telling([Told(label(r["mode"]), "", *((r["frequency_Hz"], nan, nan) if measured else (nan, r["frequency_Hz"], nan)))
                            for r in table.to_dict("records")], "" if measured else "model", "")
    return None


def bars(told: Telling | None) -> dict | None:
    """{from_pct, modes: [{mode, state, bars: [{kind, share, Hz, words}]}], legend}: bars of the modes that say most, all from the same per cent of what was
    measured, so that equal differences look equal. A side without a frequency has no bar, but words."""
    if told is None:
        return None
    kinds = [("measured", "measured"), ("before", told.before), *([("after", told.after)] if told.after else [])]
    kinds = [(k, words) for k, words in kinds if words and (k != "measured" or any(r.measured == r.measured for r in told.rows))]
    chosen = sorted(sorted(told.rows, key=lambda r: -r.weight)[:MOST_BARS], key=lambda r: (_order(r.mode), r.state))
    errors = [abs(r.error(k)) / 100.0 for r in chosen for k, _ in kinds if k != "measured" and r.error(k) == r.error(k)]
    reach = min(1.0, max([LEAST_RANGE, *errors]) * ROOM) if errors else 1.0
    modes = []
    for row in chosen:
        base = row.measured if row.measured == row.measured else row.before
        least, most = base * (1.0 - reach), base * (1.0 + (reach if errors else 0.0))
        drawn = [{"kind": k, "share": round(100.0 * (value - least) / (most - least), 1), "Hz": _hertz(value), "words": ""} if (value := getattr(row, k)) == value else
                 {"kind": k, "share": 0.0, "Hz": "", "words": NO_COUNTERPART if k != "measured" else "not measured"} for k, _ in kinds]
        modes.append({"mode": row.mode, "state": row.state.replace("_", " "), "bars": drawn})
    return {"from_pct": round(100.0 * (1.0 - reach), 1), "modes": modes, "legend": kinds, "left_out": len(told.rows) - len(chosen)}


def table(told: Telling | None) -> dict | None:
    """{groups: [name], rows: [{mode, cells: [(Hz, %, MAC, mode's name in the state where it is another)]}], notes, left_out_modes, left_out_states}. Groups
    are the states, with the latest model's errors, and a row is one mode by its shape; of one state they are the model before and after."""
    if told is None:
        return None
    states = list(dict.fromkeys(r.state for r in told.rows))
    side = "after" if told.after else "before"
    if len(states) > 1:
        groups = [(s.replace("_", " "), s, "measured", side) for s in states[:MOST_STATES]]
    else:
        groups = [("measured", states[0], "measured", None)] if any(r.measured == r.measured for r in told.rows) else []
        groups += [(words, states[0], k, k) for k, words in (("before", told.before), ("after", told.after)) if words]
    lines = lines_of([r for r in told.rows if r.state in states[:MOST_STATES]], told.shapes)
    chosen = sorted(sorted(lines, key=lambda line: -line.weight)[:MOST_ROWS], key=lambda line: (_order(line.mode), line.label))
    rows = [{"mode": line.label, "cells": [_cells(line.at.get(state), shown, error, line.mode) for _, state, shown, error in groups]} for line in chosen]
    notes = "; ".join(note for line in chosen for note in line.notes)
    return {"groups": [g[0] for g in groups], "errors": [g[3] is not None for g in groups], "model": told.after or told.before, "several": len(states) > 1,
            "rows": rows, "notes": f"{notes[0].upper()}{notes[1:]}." if notes else "", "shapes": any(cell[2] for row in rows for cell in row["cells"]),
            "left_out_modes": len(lines) - len(chosen), "left_out_states": max(0, len(states) - MOST_STATES)}


def _cells(row: Told | None, shown: str, side: str | None, mode: str) -> tuple:
    if row is None:
        return ("", "", "", "")
    error, alike = (row.error(side), getattr(row, f"mac_{side}")) if side else (np.nan, np.nan)
    return (_hertz(getattr(row, shown)), "" if error != error else f"{round(error, 1) + 0.0:+.1f}", "" if alike != alike else f"{alike:.2f}", row.mode if row.mode != mode else "")


def _hertz(value: float) -> str:
    return "" if value != value else f"{value:#.4g}".rstrip(".")


def _order(mode: str) -> tuple:
    return (0, int(mode), "") if mode.isdigit() else (1, 0, mode)
