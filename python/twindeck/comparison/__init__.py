"""Two runs beside each other: which options and inputs differ, and what moved by how much.

It takes two results folders (or the folders of one step), and gives one data frame with a row for each thing that was compared.
"""
from dataclasses import dataclass, field

import pandas as pd

from ..errors import InputError
from ..results import Run
from ..tables import with_units
from .answers import diagnosis_rows
from .modes import mode_rows
from .options import option_rows
from .quantities import table_rows
from .rows import COLUMNS, ONLY_A, ONLY_B, SAME, text_row

__all__ = ["COLUMNS", "Comparison", "ONLY_A", "ONLY_B", "SAME", "compare"]


@dataclass
class Comparison:
    """What two runs have in common and what not.

    Attributes
    ----------
    a, b : Run
    table : pandas.DataFrame
        One row a thing: `part,step,item,quantity,unit,a,b,change,change_pct,std,change_in_std,status`. `change` is b - a; `std` is the larger of
        the two runs' standard deviations where they state one; `status` is `same`, `moved` (a number), `differs` (a text), `only in A` or
        `only in B`.
    notes : list of str
        What could not be compared, and why.
    """

    a: Run
    b: Run
    table: pd.DataFrame
    notes: list = field(default_factory=list)

    @property
    def options(self) -> pd.DataFrame:
        """Configuration, inputs, versions and outcomes that differ."""
        return self.changed[self.changed["part"].isin(("options", "inputs", "outcome"))]

    @property
    def changed(self) -> pd.DataFrame:
        """The rows that are not the same in both runs."""
        return self.table[self.table["status"] != SAME]

    @property
    def results(self) -> pd.DataFrame:
        """The rows of the results, changed or not: all but options, inputs and outcomes."""
        return self.table[~self.table["part"].isin(("options", "inputs", "outcome"))]


def compare(a, b) -> Comparison:
    """Holds two runs against each other.

    Parameters
    ----------
    a, b : path or Run
        Two results folders, or the folders of the same step in two runs.

    Returns
    -------
    Comparison

    Raises
    ------
    InputError
        If a folder is missing or holds no finished step, if the two have no step in common, or if a file was changed since its step wrote it.

    Examples
    --------
    >>> found = compare("results/before", "results/after")                                     # doctest: +SKIP
    >>> found.changed[["step", "item", "quantity", "a", "b", "change_pct", "change_in_std"]]   # doctest: +SKIP
    """
    first, second = (run if isinstance(run, Run) else Run(run) for run in (a, b))
    common = [step for step in first.steps if step in second]
    if not common:
        raise InputError(f"{first.folder} holds {', '.join(first.steps)} and {second.folder} {', '.join(second.steps)}; give two runs of the same steps")
    rows, notes = [], []
    for run, name in ((first, "A"), (second, "B")):
        notes += [f"{step} of {name} is not finished: it has no manifest.json" for step in run.unfinished]
    for step in [*common, *(s for s in [*first.steps, *second.steps] if s not in common)]:
        if step in common:
            one, other = first[step], second[step]
            rows += option_rows(one, other) + mode_rows(one, other, notes) + table_rows(one, other)
            rows += diagnosis_rows(one, other) if step == "s9_diagnosis" else []
        else:
            rows.append(text_row("outcome", step, "step", "finished", "yes" if step in first else None, "yes" if step in second else None))
    table = pd.DataFrame(_once(rows, len(common)), columns=COLUMNS)
    return Comparison(first, second, with_units(table), notes)


def _once(rows: list, steps: int) -> list:
    """The rows with what all steps say alike of the program (version, commit, libraries, seed) said once, of `all steps`."""
    alike = {}
    for row in rows:
        if row["item"] == "program":
            alike.setdefault((row["quantity"], row["a"], row["b"]), []).append(row)
    kept = []
    for row in rows:
        same = alike.get((row["quantity"], row["a"], row["b"]), []) if row["item"] == "program" else []
        if steps == 1 or len(same) < steps:
            kept.append(row)
        elif row is same[0]:
            kept.append(row | {"step": "all steps"})
    return kept
