"""MAC matrices as coloured cells: measured with computed modes before and after updating, and the measured modes with each other."""
import html

import numpy as np

from ..study import Study
from .complexity import identified_shapes

CELL_X, CELL_Y, LEFT, TOP = 34, 22, 46, 22
FULL = (11, 95, 165)  # colour at MAC 1; white at 0, in proportion between: nothing is cut off
MATRICES = (("s4_refinement", "Measured and computed modes, before updating"), ("s6_updating", "Measured and computed modes, after updating"))


def mac_matrices(study: Study) -> list:
    """[{title, svg}]"""
    found = []
    for token, title in MATRICES:
        name = f"{token}/mac.csv"
        if token not in study.steps() or not (study.results / name).is_file():
            continue
        table = study.step_csv(name, ["experimental_mode", "numerical_mode", "mac"])
        table = table[table["mac"].notna()]
        if len(table):
            cells = {(str(r["experimental_mode"]), str(r["numerical_mode"])): float(r["mac"]) for r in table.to_dict("records")}
            found.append({"title": title, "svg": matrix(cells, _pairs(study, token))})
    labels, shapes = identified_shapes(study)
    if len(labels) > 1:
        names = [f"{label}X" for label in labels]
        cells = {(a, b): mac(p, q) for a, p in zip(names, shapes) for b, q in zip(names, shapes)}
        found.append({"title": "Measured modes with each other", "svg": matrix(cells, set())})
    return found


def mac(a, b) -> float:
    """|a^H b|^2 / (a^H a b^H b) over the channels that both have."""
    both = np.isfinite(a) & np.isfinite(b)
    energy = np.vdot(a[both], a[both]).real * np.vdot(b[both], b[both]).real
    return float(abs(np.vdot(a[both], b[both])) ** 2 / energy) if energy > 0 else 0.0


def matrix(cells: dict, framed: set) -> str:
    """`cells`: (row, column) -> MAC; `framed`: pairs that belong together."""
    rows, columns = (list(dict.fromkeys(key[i] for key in cells)) for i in (0, 1))
    body = "".join(f'<text class="axis" x="{LEFT + CELL_X * (i + 0.5):.0f}" y="{TOP - 7}" text-anchor="middle">{html.escape(c)}</text>' for i, c in enumerate(columns))
    frames = ""
    for j, row in enumerate(rows):
        y = TOP + CELL_Y * j
        body += f'<text class="axis" x="{LEFT - 6}" y="{y + 15}" text-anchor="end">{html.escape(row)}</text>'
        for i, column in enumerate(columns):
            if (row, column) not in cells:
                continue
            value, x = cells[row, column], LEFT + CELL_X * i
            ink = "#fff" if value > 0.5 else "#1d2733"
            body += (f'<g><title>{html.escape(row)}, {html.escape(column)}: MAC {value:.3f}</title><rect x="{x}" y="{y}" width="{CELL_X - 2}" height="{CELL_Y - 2}" fill="{_colour(value)}"/>'
                     f'<text x="{x + CELL_X / 2 - 1:.0f}" y="{y + 14}" text-anchor="middle" style="fill:{ink}">{value:.2f}</text></g>')
            if (row, column) in framed:
                frames += f'<rect x="{x - 0.5}" y="{y - 0.5}" width="{CELL_X - 1}" height="{CELL_Y - 1}" fill="none" stroke="#b3261e" stroke-width="1.8"/>'
    width, height = LEFT + CELL_X * len(columns) + 2, TOP + CELL_Y * len(rows) + 2
    return f'<svg class="heat" viewBox="0 0 {width} {height}" width="{width}" height="{height}" style="width:{width}px" role="img" aria-label="MAC matrix">{body}{frames}</svg>'


def _colour(value: float) -> str:
    t = min(1.0, max(0.0, value))
    return "#" + "".join(f"{round(248 + t * (c - 248)):02x}" for c in FULL)


def _pairs(study: Study, token: str) -> set:
    """The pairs of the last stage of the comparison."""
    if not (study.results / token / "comparison.csv").is_file():
        return set()
    table = study.step_csv(f"{token}/comparison.csv", ["stage", "experimental_mode", "numerical_mode"])
    last = table[table["stage"] == table["stage"].iloc[-1]] if len(table) else table
    return {(str(r["experimental_mode"]), str(r["numerical_mode"])) for r in last.to_dict("records")}
