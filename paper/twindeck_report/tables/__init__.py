"""One module a table: `TITLE` and `build(study)`, which gives ours in the columns and rows of the paper's table."""
from . import table_01, table_02, table_04, table_06, table_07, table_08, table_09

TABLES = {1: table_01, 2: table_02, 4: table_04, 6: table_06, 7: table_07, 8: table_08, 9: table_09}


def table_name(number: int) -> str:
    return f"table_{number:02d}"
