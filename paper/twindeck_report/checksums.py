"""data/SHA256SUMS: the input files of the study of the paper as they were when the results were last accepted, in the form of `sha256sum`. A file
that was changed by accident is named; a wrong number in a file that was listed anew is what laws and the comparison are for."""
from pathlib import Path

from .errors import InputError
from .manifests import sha256
from .study import Study

NAME = "SHA256SUMS"
# What judges results is no input of theirs.
RULES = ("README.md", NAME, "tolerances.toml", "known_deviations.toml", "errata.toml", "orders.toml", "conclusions.toml", "held.toml", "power.toml",
         "ratchet_baseline.csv", "ratchet_moves.csv")


SHARED = ("wind",)  # folders beside the study's own that it reads


def input_files(study: Study) -> list:
    folders = [study.data, *(study.data.parent / name for name in SHARED)]
    return sorted(p for folder in folders for p in folder.rglob("*") if p.is_file() and p.name not in RULES and "__pycache__" not in p.parts)


def write_checksums(study: Study) -> str:
    folder = study.data.parent
    files = input_files(study)
    (folder / NAME).write_text("".join(f"{sha256(p)}  {p.relative_to(folder).as_posix()}\n" for p in files), encoding="utf-8")
    return f"{folder / NAME}: {len(files)} input files"


def changed_inputs(study: Study) -> list:
    """[(file, what is wrong)] for the study's input files; empty without a list."""
    folder, path = study.data.parent, study.data.parent / NAME
    if not path.is_file():
        return []
    listed, files = _read(path), input_files(study)
    mend = f"run `make checksums` if it is meant to be another than {NAME} lists"
    found = [(folder / name, f"missing, but {NAME} lists it") for name in listed if folder / name not in files]
    found += [(p, f"changed: {mend}") for p in files if (name := p.relative_to(folder).as_posix()) in listed and sha256(p) != listed[name]]
    found += [(p, f"new: {mend}") for p in files if p.relative_to(folder).as_posix() not in listed]
    return found


def _read(path: Path) -> dict:
    listed = {}
    for i, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        digest, _, name = line.partition("  ")
        if len(digest) != 64 or not name:
            raise InputError(f"{path}: line {i}: expected a SHA-256, two blanks and a file, as `make checksums` writes them")
        listed[name] = digest
    return listed
