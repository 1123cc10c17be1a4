"""python3 -m twindeck_reference --bin build/bin --out docs/reference.md"""
import argparse
import csv
import re
import subprocess
import sys
import tomllib
from pathlib import Path

COLUMNS = Path(__file__).parent / "columns.toml"


def described(executable: Path, key: str = "") -> list:
    """[(indentation, key, meaning, what it may be)] as the executable describes itself."""
    text = subprocess.run([executable, "--describe", *([key] if key else [])], capture_output=True, text=True, check=True).stdout
    found, lines = [], text.splitlines()
    for line, below in zip(lines, lines[1:] + [""]):
        match = re.match(r"^((?:    )*)([A-Za-z_][\w.]*): (.*)$", line)
        if match and below.startswith(match.group(1) + "    "):
            found.append((len(match.group(1)) // 4, match.group(2), match.group(3), below.strip()))
    return found


def key_table(rows: list) -> list:
    lines = ["| key | meaning | value |", "|---|---|---|"]
    above = ""
    for depth, key, meaning, value in rows:
        above = key if depth == 0 else above
        name = key if depth == 0 else f"{above}.{key}"
        lines.append(f"| `{name}` | {_cell(meaning)} | {_cell(value.replace('; each element has', ''))} |")
    return lines


def column_meanings() -> dict:
    """{group: {column: meaning}}, one entry a column."""
    groups = tomllib.loads(COLUMNS.read_text(encoding="utf-8"))
    return {group: {column: meaning for names, meaning in rows.items() for column in names.split()} for group, rows in groups.items()}


def undescribed(folder: Path) -> list:
    """Columns of the CSV files below a folder that the reference does not tell about, but those named by a parameter."""
    known = {column for rows in column_meanings().values() for column in rows}
    found = []
    for file in sorted(folder.rglob("*.csv")):
        with file.open(encoding="utf-8", newline="") as stream:
            header = next(csv.reader(stream), [])
        parameters = _parameters(folder)
        found += [f"{file.relative_to(folder)}: {column}" for column in header if column not in known and column not in parameters]
    return found


def _parameters(folder: Path) -> set:
    names = set()
    for file in folder.rglob("model.toml"):
        names |= {p["name"] for p in tomllib.loads(file.read_text(encoding="utf-8")).get("parameter", [])}
    return names


def page(bin_folder: Path) -> str:
    steps = sorted(p for p in bin_folder.glob("s[0-9]*_*") if p.is_file())
    if not steps:
        raise SystemExit(f"twindeck_reference: no step in {bin_folder}; build first (make build)")
    lines = ["# Reference: configuration keys and columns of files", "",
             "Made by `make reference` from the programs' own tables of keys; the same text comes from `sN_token --describe`. A key with dots",
             "belongs to a table (`[band]`, `lowest = …`). Numbers may carry a unit (`\"210 GPa\"`); without one they are in the unit shown.", "",
             "## study.toml", "", *key_table(described(steps[0], "study.toml")), "",
             "## model.toml", "", *key_table(described(steps[0], "model.toml")), ""]
    for step in steps:
        lines += [f"## {step.name}.toml", "", *key_table(described(step)), ""]
    lines += ["## Columns of files", ""]
    for group, rows in column_meanings().items():
        lines += [f"### {group[:1].upper() + group[1:]}", "", "| column | meaning |", "|---|---|"]
        lines += [f"| `{column}` | {_cell(meaning)} |" for column, meaning in rows.items()] + [""]
    return "\n".join(lines)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def main(arguments) -> int:
    parser = argparse.ArgumentParser(prog="twindeck_reference", description=__doc__)
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="folder of the executables")
    parser.add_argument("--out", type=Path, help="file to write; the page is printed if there is none")
    options = parser.parse_args(arguments)
    text = page(options.bin)
    if options.out is None:
        print(text, end="")
        return 0
    options.out.parent.mkdir(parents=True, exist_ok=True)
    if not options.out.is_file() or options.out.read_text(encoding="utf-8") != text:
        options.out.write_text(text, encoding="utf-8")
    print(f"{options.out}: {text.count(chr(10))} lines")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
