"""What the simplest rule gives for a number that was recovered from virtual records: a peak of the mean spectrum, a taut string, one value
for all. Ours counts only where it is closer to the paper's than that (counts.py)."""
import pandas as pd

from .cells import csv_text, number
from .compare import load_paper, load_table
from .errors import InputError
from .identified import WITHOUT, folder_of
from .study import Study
from .tolerances import Tolerances

HARMONICS = 5  # of a stay in Table 5


def _peak(study: Study, table: str, column: str, paper: pd.DataFrame, ours: pd.DataFrame) -> dict:
    """The peak of the spectrum, mean over channels and setups, that is nearest to the printed frequency: as generous as the pairing of
    ours, which takes the identified mode nearest to it."""
    psd = study.step_csv(f"{folder_of(WITHOUT)}/psd.csv", ["frequency_Hz", "psd_m2_s3"])
    mean = psd.groupby("frequency_Hz")["psd_m2_s3"].mean()
    values, frequencies = mean.to_numpy(), mean.index.to_numpy()
    peaks = [f for a, b, c, f in zip(values, values[1:], values[2:], frequencies[1:]) if a < b >= c]
    return {row: min(peaks, key=lambda f: abs(f - number(paper.at[row, column])), default=None) for row in paper.index}


def _taut_string(study: Study, table: str, column: str, paper: pd.DataFrame, ours: pd.DataFrame) -> dict:
    """n / 2 times our second harmonic; the second itself by two thirds of our third."""
    n = int(column.removeprefix("f").removesuffix("_Hz"))
    other = 3 if n == 2 else 2
    return {row: n / other * found for row in paper.index if row in ours.index and (found := number(ours.at[row, f"f{other}_Hz"])) is not None}


def _one_value(study: Study, table: str, column: str, paper: pd.DataFrame, ours: pd.DataFrame) -> dict:
    printed = [number(text) for text in paper[column] if number(text) is not None]
    return dict.fromkeys(paper.index, sum(printed) / len(printed))


SIMPLEST = {"peak": _peak, "taut_string": _taut_string, "one_value": _one_value}


def judge_simplest(study: Study, tolerances: Tolerances, cells: list) -> None:
    """Puts into each compared cell of a column that names one what its simplest rule gives."""
    for table, rules in tolerances.columns.items():
        for rule in rules.values():
            own = [c for c in cells if c.table == table and c.column == rule.name and not c.shown]
            if not rule.simplest or not own:
                continue
            if rule.simplest not in SIMPLEST:
                raise InputError(f"{study.data / 'tolerances.toml'}: {table}.columns.{rule.name}: simplest {rule.simplest!r}; expected one of "
                                 f"{', '.join(SIMPLEST)}")
            key = tolerances.keys[table]
            values = SIMPLEST[rule.simplest](study, table, rule.name, load_paper(study, table, key), load_table(study, table, key))
            for cell in own:
                cell.simplest = csv_text(values.get(cell.row))
