"""Which modes of several states are one mode. Step 3 numbers the modes of each state from one: where it misses a mode in one of them, equal numbers are
different modes. Measured shapes tell; where there are none, names stand."""
from dataclasses import dataclass, field
from math import log

import numpy as np

from .mac import mac

ALIKE = 0.5  # MAC from which on two shapes can be those of one mode
FEWEST = 3  # channels that both shapes have: on fewer, shapes of different modes are alike by chance
FURTHEST = 0.3  # logarithm of the ratio of frequencies: modes of different names further apart are not one, however alike on few sensors
NEAR = 0.05  # the same, of modes of one name whose shapes are not alike: close modes mix, and either may be measured as the sum of both
DOUBTFUL = 0.1  # the same, of modes of one name without shapes
OF_ONE_NAME = 0.1  # MAC by which a mode of another name has to be more alike


@dataclass
class Line:
    """A mode in the states that have it."""
    mode: str  # its name in the first of them
    label: str
    at: dict  # state -> Told
    notes: list = field(default_factory=list)  # what the reader has to know about the cells

    @property
    def weight(self) -> float:
        return max(r.weight for r in self.at.values())


def lines_of(rows: list, shapes: dict) -> list:
    """`rows`: of Told; `shapes`: (mode, state) -> complex measured components by channel."""
    lines = []
    for state in dict.fromkeys(r.state for r in rows):
        here = list({r.mode: r for r in rows if r.state == state}.values())
        paired = _paired(lines, here, shapes)
        before = len(lines)
        for row in here:
            if row.mode in paired:
                line = lines[paired[row.mode]]
                line.notes += _of_a_pair(line, row, shapes)
                line.at[state] = row
            else:
                taken = any(line.mode == row.mode for line in lines[:before])
                lines.append(Line(row.mode, f"{row.mode} ({state.replace('_', ' ')})" if taken else row.mode, {state: row}))
        for line in lines[:before]:
            other = next((r for r in here if r.mode == line.mode), None)
            if other is not None and state not in line.at:
                line.notes.append(_of_none(line, other, here, shapes))
    return lines


def _paired(lines: list, here: list, shapes: dict) -> dict:
    """mode of `here` -> number of its line; the most alike first, then what has one name and nearly one frequency."""
    likeness, left = {}, []
    for i, line in enumerate(lines):
        for row in here:
            found, apart, named = _mac(_first(line), row, shapes), _apart(_first(line), row), line.mode == row.mode
            if found is None:
                if named:
                    likeness[i, row.mode] = 1.0
            elif found >= ALIKE and (named or apart <= FURTHEST):
                likeness[i, row.mode] = found - apart + (OF_ONE_NAME if named else 0.0)
            elif named and apart <= NEAR:
                left.append((i, row.mode))
    paired = {}
    for i, mode in [*sorted(likeness, key=lambda key: -likeness[key]), *left]:
        if mode not in paired and i not in paired.values():
            paired[mode] = i
    return paired


def _first(line: Line):
    return next(iter(line.at.values()))


def _apart(a, b) -> float:
    return abs(log(b.measured / a.measured)) if a.measured > 0.0 and b.measured > 0.0 else 0.0


def _mac(a, b, shapes: dict) -> float | None:
    """None where the shapes have too few channels in common."""
    p, q = (shapes.get((r.mode, r.state), {}) for r in (a, b))
    both = [c for c in p if c in q]
    return mac(np.array([p[c] for c in both]), np.array([q[c] for c in both])) if len(both) >= FEWEST else None


def _of_a_pair(line: Line, row, shapes: dict) -> list:
    first = _first(line)
    found = _mac(first, row, shapes)
    if row.mode != line.mode:
        return [f"{_name(row)} is mode {line.mode} of {_state(first)} by its shape (MAC {found:.2f})"]
    if found is None:
        apart = _apart(first, row)
        return [f"mode {row.mode} may be another one in {_state(row)} than in {_state(first)}: its frequency is {abs(row.measured / first.measured - 1.0):.0%} off, and no shapes tell"
                .replace("%", " %")] if apart > DOUBTFUL else []
    return [f"the shapes of mode {row.mode} in {_state(first)} and {_state(row)} are little alike (MAC {found:.2f})"] if found < ALIKE else []


def _of_none(line: Line, named, here: list, shapes: dict) -> str:
    found = [m for r in here if (m := _mac(_first(line), r, shapes)) is not None]
    own = _mac(_first(line), named, shapes)
    return (f"no mode of {_state(named)} is mode {line.mode} of {_state(_first(line))} (MAC {f'{own:.2f} with' if own is not None else 'unknown of'} its mode {named.mode}"
            f"{f', {max(found):.2f} at most' if found else ''})")


def _name(row) -> str:
    return f"mode {row.mode} of {_state(row)}"


def _state(row) -> str:
    return row.state.replace("_", " ")
