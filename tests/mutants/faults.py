"""Faults that a numerical program may have, found in C++ text: a sign, an index, a factor of two, a transposition, a missing term.

A fault is one small change of one place. Places are looked for in code alone: not in comments, strings or preprocessor lines, and not in
lines that hold a string, which are messages. A fault that the compiler refuses is no mutant: who draws it draws anew.
"""
import dataclasses
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "architecture"))
from source_text import blanked  # noqa: E402

KINDS = ("sign", "index", "factor 2", "transposition", "missing term")
# One operand: a name, number or call with what hangs on it; brackets two deep.
BRACKETS = r"(?:\((?:[^()]|\([^()]*\))*\)|\[[^\[\]]*\])"
OPERAND = rf"(?:[\w.]|::|->|{BRACKETS})+"
PRODUCT = rf"{OPERAND}(?: [*/] {OPERAND})*"
PATTERNS = [  # (kind, what is looked for, what stands there instead)
    ("sign", re.compile(r"(?<=[\w)\]] )([+-])(?= [\w(-])"), lambda found: "-" if found[1] == "+" else "+"),
    ("sign", re.compile(r"(?<=[\w)\]] )([+-])(?== )"), lambda found: "-" if found[1] == "+" else "+"),
    ("sign", re.compile(r"(?:(?<=[=(,?:*] )|(?<=[(\[{])|(?<=return ))-(?=[A-Za-z_(])"), lambda found: ""),
    ("index", re.compile(rf"(?<=\w)\((\w+), (\w+)\)"), lambda found: f"({found[2]}, {found[1]})" if found[1] != found[2] else None),
    ("index", re.compile(r"(?<=[\w)\]])\[(\w+)\]"), lambda found: f"[{found[1]} + 1]"),
    ("index", re.compile(r"(?<=\w)\((\d)\)"), lambda found: f"({1 if found[1] == '0' else int(found[1]) - 1})"),
    ("index", re.compile(r"(?<=[(\[, ])(\w+) [+-] 1(?=[)\],])"), lambda found: found[1]),
    ("factor 2", re.compile(r"(?<![\w.])(\d+\.\d*(?:e[+-]?\d+)?)(?![\w.])"), lambda found: f"(2.0 * {found[1]})" if float(found[1]) else None),
    ("factor 2", re.compile(rf"(?<=return )({PRODUCT})(?=;)"), lambda found: None if found[1] in ("true", "false") else f"2.0 * ({found[1]})"),
    ("transposition", re.compile(r"\.transpose\(\)"), lambda found: ""),
    ("transposition", re.compile(r"\.adjoint\(\)"), lambda found: ""),
    ("missing term", re.compile(rf"(?<=[\w)\]]) [+-] {PRODUCT}(?=[;,)])"), lambda found: ""),
    ("missing term", re.compile(r"(?<=\n)( *)[\w.\[\]()>, -]+ [+*-]= [^;{}]*;"), lambda found: found[1] + ";"),
]
IN_A_FUNCTION = re.compile(r"\n[^\n ][^\n]*\{\n((?:(?:[ \t][^\n]*)?\n)*)")  # clang-format: bodies are indented, what stands in no body is not


@dataclasses.dataclass(frozen=True)
class Fault:
    file: str      # below the root
    begin: int     # of the place in the file's text
    end: int
    kind: str
    instead: str   # what stands there in the mutant

    def line(self, text):
        return text.count("\n", 0, self.begin) + 1

    def applied(self, text):
        return text[:self.begin] + self.instead + text[self.end:]

    def shown(self, text):
        """The line before and after, the place's line in words of the source."""
        start, stop = text.rindex("\n", 0, self.begin) + 1, text.index("\n", self.end)
        return text[start:stop].strip(), (text[start:self.begin] + self.instead + text[self.end:stop]).strip()


def faults(text, file=""):
    """Every fault of a C++ file's text that begins with a new line."""
    code = blanked(text)
    found = []
    for body in IN_A_FUNCTION.finditer(code):
        for kind, pattern, instead in PATTERNS:
            for place in pattern.finditer(code, *body.span(1)):
                start, stop = text.rindex("\n", 0, place.start()), text.index("\n", place.end())
                if '"' in text[start:stop] or text[start:stop] != code[start:stop].rstrip() and text[place.start():place.end()] != place[0]:
                    continue
                change = instead(place)
                if change is not None:
                    found.append(Fault(file, place.start(), place.end(), kind, change))
    return found


def faults_by_kind(root, files):
    """{kind: [Fault]} in the files below root, in the order of the files and of their text."""
    out = {kind: [] for kind in KINDS}
    for file in files:
        for fault in faults((root / file).read_text(), str(file)):
            out[fault.kind].append(fault)
    return out
