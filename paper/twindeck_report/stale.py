"""Files that are no longer what their manifest says, steps whose inputs changed since they ran, and, for an edited table, the cells that
were edited."""
from .cells import csv_text
from .compare import row_names
from .errors import InputError
from .manifests import stale_inputs, stale_outputs
from .study import Study
from .tables import TABLES, table_name
from .tables.writer import full_table
from .tolerances import Tolerances
from .unchanged import changed_steps, step_folders


def find_stale(study: Study, tolerances: Tolerances) -> list:
    """[(file, what is wrong)] over tables/ and every step's folder."""
    tables = study.results / "tables"
    found = [(path, problem + _edited(study, path, tolerances)) for path, problem in stale_outputs(tables)]
    studies = [study, *([study.virtual()] if study.virtual() is not None else [])]
    return found + [finding for each in studies for finding in changed_steps(each) + stale_inputs(step_folders(each))] + stale_inputs([tables])


def _edited(study: Study, path, tolerances: Tolerances) -> str:
    """Names the cells of an edited table by making it again from the steps' results."""
    number = next((n for n in TABLES if path.name == f"{table_name(n)}.csv"), None)
    if number is None or not path.is_file():
        return ""
    try:
        fresh = full_table(study, number, tolerances)
        lying = study.read_csv(path, text=True)
    except InputError:
        return ""  # the steps' own trouble is reported by itself
    rows = list(row_names(lying, tolerances.keys[table_name(number)]))
    if list(lying.columns) != list(fresh.columns) or len(lying) != len(fresh):
        return "; rows or columns are not those that the steps' results give"
    cells = [f"row {rows[i]} column {c}: {lying[c][i] or 'empty'}, the steps give "
             f"{csv_text(fresh[c][i]) or 'empty'}"
             for i in range(len(fresh)) for c in fresh.columns if csv_text(fresh[c][i]) != lying[c][i]]
    more = f" and {len(cells) - 5} more" if len(cells) > 5 else ""
    return "; " + "; ".join(cells[:5]) + more if cells else "; no cell differs"
