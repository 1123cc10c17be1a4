"""One number of an input file changed in place, everything else of the file kept: of a TOML file by its dotted key, of a CSV file by its
column. An entry of a list ([[damper]]) is called by its `name`, or else its `type`: damper.C.damping."""
import csv
import io
import re
from fnmatch import fnmatchcase

from twindeck_report.errors import InputError

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
ASSIGNMENT = re.compile(r'^(\s*)("?[\w.\-]+"?)(\s*=\s*)(.*)$')
COMMENT = re.compile(r"(\s+#.*)?$")


def toml_edited(text: str, pattern: str, change) -> tuple:
    """The text with every value whose dotted key matches `pattern` changed, and how many there were. @param change  text -> text"""
    lines, keys = text.split("\n"), _dotted_keys(text)
    found = 0
    for i, key in keys.items():
        if not fnmatchcase(key, pattern):
            continue
        blank, name, equals, rest = ASSIGNMENT.match(lines[i]).groups()
        comment = COMMENT.search(rest).group()
        value = rest[:len(rest) - len(comment)] if comment else rest
        lines[i] = blank + name + equals + change(value) + comment
        found += 1
    return "\n".join(lines), found


def _dotted_keys(text: str) -> dict:
    """{line: dotted key} of every assignment; entries of lists by their name or type."""
    keys, header, entry_of = {}, "", {}
    lines = text.split("\n")
    for i, line in enumerate(lines):
        stripped = line.split("#")[0].strip()
        if stripped.startswith("[[") and stripped.endswith("]]"):
            header = stripped[2:-2].strip()
            entry_of[header] = _entry_name(lines, i)
        elif stripped.startswith("[") and stripped.endswith("]"):
            header = stripped[1:-1].strip()
        elif match := ASSIGNMENT.match(line):
            keys[i] = ".".join(part for part in (_named(header, entry_of), match.group(2).strip('"')) if part)
    return keys


def _entry_name(lines: list, start: int) -> str:
    """What the entry of a list that begins at a line calls itself."""
    found = {}
    for line in lines[start + 1:]:
        if line.startswith("["):
            break
        if match := ASSIGNMENT.match(line):
            value = COMMENT.sub("", match.group(4)).strip().strip('"')
            found.setdefault(match.group(2), value)
    return found.get("name") or found.get("type") or ""


def _named(header: str, entry_of: dict) -> str:
    """[change.set] below [[change]] name = "x" is change.x.set."""
    for name, entry in entry_of.items():
        if header == name or header.startswith(name + "."):
            return ".".join(part for part in (name, entry, header[len(name) + 1:]) if part)
    return header


def scaled(value: str, factor: float) -> str:
    """The first number of a value times a factor; unit and quotes stay."""
    match = NUMBER.search(value)
    if not match:
        raise InputError(f"power.toml: {value!r} holds no number to multiply")
    return value[:match.start()] + f"{float(match.group()) * factor:.10g}" + value[match.end():]


def csv_edited(text: str, column: str, where: dict, change) -> tuple:
    """The text with one column changed in the rows where others have these values, and how many there were."""
    rows = list(csv.DictReader(io.StringIO(text)))
    if not rows or column not in rows[0] or any(name not in rows[0] for name in where):
        raise InputError(f"power.toml: no column {column}, or none of {', '.join(where)}")
    found = 0
    for row in rows:
        if all(row[name] == value for name, value in where.items()):
            row[column] = change(row[column])
            found += 1
    out = io.StringIO()
    writer = csv.DictWriter(out, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return out.getvalue(), found
