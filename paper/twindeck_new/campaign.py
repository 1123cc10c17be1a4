"""campaign.toml, channels.csv and conditions.toml out of records as they lie there."""
import csv
import json
import re
import shutil
from dataclasses import dataclass, field
from pathlib import Path

from .inspection import Record
from .places import TOLERANCE_M, Nodes, completed, split_name
from .sensors import of_universal_file
from .setups import conditions_of, setups_of

HEADER = ("channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "gain", "reference", "role")
SCALES = {  # unit in a file, plain as `scale_of` makes it -> (name in channels.csv, quantity, factor to SI units): src/records/recorded_unit.cpp has them all
    "m/s2": ("m/s^2", "acceleration", 1.0), "cm/s2": ("cm/s^2", "acceleration", 1e-2), "mm/s2": ("mm/s^2", "acceleration", 1e-3), "gal": ("Gal", "acceleration", 1e-2),
    "g": ("g", "acceleration", 9.80665), "mg": ("mg", "acceleration", 9.80665e-3), "ug": ("ug", "acceleration", 9.80665e-6),
    "m/s": ("m/s", "velocity", 1.0), "cm/s": ("cm/s", "velocity", 1e-2), "mm/s": ("mm/s", "velocity", 1e-3), "um/s": ("um/s", "velocity", 1e-6),
    "m": ("m", "displacement", 1.0), "cm": ("cm", "displacement", 1e-2), "mm": ("mm", "displacement", 1e-3), "um": ("um", "displacement", 1e-6),
    "v": ("V", "acceleration", 1.0), "mv": ("mV", "acceleration", 1.0)}
PLACE = ("x_m", "y_m", "z_m", "dx", "dy", "dz")
UNIVERSAL = (".uff", ".unv", ".uf", ".58")


@dataclass(frozen=True)
class Written:
    setups: list
    conditions: list
    missing: list  # a line each
    read: list = field(default_factory=list)  # what names of channels and files, and the model, filled in; a line each


def channel_name(column: str, number: int) -> str:
    """A column's name as a channel's; c1, c2, … for columns that have none."""
    plain = re.sub(r"[^A-Za-z0-9_.-]+", "_", column).strip("_")
    return plain if plain and not re.fullmatch(r"column_\d+", plain) else f"c{number}"


def write_campaign(records: list, tables: list, folder: Path, nodes: Nodes | None = None) -> Written:
    """Copies the records into folder/records. A channel stands once in channels.csv, in however many setups it was recorded."""
    (folder / "records").mkdir(parents=True)
    setups, missing, known, entries, told, placed = setups_of(records, tables), [], {}, [], {}, {}
    states = conditions_of(list(setups.values()), records) or {r.file: r.file.stem for r in records}
    channels = {setup: _channels(setup, group[0], tables, nodes, known, placed) for setup, group in setups.items()}
    for setup, group in setups.items():
        for record in group:
            condition = channel_name(states[record.file], 1)
            told.setdefault(condition, record.temperature_C)
            shutil.copy2(record.file, folder / "records" / copied_name(record, records))
            entries.append(_entry(setup, record, channels[setup], condition, copied_name(record, records), missing))
    several, own_conditions = len(setups) > 1, len(set(told) - {"as_tested"})
    shared = set.intersection(*map(set, channels.values())) if several and (all(r.named for r in records) or any(t.of_setup for t in tables)) else set()
    for name in shared:
        known[name]["reference"] = "1"
    if several and not shared:
        missing.append("channels.csv: `reference` = 1 for the channels that stayed in place in all setups; they tie the setups together")
    if several and own_conditions > 1 and len(told) == len(records):
        missing.append("campaign.toml: one and the same `condition` for the records of all setups that were made in one state; they are joined then; name one of them in s4_refinement.toml and s6_updating.toml too")
    if len(told) > 1:
        missing.append("conditions.toml: what was different between the records: temperature_C, wind_m_s, state = \"name\" where the structure itself changed")
    (folder / "campaign.toml").write_text("\n".join(entries), encoding="utf-8")
    (folder / "conditions.toml").write_text("".join(f"[{c}]\n" + (f"temperature_C = {t:.4g}\n" if t is not None else "") for c, t in told.items()), encoding="utf-8")
    with (folder / "channels.csv").open("w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, HEADER, lineterminator="\n")
        writer.writeheader()
        writer.writerows(known.values())
    return Written(list(setups), list(told), missing + _lacking(known) + far_from_nodes(known, nodes), _read(placed, shared, told, several))


def copied_name(record: Record, records: list) -> str:
    """Of its copy in records/: with its folder's name before it where another record has the same name."""
    alone = sum(r.file.name == record.file.name for r in records) == 1
    return record.file.name if alone else f"{record.file.resolve().parent.name}_{record.file.name}"


def _channels(setup: str, record: Record, tables: list, nodes: Nodes | None, known: dict, placed: dict) -> list:
    """Names of the record's channels in the order of its columns; adds their rows to `known`, and to `placed` what the model places. Sensors at one place along one direction are one channel;
    another sensor of a known name gets its setup's name behind it."""
    names = _unique([channel_name(c, i) for i, c in enumerate(record.columns, 1)])
    for i, (name, column, unit) in enumerate(zip(names, record.columns, record.units)):
        stated = _channel(name, column, unit, record, tables, setup)
        row = completed(stated, column, nodes)
        if any(name in t.of_setup.get(s, {}) or column in t.of_setup.get(s, {}) for t in tables for s in t.of_setup):
            place = [row[f] for f in PLACE]
            same = next((n for n, r in known.items() if all(place) and [r[f] for f in PLACE] == place and n not in names[:i]), None)
            names[i] = same or (f"{name}_{channel_name(setup, 1)}" if name in known else name)
        if row["x_m"] != stated["x_m"]:
            placed[names[i]] = row["point"]
        known.setdefault(names[i], row | {"channel": names[i]})
    return names


def _read(placed: dict, shared: set, conditions: dict, several: bool) -> list:
    """What was filled in, for the engineer to look over."""
    lines = [f"places out of the model: {', '.join(f'{name} at {point}' for name, point in placed.items())}"] if placed else []
    if shared:
        lines.append(f"references, in all setups: {', '.join(sorted(shared))}")
    if several and len(conditions) > 1 or any(t is not None for t in conditions.values()):
        lines.append("conditions: " + ", ".join(name + (f" at {t:.4g} °C" if t is not None else "") for name, t in conditions.items()))
    return lines


def _unique(names: list) -> list:
    found = []
    for i, name in enumerate(names, 1):
        found.append(name if name not in found else f"{name}_{i}")
    return found


def _entry(setup: str, record: Record, names: list, condition: str, copy: str, missing: list) -> str:
    if record.rate_Hz is None and not record.responses:
        missing.append(f"campaign.toml: sampling_rate_Hz of {record.file.name}: the file does not tell it")
    kind = "frf" if record.responses else "ambient"
    rate = "# frequency response functions have no sampling rate" if record.responses else f"sampling_rate_Hz = {record.rate_Hz:.12g}" if record.rate_Hz else "# sampling_rate_Hz = 100.0   # the file does not tell it: state it"
    columns = f"columns = {json.dumps(list(record.columns), ensure_ascii=False)}\n" if record.named and list(record.columns) != names else ""
    return (f'[[record]]\nsetup = "{setup}"\nkind = "{kind}"\nfile = "records/{copy}"\n{rate}\n'
            f'channels = {json.dumps(names)}\n{columns}condition = "{condition}"\n')


def _channel(name: str, column: str, unit: str, record: Record, tables: list, setup: str) -> dict:
    """The row of channels.csv as far as tables and the record tell it; with `node` where a table names one."""
    row = dict.fromkeys(HEADER, "") | {"channel": name, "point": name, "quantity": "acceleration", "gain": "1", "reference": "0", "role": "response"}
    sources = list(tables)
    if record.file.suffix.lower() in UNIVERSAL:
        nodes = of_universal_file(record.file, record.columns)
        sources += [nodes] if nodes is not None else []
    told = next((found for t in sources if (found := t.told((column, name), setup))), {})
    row |= {key: value for key, value in told.items() if key != "unit"}
    scale = scale_of(told.get("unit") or unit)
    if scale is None:
        row["unit"] = "counts"  # frequencies and damping need no scale; shapes need the same for all channels
    else:
        row["unit"], row["quantity"] = scale[:2]
        row["gain"] = told.get("gain", f"{scale[2]:.12g}")
    return row


def scale_of(unit: str) -> tuple | None:
    """(name in channels.csv, quantity, factor to SI units); None for a unit that is not known"""
    plain = unit.strip(" []()").lower()
    for spelling, as_in_table in ((" ", ""), ("^", ""), ("²", "2"), ("µ", "u"), ("μ", "u")):
        plain = plain.replace(spelling, as_in_table)
    return SCALES.get(plain)


def _lacking(known: dict) -> list:
    """A line for each kind of cell that is empty, with the lines of channels.csv."""
    kinds = (("position x_m, y_m, z_m", lambda r: not (r["x_m"] and r["y_m"] and r["z_m"])), ("direction dx, dy, dz", lambda r: not (r["dx"] and r["dy"] and r["dz"])),
             ("unit and gain to SI units (read as counts until then)", lambda r: r["unit"] == "counts"))
    found = []
    for words, lacks in kinds:
        lines = [(line, name) for line, (name, row) in enumerate(known.items(), 2) if lacks(row)]
        if lines:
            found.append(f"channels.csv line{'s' * (len(lines) > 1)} {', '.join(str(line) for line, _ in lines)}: {', '.join(name for _, name in lines)}: {words}")
    return found


def far_from_nodes(known: dict, nodes: Nodes | None) -> list:
    """A line for each channel that lies farther from all nodes than step 4 allows."""
    found = []
    for line, (name, row) in enumerate(known.items(), 2):
        if nodes is not None and all(row[f] for f in PLACE[:3]):
            node, distance = nodes.nearest([float(row[f]) for f in PLACE[:3]])
            if distance > TOLERANCE_M:
                found.append(f"channels.csv line {line}: {name}: lies {distance:.2f} m from the nearest node ({node}), expected at most {TOLERANCE_M} m: "
                             "check its position, its unit (m) and the axes of the model, or raise `sensor_tolerance` in s4_refinement.toml, s6_updating.toml and s9_diagnosis.toml")
    return found


def all_known(tables: list, records: list) -> list:
    """Rows of a sensor table that no record has: a slip of a name, most likely."""
    columns = {c for r in records for c in r.columns} | {channel_name(c, i) for r in records for i, c in enumerate(r.columns, 1)}
    points = columns | {split_name(c)[0] for c in columns}
    return [f"{t.file}: '{name}' is no channel of the records ({', '.join(sorted(columns)[:8])}{', …' if len(columns) > 8 else ''})"
            for t in tables for rows in (t.rows, *t.of_setup.values()) for name in rows if name not in points]


