"""What a record holds, as `s3_identification --inspect FILE` tells it."""
import math
import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

from .errors import InputError

ROW = re.compile(r"^(?P<name>.*\S)\s+(?P<unit>\S+)\s+(?P<samples>\d+)\s+\d+\s+\d+\s+\d+\s+(?P<mean>NUMBER)\s+NUMBER(\s.*)?$".replace("NUMBER", r"(?:[-+]?[0-9.]+(?:e[-+]?\d+)?|[-+]?(?:nan|inf))"))
UNNAMED = re.compile(r"column \d+$")  # how the step names a column that the file does not
CELSIUS = re.compile(r"(°|deg|grad)? ?(c|celsius)", re.IGNORECASE)
RATE = re.compile(r"rate\s+([0-9.eE+-]+) Hz")


@dataclass(frozen=True)
class Record:
    file: Path
    rate_Hz: float | None  # None where the file does not tell it
    columns: tuple  # names in the file
    units: tuple  # "?" where the file does not tell one
    samples: int  # lines of frequency response functions
    temperature_C: float | None = None  # mean of a column in degrees Celsius, which is no channel
    responses: bool = False  # frequency response functions of a hammer test: no rate

    @property
    def named(self) -> bool:
        return not all(UNNAMED.match(c) for c in self.columns)


def inspected(bin_folder: Path, file: Path) -> Record:
    """@throws InputError  with the step's own line where the file cannot be read"""
    run = subprocess.run([str(bin_folder / "s3_identification"), "--inspect", str(file)], capture_output=True, text=True, check=False)
    if run.returncode:
        raise InputError((run.stderr.strip().splitlines() or [f"{file}: it cannot be read"])[-1])
    return read(file, run.stdout.splitlines())


def read(file: Path, lines: list) -> Record:
    start = next((i for i, line in enumerate(lines) if line.startswith("channel ")), None)
    if start is None:
        raise InputError(f"{file}: no channel is found in it")
    rows = [found for line in lines[start + 1:] if (found := ROW.match(line)) and not line.startswith("missing ")]
    if not rows:
        raise InputError(f"{file}: no channel is found in it")
    rate = next((float(found[1]) for line in lines[:start] if (found := RATE.match(line))), None)
    warm = [r for r in rows if CELSIUS.fullmatch(r["unit"]) and not UNNAMED.match(r["name"])]
    rows = [r for r in rows if r not in warm] or rows
    responses = any(line.startswith("functions ") for line in lines[:start])
    temperature_C = next((mean for r in warm if math.isfinite(mean := float(r["mean"]))), None)
    return Record(file, rate, tuple(r["name"] for r in rows), tuple(r["unit"] for r in rows), max(int(r["samples"]) for r in rows), temperature_C, responses)
