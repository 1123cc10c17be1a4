"""CSV files as data frames that know their units."""
from pathlib import Path

import pandas as pd

from .errors import InputError
from .units import unit_of_column


def read_table(file) -> pd.DataFrame:
    """A CSV file of twindeck as a data frame.

    An empty cell is NaN; every other text stays text (a bound called `none` is no missing value).

    Parameters
    ----------
    file : path of the file

    Returns
    -------
    pandas.DataFrame
        One row a record. `frame.attrs["units"]` maps each column whose name states a unit to it, `frame.attrs["file"]` names the file.

    Raises
    ------
    InputError
        If the file is missing or no CSV file.

    Examples
    --------
    >>> modes = read_table("results/s1_model/modes.csv")        # doctest: +SKIP
    >>> modes.attrs["units"]["frequency_Hz"]                    # doctest: +SKIP
    'Hz'
    """
    path = Path(file)
    if not path.is_file():
        raise InputError(f"{path}: missing; expected a CSV file")
    try:
        frame = pd.read_csv(path, keep_default_na=False, na_values=[""], encoding="utf-8")
    except (ValueError, UnicodeDecodeError) as problem:
        raise InputError(f"{path}: not a readable CSV file ({problem})") from problem
    return with_units(frame, file=path.as_posix())


def with_units(frame: pd.DataFrame, **about) -> pd.DataFrame:
    """The frame itself, with the units of its columns and what is told `about` it in `frame.attrs`."""
    frame.attrs["units"] = {column: unit for column in frame.columns if (unit := unit_of_column(str(column)))}
    frame.attrs.update(about)
    return frame
