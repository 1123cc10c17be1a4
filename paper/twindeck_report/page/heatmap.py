"""Residuals in standard deviations as coloured cells: kind by kind, mode by mode, sensor by sensor."""
import html

import numpy as np

OWN = "own mode "
CELL, FULL = 15, 5.0  # [px]; the colour is full at this many standard deviations
NAMES = {"frequency_Hz": "Frequencies", "damping_ratio_pct": "Damping ratios", "shape": "Shapes", "shape_imag": "Shapes, imaginary parts",
         "stay_frequency_Hz": "Frequencies of the stays", "rms_m_s2": "RMS accelerations", "static_m": "Static displacements",
         "static_rotation_rad": "Static rotations", "static_strain": "Static strains", "static_force_N": "Support forces",
         "psd_floor_m2_s3": "Floors of the spectra"}
COLD, WARM = (11, 95, 165), (179, 38, 30)


def colour(z: float) -> str:
    """White at zero, blue where the measurement lies below the model, red above."""
    t = min(1.0, abs(z) / FULL)**0.8
    return "#" + "".join(f"{round(248 + t * (c - 248)):02x}" for c in (WARM if z > 0 else COLD))


def heatmaps(rows, extended: bool) -> list:
    """[{title, svg}] in the order of the file, one a kind and condition; `extended`: before and after the extension."""
    found = []
    for (kind, condition), part in rows.fillna({"channel": "", "condition": ""}).groupby(["type", "condition"], sort=False):
        title = f"{NAMES.get(kind, kind.replace('_', ' '))}{', ' + str(condition).replace('_', ' ') if condition else ''}"
        many = part["channel"].nunique() > 1
        part = part.assign(mode=[_within(mode, condition) for mode in part["mode"]])
        sides = [(side, _grid(part, f"residual_{side}", many)) for side in (("before", "after") if extended else ("before",))]
        found.append({"title": f"{title}: {len(part)} rows", "svg": _pair(sides) if many else _strip(sides)})
    return found


def _grid(part, column: str, many: bool) -> dict:
    """(row, column) -> (value, held out): modes over sensors, or one row over modes; a row without a mode is its sensor's."""
    found = {}
    for r in part.to_dict("records"):
        mode = "" if r["mode"] != r["mode"] else label(r["mode"])
        mode = mode if not mode or mode.startswith(OWN) else f"mode {mode}"
        if np.isfinite(r[column]):
            found[(mode, str(r["channel"])) if many else ("", mode or str(r["channel"]))] = (r[column], r["held_out"] == 1)
    return found


def _within(mode, condition):
    """A mode that one condition alone has bears that condition's name, which the title tells already."""
    own = f"{condition} "
    return OWN + mode.removeprefix(own) if isinstance(mode, str) and condition and mode.startswith(own) else mode


def label(mode) -> str:
    """A mode's number, also where other rows of its column are empty (1.0), or its name."""
    return str(int(mode)) if isinstance(mode, (int, float)) else str(mode)


def _strip(sides) -> str:
    """Before over after, with the numbers in the cells."""
    columns = list(dict.fromkeys(c for _, grid in sides for _, c in grid))
    wide, high, left = 52, 24, 56
    body = "".join(f'<text class="axis" x="{left + wide * (i + 0.5):.1f}" y="12" text-anchor="middle">{html.escape(c)}</text>' for i, c in enumerate(columns))
    for j, (side, grid) in enumerate(sides):
        body += f'<text class="axis" x="0" y="{20 + high * j + 16}">{side if len(sides) > 1 else ""}</text>'
        for i, c in enumerate(columns):
            if ("", c) in grid:
                z, held = grid["", c]
                ink = "#fff" if abs(z) > 0.55 * FULL else "#1d2733"
                body += (f'<g><title>{html.escape(c)}, {side}: {z:+.2f} standard deviations{", held out" if held else ""}</title>'
                         f'<rect x="{left + wide * i}" y="{20 + high * j}" width="{wide - 2}" height="{high - 2}" fill="{colour(z)}"{_held(held)}/>'
                         f'<text x="{left + wide * (i + 0.5) - 1:.1f}" y="{20 + high * j + 15}" text-anchor="middle" style="fill:{ink}">{round(z, 1) + 0.0:+.1f}</text></g>')
    return _svg(left + wide * len(columns), 22 + high * len(sides), body)


def _pair(sides) -> str:
    columns = list(dict.fromkeys(c for _, grid in sides for _, c in grid))
    names = list(dict.fromkeys(r for _, grid in sides for r, _ in grid))
    cell = CELL if len(columns) <= 64 else max(4, 960 // len(columns))
    left, body, y = 56, "", 0
    for side, grid in sides:
        if len(sides) > 1:
            body += f'<text class="axis strong" x="0" y="{y + 12}">{side}</text>'
            y += 18
        for name in names:
            body += f'<text class="axis" x="0" y="{y + 11}">{html.escape(name)}</text>'
            for i, c in enumerate(columns):
                if (name, c) in grid:
                    z, held = grid[name, c]
                    body += (f'<rect x="{left + cell * i}" y="{y}" width="{cell - 1}" height="{CELL - 1}" fill="{colour(z)}"{_held(held)}>'
                             f'<title>{html.escape(name)}, {html.escape(c)}, {side}: {z:+.2f} standard deviations{", held out" if held else ""}</title></rect>')
            y += CELL
        y += 6
    if cell >= 12:
        for i, c in enumerate(columns):
            x = left + cell * i + 10
            body += f'<text class="axis" transform="translate({x} {y + 4}) rotate(90)">{html.escape(c[:14])}</text>'
        y += 8 + 6 * max(len(c[:14]) for c in columns)
    return _svg(left + cell * len(columns) + 8, y, body)


def _held(held: bool) -> str:
    return ' stroke="#1d2733" stroke-width="1.4"' if held else ""


def _svg(width: float, height: float, body: str) -> str:
    return f'<svg class="heat" viewBox="0 0 {width} {height}" style="width:{width}px" role="img">{body}</svg>'
