"""Manual pages (section 1) of the executables out of what they say of themselves: --help and --describe.

    python3 -m twindeck_reference.manual --bin build/bin --driver packaging/twindeck --version 1.0.0 --out build/man s1_model ...
"""
import argparse
import gzip
import re
import subprocess
import sys
from pathlib import Path

from .__main__ import described

DRIVER = "twindeck"
OPTION = re.compile(r"^  (\S.*?)(?:  +(\S.*))?$")
PLACES = [("workflows/STUDY/study.toml", "the study: its model, its measured features, its steps"),
          ("workflows/STUDY/{token}.toml", "the keys below"),
          ("results/STUDY/{token}/manifest.json", "inputs and outputs with their SHA-256, the resolved configuration, warnings; written last")]


def parts(text: str) -> dict:
    """The --help of an executable: {"summary", "usage", "options": [(option, meaning)], "examples": [line], "exit": text}."""
    blocks = text.strip().split("\n\n")
    summary, _, usage = blocks[0].partition("\nUsage: ")
    found = {"summary": summary.partition(": ")[2] or summary, "usage": usage.strip(), "options": [], "examples": [], "exit": ""}
    for block in blocks[1:]:
        head, _, body = block.partition("\n")
        if head == "Options:":
            found["options"] = options_of(body)
        elif head == "Examples:":
            found["examples"] = [line.strip() for line in body.splitlines()]
        elif head.startswith("Exit codes: "):
            found["exit"] = block.removeprefix("Exit codes: ").replace("\n", " ")
    return found


def options_of(body: str) -> list:
    """[(option, meaning)]; a meaning may begin on the line below its option."""
    found = []
    for line in body.splitlines():
        match = OPTION.match(line)
        if match:
            found.append([match.group(1), match.group(2) or ""])
        elif found:
            found[-1][1] = f"{found[-1][1]} {line.strip()}".strip()
    return [tuple(row) for row in found]


def escaped(text: str) -> str:
    """Text that roff sets as it stands: a minus stays a minus, and no line begins with a control character."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq").replace("…", "...")
    return "\\&" + text if text.startswith(".") else text


def page(token: str, said: dict, keys: list, version: str, others: list) -> str:
    """One page; `keys` are rows of `described`, empty for a program without a configuration."""
    lines = [f'.TH {token.upper()} 1 "" "twindeck {version}" "twindeck"', ".SH NAME", f"{token} \\- {escaped(_first_small(said['summary']))}", ".SH SYNOPSIS",
             f".B {escaped(said['usage'])}", ".SH DESCRIPTION", escaped(said["summary"])]
    if token != DRIVER:
        lines += [".P", "One of the programs of", ".BR twindeck (1).", "Files are described in /usr/share/doc/twindeck/docs."]
    lines += [".SH OPTIONS" if token != DRIVER else ".SH COMMANDS"]
    for option, meaning in said["options"]:
        lines += [".TP", f".B {escaped(option)}", escaped(meaning)]
    if keys:
        lines += [".SH CONFIGURATION", "Keys of the step's TOML file and of", ".BR \\-\\-set .", "A key with dots belongs to a table."]
        above = ""
        for depth, key, meaning, value in keys:
            above = key if depth == 0 else above
            lines += [".TP", f".B {escaped(key if depth == 0 else f'{above}.{key}')}", escaped(meaning), ".br", escaped(value.replace("; each element has", ""))]
        lines += [".SH FILES"]
        for place, meaning in PLACES:
            lines += [".TP", f".I {escaped(place.format(token=token))}", escaped(meaning)]
    if said["exit"]:
        lines += [".SH EXIT STATUS", escaped(said["exit"])]
    if said["examples"]:
        lines += [".SH EXAMPLES", ".nf", *map(escaped, said["examples"]), ".fi"]
    lines += [".SH SEE ALSO", ",\n".join(f".BR {name} (1)" for name in others).replace(",\n", " ,\n")]
    return "\n".join(lines) + "\n"


def _first_small(summary: str) -> str:
    """A sentence as roff's NAME has it: without its full stop, and small unless it begins with an abbreviation."""
    text = summary.strip().rstrip(".")
    return text[:1].lower() + text[1:] if text[1:2].islower() else text


def pages(bin_folder: Path, driver: Path, version: str, tokens: list) -> dict:
    """{name: text of its page}"""
    found = {}
    for token in [DRIVER, *tokens]:
        program = driver if token == DRIVER else bin_folder / token
        said = parts(subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout)
        keys = described(program) if re.match(r"s\d_", token) else []
        found[token] = page(token, said, keys, version, [name for name in [DRIVER, *tokens] if name != token])
    return found


def main(arguments) -> int:
    parser = argparse.ArgumentParser(prog="twindeck_reference.manual", description=__doc__)
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="folder of the executables")
    parser.add_argument("--driver", type=Path, default=Path("packaging/twindeck"), help="the command twindeck")
    parser.add_argument("--version", required=True, help="version that the pages name")
    parser.add_argument("--out", type=Path, required=True, help="folder to write NAME.1.gz into")
    parser.add_argument("tokens", nargs="+", help="executables")
    options = parser.parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    for name, text in pages(options.bin, options.driver, options.version, options.tokens).items():
        # no date in the compressed file: the same pages are the same bytes
        (options.out / f"{name}.1.gz").write_bytes(gzip.compress(text.encode("utf-8"), mtime=0))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
