"""results/check_power/power.csv, as `make check-power` leaves it: which changed inputs the check catches."""
from .study import Study

FILE = "check_power/power.csv"
COLUMNS = ["perturbation", "caught", "paper", "ratchet", "cells", "margin", "why"]
SHOWN_CELLS = 3


def power_page(study: Study) -> dict | None:
    """Rows and a sentence for the report; None where the power was not measured. Beside the results of the study, not among them."""
    path = study.results.parent / FILE
    if not path.is_file():
        return None
    table = study.read_csv(path, COLUMNS, text=True)
    rows = []
    for row in table.to_dict("records"):
        cells = [cell for cell in row["cells"].split("; ") if cell]
        more = f" and {len(cells) - SHOWN_CELLS} more" if len(cells) > SHOWN_CELLS else ""
        rows.append({**row, "count": len(cells), "cells": "; ".join(cells[:SHOWN_CELLS]) + more})
    caught, paper = (sum(row[name] == "yes" for row in rows) for name in ("caught", "paper"))
    told = (f"{caught} of {len(rows)} changed inputs are caught by a number that does not print them ({100 * caught / len(rows):.0f} %), "
            f"{paper} by the paper gate alone ({100 * paper / len(rows):.0f} %).") if rows else "No input was changed."
    return {"rows": rows, "told": told}
