"""Numbers and verdicts in the guides and in README.md, held by the results that they tell. What is held stands between two marks that a
reader does not see:

    <!--=ponte_del_mare/s6_updating/leave_one_out.csv error_predicted_pct mean_abs digits=1-->5.0<!--/--> %

The mark names a file below results/ (or one that begins with data/), a column of a CSV file or a path into a JSON file
(`effects[0].cause`, `account[kind=dampers].text`), which rows (`key=value`, none: all), what is taken of them (the one row, or `mean`, `mean_abs`, `rms`, `min`, `max`,
`max_abs`, `count`), whether each is first taken as its deviation from the paper's in per cent (`to_paper`, in tables/), and how it is written
(`digits=N` decimals, `factor=X` of the unit, `signed`; text as it stands). `make verify` fails where a mark says another thing than its
file, `make prose` writes what the files say."""
import json
import re
import shlex
from dataclasses import dataclass
from pathlib import Path

from .cells import number
from .errors import InputError
from .study import Study

MARK = re.compile(r"<!--=(.*?)-->(.*?)<!--/-->", re.DOTALL)
GUIDES = ("README.md", "docs/*.md", "docs/decisions/*.md")
TAKEN = {
    "mean": lambda v: sum(v) / len(v),
    "mean_abs": lambda v: sum(map(abs, v)) / len(v),
    "rms": lambda v: (sum(x * x for x in v) / len(v)) ** 0.5,
    "min": min,
    "max": max,
    "max_abs": lambda v: max(map(abs, v)),
}
MANNERS = ("signed", "to_paper")
WRITTEN = ("digits", "factor")  # of the words with "=", those that are no condition on a row


@dataclass(frozen=True)
class Mark:
    guide: Path
    line: int
    rule: str
    says: str

    @property
    def file(self) -> str:
        return self.rule.split()[0]


def marks(guide: Path) -> list:
    text = guide.read_text(encoding="utf-8")
    return [Mark(guide, text.count("\n", 0, found.start()) + 1, found[1], found[2]) for found in MARK.finditer(text)]


def check_prose(study: Study, root: Path = Path(".")) -> list:
    """A line for each mark on this study's files, or on its virtual campaign's, that says another thing than they do."""
    wrong = []
    for mark in _own_marks(study, root):
        holds = held(study, mark)
        if " ".join(mark.says.split()) != holds:
            wrong.append(f"{mark.guide.as_posix()}:{mark.line}: says '{' '.join(mark.says.split())}', {mark.rule} is '{holds}'; run `make prose`")
    return wrong


def write_prose(study: Study, root: Path = Path(".")) -> list:
    """Puts into the guides what their files say. @return the guides that changed"""
    changed = []
    for guide in {mark.guide: None for mark in _own_marks(study, root)}:
        before = guide.read_text(encoding="utf-8")

        def put(found, guide=guide):
            mark = Mark(guide, 0, found[1], found[2])
            own = _is_of(study, mark) and " ".join(mark.says.split()) != held(study, mark)
            return f"<!--={mark.rule}-->{held(study, mark)}<!--/-->" if own else found[0]

        after = MARK.sub(put, before)
        if after != before:
            guide.write_text(after, encoding="utf-8")
            changed.append(guide)
    return changed


def held(study: Study, mark: Mark) -> str:
    """@throws InputError  where the mark names what is not there"""
    where = f"{mark.guide.as_posix()}:{mark.line}"
    words = shlex.split(mark.rule)
    if len(words) < 2:
        raise InputError(f"{where}: '{mark.rule}': expected a file and a column")
    file, column, rest = words[0], words[1], words[2:]
    pairs = dict(word.split("=", 1) for word in rest if "=" in word)
    taken = [word for word in rest if "=" not in word]
    unknown = [word for word in taken if word not in (*TAKEN, "count", *MANNERS)]
    if unknown:
        raise InputError(f"{where}: '{unknown[0]}'; expected one of {', '.join([*TAKEN, 'count', *MANNERS])}")
    conditions = {k: v for k, v in pairs.items() if k not in WRITTEN}
    values = _values(study, where, _path(study, file), column, conditions)
    if "to_paper" in taken:
        printed = _values(study, where, _path(study, file), f"{column}_paper", conditions)
        values = [100.0 * (float(ours) / float(theirs) - 1.0) for ours, theirs in zip(values, printed)]
    return _written(where, values, [word for word in taken if word not in MANNERS], pairs, "signed" in taken)


def _written(where: str, values: list, taken: list, pairs: dict, signed: bool) -> str:
    if "count" in taken:
        return str(len(values))
    if taken:
        numbers = [number(v) for v in values if number(v) is not None]
        if not numbers:
            raise InputError(f"{where}: no number to take the {taken[0]} of")
        values = [TAKEN[taken[0]](numbers)]
    if len(values) != 1:
        raise InputError(f"{where}: {len(values)} rows; name one, or what is taken of them ({', '.join(TAKEN)}, count)")
    if "digits" not in pairs or number(values[0]) is None:
        return " ".join(str(values[0]).split())
    value = float(pairs.get("factor", 1.0)) * number(values[0])
    return f"{value:{'+' if signed else ''},.{int(pairs['digits'])}f}"


def _values(study: Study, where: str, path: Path, column: str, conditions: dict) -> list:
    if path.suffix != ".json":
        table = study.read_csv(path, [column, *conditions], text=True)
        return [row[column] for row in table.to_dict("records") if all(row[k] == v for k, v in conditions.items())]
    if not path.is_file():
        raise InputError(f"{where}: {path.as_posix()}: missing; run the step that writes it")
    found = json.loads(path.read_text(encoding="utf-8"))
    for part in re.findall(r"[^.\[\]]+", column):
        try:
            found = _step_into(found, part)
        except (KeyError, IndexError, ValueError, TypeError, StopIteration):
            raise InputError(f"{where}: {path.as_posix()} has no {column}") from None
    return found if isinstance(found, list) else [found]


def _step_into(found, part: str):
    """The entry of a table by its key, of a list by its position or by what one of its keys holds (`kind=dampers`)."""
    if not isinstance(found, list):
        return found[part]
    key, _, value = part.partition("=")
    return next(entry for entry in found if str(entry[key]) == value) if value else found[int(part)]


def _path(study: Study, file: str) -> Path:
    return Path(file) if file.startswith("data/") else study.results.parent / file


def _own_marks(study: Study, root: Path) -> list:
    guides = [path for pattern in GUIDES for path in sorted(root.glob(pattern))]
    return [mark for guide in guides for mark in marks(guide) if _is_of(study, mark)]


def _is_of(study: Study, mark: Mark) -> bool:
    return mark.file.startswith((f"{study.name}/", f"{study.name}_virtual/", f"data/{study.name}/"))
