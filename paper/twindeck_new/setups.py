"""Which records are one setup, and under which condition each was made: by their columns, a table of sensors and the names of their files."""
import re

from .errors import InputError


def words_of(record, with_folder: bool) -> list:
    """The words of a record's file name, behind those of its folder where the records lie in several folders."""
    text = f"{record.file.resolve().parent.name} {record.file.stem}" if with_folder else record.file.stem
    return [w for w in re.split(r"[^\w.]+|_", text.lower()) if w]


def in_several_folders(records: list) -> bool:
    return len({r.file.resolve().parent for r in records}) > 1


def setups_of(records: list, tables: list) -> dict:
    """Setup -> its records. Where a table of sensors has a column of setups, by the file whose name holds the setup's; else records of the same
    columns are one setup. @throws InputError  for a record that holds the name of no setup of the table, or of two"""
    names = list(dict.fromkeys(s for t in tables for s in t.of_setup))
    if not names:
        layouts = {}
        for record in records:
            layouts.setdefault(record.columns, []).append(record)
        return {f"ST{number}": group for number, group in enumerate(layouts.values(), 1)}
    found = {name: [] for name in names}
    folders = in_several_folders(records)
    for record in records:
        words = words_of(record, folders)
        own = [name for name in names if any(_means(word, name.lower()) for word in (*words, record.file.name.lower(), record.file.stem.lower()))]
        if len(own) != 1:
            raise InputError(f"{record.file}: its name holds {'no setup' if not own else ' and '.join(own)} of the sensor table's column setup ({', '.join(names)}), "
                             "expected one: name the file after its setup, as in setup_2.csv")
        found[own[0]].append(record)
    return {name: group for name, group in found.items() if group}


def _means(word: str, setup: str) -> bool:
    """S2, ST02 and setup2 mean setup 2; any word means the setup of that name."""
    return word == setup or (setup.isdigit() and re.fullmatch(rf"(?:setup|set|st|s|aufbau)?0*{setup}", word) is not None)


def conditions_of(groups: list, records: list) -> dict | None:
    """File -> condition: the words by which the records of a setup differ, if those of all setups differ by the same ones (S1_warm, S1_cold, S2_warm,
    S2_cold: warm, cold). One record a setup: as_tested. None: the names of the files do not tell."""
    if all(len(group) == 1 for group in groups):
        return {r.file: "as_tested" for r in records}
    folders = in_several_folders(records)
    words = {r.file: words_of(r, folders) for r in records}
    several = [group for group in groups if len(group) > 1]
    labels = {}
    for group in several:
        common = set.intersection(*(set(words[r.file]) for r in group))
        labels |= {r.file: "_".join(w for w in words[r.file] if w not in common) for r in group}
    known = set(labels.values())
    for group in groups:
        if len(group) == 1:
            labels[group[0].file] = next((w for w in words[group[0].file] if w in known), "")
    own = [{labels[r.file] for r in group} for group in groups]
    apart = all("" not in found and len(found) == len(group) for found, group in zip(own, groups))
    shared = len(groups) == 1 or all(any(label in other for other in own if other is not found) for found in own for label in found)
    return labels if apart and shared else None
