"""campaign.toml, channels.csv and conditions.toml out of records as they lie there."""
import csv
import json
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

from .inspection import Record
from .sensors import of_universal_file

HEADER = ("channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role")
SCALES = {  # unit in a file, without blanks and case -> (name in channels.csv, quantity, factor to SI units): src/records/recorded_unit.cpp has them all
    "m/s2": ("m/s^2", "acceleration", 1.0), "m/s^2": ("m/s^2", "acceleration", 1.0), "m/s²": ("m/s^2", "acceleration", 1.0), "mm/s2": ("mm/s^2", "acceleration", 1e-3),
    "mm/s^2": ("mm/s^2", "acceleration", 1e-3), "g": ("g", "acceleration", 9.80665), "mg": ("mg", "acceleration", 9.80665e-3), "gal": ("Gal", "acceleration", 1e-2),
    "m/s": ("m/s", "velocity", 1.0), "cm/s": ("cm/s", "velocity", 1e-2), "mm/s": ("mm/s", "velocity", 1e-3), "um/s": ("um/s", "velocity", 1e-6),
    "m": ("m", "displacement", 1.0), "cm": ("cm", "displacement", 1e-2), "mm": ("mm", "displacement", 1e-3), "um": ("um", "displacement", 1e-6),
    "v": ("V", "acceleration", 1.0), "mv": ("mV", "acceleration", 1.0)}
UNIVERSAL = (".uff", ".unv", ".uf", ".58")


@dataclass(frozen=True)
class Written:
    setups: list
    conditions: list
    missing: list  # a line each


def channel_name(column: str, number: int) -> str:
    """A column's name as a channel's; c1, c2, … for columns that have none."""
    plain = re.sub(r"[^A-Za-z0-9_.-]+", "_", column).strip("_")
    return plain if plain and not re.fullmatch(r"column_\d+", plain) else f"c{number}"


def write_campaign(records: list, tables: list, folder: Path) -> Written:
    """Copies the records into folder/records. Records of the same columns are one setup under several conditions; others are setups."""
    (folder / "records").mkdir(parents=True)
    layouts = {}
    for record in records:
        layouts.setdefault(record.columns, []).append(record)
    missing, known, entries, conditions = [], {}, [], []
    for number, (columns, group) in enumerate(layouts.items(), 1):
        names = _unique([channel_name(c, i) for i, c in enumerate(columns, 1)])
        for record in group:
            condition = "as_tested" if len(group) == 1 else channel_name(record.file.stem, 1)
            conditions.append(condition)
            shutil.copy2(record.file, folder / "records" / record.file.name)
            entries.append(_entry(f"ST{number}", record, names, condition, missing))
        for name, column, unit in zip(names, columns, group[0].units):
            known.setdefault(name, _channel(name, column, unit, group[0], tables))
    shared = set.intersection(*(set(columns) for columns in layouts)) if len(layouts) > 1 and all(r.named for r in records) else set()
    for name, row in known.items():
        row["reference"] = "1" if name in {channel_name(c, 1) for c in shared} else row["reference"]
    if len(layouts) > 1 and not shared:
        missing.append("channels.csv: `reference` = 1 for the channels that stayed in place in all setups; they tie the setups together")
    if len(layouts) > 1 and len(set(conditions) - {"as_tested"}) > 1:
        missing.append("campaign.toml: one and the same `condition` for the records of all setups that were made in one state; they are joined then; name one of them in s4_refinement.toml and s6_updating.toml too")
    if len(conditions) > len(layouts):
        missing.append("conditions.toml: what was different between the records: temperature_C, wind_m_s, state = \"name\" where the structure itself changed")
    (folder / "campaign.toml").write_text("\n".join(entries), encoding="utf-8")
    conditions = list(dict.fromkeys(conditions))
    (folder / "conditions.toml").write_text("".join(f"[{c}]\n" for c in conditions), encoding="utf-8")
    with (folder / "channels.csv").open("w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, HEADER, lineterminator="\n")
        writer.writeheader()
        for line, (name, row) in enumerate(known.items(), 2):
            writer.writerow(row)
            missing += _lacking(name, row, line)
    return Written([f"ST{i}" for i in range(1, len(layouts) + 1)], conditions, missing)


def _unique(names: list) -> list:
    found = []
    for i, name in enumerate(names, 1):
        found.append(name if name not in found else f"{name}_{i}")
    return found


def _entry(setup: str, record: Record, names: list, condition: str, missing: list) -> str:
    if record.rate_Hz is None:
        missing.append(f"campaign.toml: sampling_rate_Hz of {record.file.name}: the file does not tell it")
    rate = f"sampling_rate_Hz = {record.rate_Hz:.12g}" if record.rate_Hz else "# sampling_rate_Hz = 100.0   # the file does not tell it: state it"
    columns = f"columns = {json.dumps(list(record.columns), ensure_ascii=False)}\n" if record.named and list(record.columns) != names else ""
    return (f'[[record]]\nsetup = "{setup}"\nkind = "ambient"\nfile = "records/{record.file.name}"\n{rate}\n'
            f'channels = {json.dumps(names)}\n{columns}condition = "{condition}"\n')


def _channel(name: str, column: str, unit: str, record: Record, tables: list) -> dict:
    row = dict.fromkeys(HEADER, "") | {"channel": name, "point": name, "quantity": "acceleration", "gain": "1", "reference": "0", "role": "response"}
    sources = list(tables)
    if record.file.suffix.lower() in UNIVERSAL:
        found = of_universal_file(record.file, record.columns)
        sources += [found] if found is not None else []
    told = next((t.rows[key] for t in sources for key in (column, name) if key in t.rows), {})
    row |= {field: value for field, value in told.items() if field != "unit"}
    scale = SCALES.get((told.get("unit") or unit).replace(" ", "").lower())
    if scale is None:
        row["unit"] = "counts"  # frequencies and damping need no scale; shapes need the same for all channels
    else:
        row["unit"], row["quantity"] = scale[:2]
        row["gain"] = told.get("gain", f"{scale[2]:.12g}")
    return row


def _lacking(name: str, row: dict, line: int) -> list:
    where = f"channels.csv line {line}: {name}:"
    found = []
    if not (row["x_m"] and row["y_m"] and row["z_m"]):
        found.append(f"{where} position x_m, y_m, z_m")
    if not (row["dx"] and row["dy"] and row["dz"]):
        found.append(f"{where} direction dx, dy, dz")
    if row["unit"] == "counts":
        found.append(f"{where} unit and gain to SI units (read as counts until then)")
    return found


def all_known(tables: list, records: list) -> list:
    """Rows of a sensor table that no record has: a slip of a name, most likely."""
    columns = {c for r in records for c in r.columns} | {channel_name(c, i) for r in records for i, c in enumerate(r.columns, 1)}
    return [f"{t.file}: '{name}' is no channel of the records ({', '.join(sorted(columns)[:8])}{', …' if len(columns) > 8 else ''})"
            for t in tables for name in t.rows if name not in columns]


