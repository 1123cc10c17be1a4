"""Spectra of every record: singular values of the spectral density, and the density of each channel."""
import numpy as np

from ..study import Study
from .chart import log_chart, log_range, thinned

MOST_PANELS = 240  # channels drawn; those of further records stay in psd.csv
ABOVE = 2.0  # times the highest identified mode: what lies above is not drawn
UNITS = {"psd_m2_s3": "m²/s³"}


def spectra(study: Study) -> dict | None:
    """{records: [{title, singular: svg, channels: [{name, svg}]}], left_out: channels that are not drawn, unit}"""
    if "s3_identification" not in study.steps():
        return None
    records, drawn, left_out, unit = [], 0, 0, ""
    for folder in _folders(study):
        singular, density = (_table(study, f"{folder}/{name}.csv") for name in ("singular_values", "psd"))
        modes = _modes(study, folder)
        column = next((c for c in density.columns if c.startswith("psd")), None) if density is not None else None
        unit = UNITS.get(column, (column or "").removeprefix("psd_")) or unit
        for key in _keys(singular, density, folder):
            channels = _channels(_part(density, key), column) if column else []
            kept = channels[:max(0, MOST_PANELS - drawn)]
            drawn, left_out = drawn + len(kept), left_out + len(channels) - len(kept)
            values = _singular(_part(singular, key))
            if values or kept:
                records.append(_record(key, values, kept, modes))
    return {"records": records, "left_out": left_out, "unit": unit} if records else None


def _record(key: tuple, values: list, channels: list, modes: list) -> dict:
    title = ", ".join(str(k).replace("_", " ") for k in key if str(k))
    highest = ABOVE * max((f for _, f in modes), default=np.inf)
    curves = [(name, _below(curve, highest)) for name, curve in channels]
    span = log_range([c for _, c in curves]) if curves else (0, 1)
    shown = [_below(curve, highest) for curve in values]
    return {"title": title,
            "singular": log_chart(shown[::-1], log_range(shown), modes, f"Singular values of the spectral density, {title}") if shown else "",
            "channels": [{"name": name, "svg": log_chart([curve], span, modes, f"Spectral density of {name}, {title}")} for name, curve in curves]}


def _below(curve, highest: float):
    frequency, values, kind = curve
    kept = frequency <= max(highest, frequency[min(1, len(frequency) - 1)])
    return (*thinned(frequency[kept], values[kept]), kind)


def _singular(table) -> list:
    """Curves, the first singular value first."""
    if table is None or table.empty:
        return []
    columns = sorted((c for c in table.columns if c[:2] == "sv" and c[2:].isdigit()), key=lambda c: int(c[2:]))
    frequency = table["frequency_Hz"].to_numpy(float)
    return [(frequency, np.nan_to_num(table[c].to_numpy(float)), "first" if c == columns[0] else "further") for c in columns]


def _channels(table, column: str) -> list:
    return [(str(name), (rows["frequency_Hz"].to_numpy(float), np.nan_to_num(rows[column].to_numpy(float)), "first"))
            for name, rows in table.groupby("channel", sort=False)]


def _folders(study: Study) -> list:
    others = sorted(p for p in (study.results / "s3_identification/conditions").glob("*") if p.is_dir())
    return ["s3_identification", *(f"s3_identification/conditions/{p.name}" for p in others)]


def _table(study: Study, name: str):
    return study.step_csv(name, ["setup", "frequency_Hz"]) if (study.results / name).is_file() else None


def _keys(singular, density, folder: str) -> list:
    """(setup, condition) of every record in the order of the files."""
    keys = []
    for table in (singular, density):
        if table is not None:
            if "condition" not in table:
                table["condition"] = folder.rpartition("/")[2] if "/" in folder else ""
            table["setup"], table["condition"] = table["setup"].astype(str), table["condition"].fillna("").astype(str)
            keys += list(table[["setup", "condition"]].drop_duplicates().itertuples(index=False, name=None))
    return list(dict.fromkeys(keys))


def _part(table, key: tuple):
    return None if table is None else table[(table["setup"] == key[0]) & (table["condition"] == key[1])]


def _modes(study: Study, folder: str) -> list:
    if not (study.results / folder / "modes.csv").is_file():
        return []
    return [(int(r["mode"]), r["frequency_Hz"]) for r in study.step_csv(f"{folder}/modes.csv", ["mode", "frequency_Hz"]).to_dict("records")]
