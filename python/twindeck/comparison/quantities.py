"""Tables of the steps whose rows have names of their own: which columns are compared, and what a row is called."""
from dataclasses import dataclass
from statistics import NormalDist

import pandas as pd

from ..results import StepResults
from ..units import unit_of_column
from .rows import as_number, is_missing, larger, row_of


@dataclass(frozen=True)
class Compared:
    """Columns of a table that two runs are compared by; `key` names its rows."""

    part: str
    file: str  # without .csv
    key: tuple
    columns: tuple
    left_out: tuple = ()  # rows that tell how a search ran, not what it found


TABLES = {
    "s1_model": (Compared("model", "summary", ("quantity",), ("value",)), Compared("model", "stays", ("stay",), ("pull_N",))),
    "s2_sensors": (Compared("sensors", "setups", ("setup",), ("R_k", "rank")),),
    "s3_identification": (Compared("identified modes", "stays", ("stay", "condition", "harmonic"), ("frequency_Hz", "damping_ratio_pct")),),
    "s4_refinement": (Compared("pairs", "comparison", ("stage", "experimental_mode"),
                               ("numerical_mode", "measured_Hz", "computed_Hz", "error_pct", "mac")),),
    "s5_sensitivity": (Compared("selection", "selection", ("parameter",), ("score", "selected")),
                       Compared("selection", "identifiability", ("parameter",), ("resolution",))),
    "s6_updating": (Compared("parameters", "parameters", ("parameter",), ("initial_value", "final_value", "lower", "upper", "bound")),
                    Compared("pairs", "comparison", ("stage", "experimental_mode"),
                             ("numerical_mode", "measured_Hz", "computed_Hz", "error_pct", "mac")),
                    Compared("predictions", "leave_one_out", ("experimental_mode",), ("predicted_Hz", "error_predicted_pct")),
                    Compared("fit", "summary", ("quantity",), ("value",),
                             ("projected_gradient_relative", "smooth_bounds_cost", "smooth_bounds_largest_difference_of_range"))),
    "s7_aerodynamics": (Compared("predictions", "critical", ("set", "model", "dampers", "structural_damping_pct"), ("V_cr_m_s", "f_cr_Hz", "status")),),
    "s8_validation": (Compared("predictions", "rms", ("event", "run", "model", "channel", "direction"), ("rms_m_s2", "measured_rms_m_s2")),),
    "s9_diagnosis": (Compared("pairs", "pairs", ("mode", "condition"), ("measured_Hz", "after_Hz", "mac_after")),),
}
_LEVEL_OF_8 = 0.95  # [-] of the intervals in rms.csv, where the configuration does not say
# Names under which a table may give the standard deviation of one of its columns, beside frequency_std_Hz of frequency_Hz
_DEVIATIONS = {"final_value": ("final_value_std", "final_std", "std"), "measured_Hz": ("measured_std_Hz",)}


def table_rows(a: StepResults, b: StepResults) -> list:
    """Rows of every table that both runs of a step have."""
    rows = []
    for compared in TABLES.get(a.step, ()):
        if compared.file in a and compared.file in b:
            rows += _rows(compared, a, b)
    return rows


def _rows(compared: Compared, a: StepResults, b: StepResults) -> list:
    left, right = (_by_key(result[compared.file], compared.key) for result in (a, b))
    level = a.config.get("level", _LEVEL_OF_8)
    rows = []
    for name in dict.fromkeys([*left, *right]):
        if name in compared.left_out:
            continue
        one, other = left.get(name, {}), right.get(name, {})
        for column in compared.columns:
            if column not in one and column not in other:
                continue
            values = one.get(column), other.get(column)
            if all(map(is_missing, values)):
                continue
            unit = unit_of_column(column) or _unit_beside(one) or _unit_beside(other)
            std = larger(deviation(one, column, level), deviation(other, column, level))
            rows.append(row_of(compared.part, a.step, name, column, unit if not isinstance(values[0], str) else "", *values, std))
    return rows


def _by_key(frame: pd.DataFrame, key: tuple) -> dict:
    """{name of the row: its cells}; a name that stands twice is numbered."""
    found, key = {}, [k for k in key if k in frame.columns]
    for cells in frame.to_dict("records"):
        name = " ".join(_word(k, cells[k]) for k in key if not is_missing(cells[k]))
        at, number = name, 1
        while at in found:
            number += 1
            at = f"{name} ({number})"
        found[at] = cells
    return found


def _word(column: str, value) -> str:
    """A number is written alike whether its column holds integers alone (1) or others too (1.0), and with its unit."""
    number = as_number(value)
    return str(value) if number is None else f"{number:.12g} {unit_of_column(column)}".strip()


def _unit_beside(cells: dict) -> str:
    unit = cells.get("unit")
    return unit if isinstance(unit, str) and unit != "-" else ""


def deviation(cells: dict, column: str, level: float) -> "float | None":
    """The standard deviation of a cell: its own column, or half the interval over the normal quantile of its level."""
    stem, _, end = column.rpartition("_")
    for name in (*_DEVIATIONS.get(column, ()), f"{stem}_std_{end}", f"{column}_std"):
        if not is_missing(cells.get(name)):
            return float(cells[name])
    stem, end = (column[: -len("_m_s2")], "_m_s2") if column.endswith("_m_s2") else (stem, f"_{end}")
    low, high = cells.get(f"{stem}_low{end}"), cells.get(f"{stem}_high{end}")
    return None if is_missing(low) or is_missing(high) else half_width(float(low), float(high), level)


def half_width(low: float, high: float, level: float) -> float:
    """The standard deviation of a normal quantity whose central interval of probability `level` is [low, high]."""
    return (high - low) / 2.0 / NormalDist().inv_cdf(0.5 + level / 2.0)
