"""One module a table: `TITLE` and `build(study)`, which gives ours in the columns and rows of the paper's table."""
from . import (table_01, table_02, table_03, table_04, table_05, table_06, table_07, table_08, table_09, table_10, table_11, table_12,
               table_12_quasi_steady, table_13, table_14)

# By the paper's number; a further version of one of its tables by that number and a word: "12_quasi_steady".
TABLES = {1: table_01, 2: table_02, 3: table_03, 4: table_04, 5: table_05, 6: table_06, 7: table_07, 8: table_08, 9: table_09,
          10: table_10, 11: table_11, 12: table_12, "12_quasi_steady": table_12_quasi_steady, 13: table_13, 14: table_14}


def table_name(number) -> str:
    return f"table_{number:02d}" if isinstance(number, int) else f"table_{number}"


def paper_number(number) -> int:
    """Number of the paper's table that a table is compared with."""
    return number if isinstance(number, int) else int(number.partition("_")[0])
