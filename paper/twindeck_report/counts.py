"""How many independent computed numbers the check compares, kind by kind, and what they are worth. A number that was recovered from records
whose truth was set to the paper's counts only where it is closer to the paper's than the simplest rule is. Apart from them: what was
carried over, and what says a number again."""
from dataclasses import dataclass

from .cells import csv_text, number
from .tolerances import CARRIED, KINDS

SAME_DIGITS = 12  # what files hold of a number: two of ours that agree so far are one
FEWEST_DIGITS = 7  # of a number that can be told by its digits; counts, signs and settings are the same by chance


@dataclass(frozen=True)
class OfKind:
    kind: str
    compared: int
    inside: int
    known: int
    failing: int
    null_too: int  # inside, and a null would be as well: they tell nothing by themselves
    closer: int | None  # recovered: inside and closer than the simplest rule; None: no such rule is known of this kind

    @property
    def told(self) -> str:
        simplest = "" if self.closer is None else f", {self.closer} of them closer than the simplest rule"
        return f"{self.kind} {self.inside} of {self.compared} inside{simplest}"


@dataclass(frozen=True)
class Counts:
    kinds: dict  # kind -> OfKind, the predicted first
    inputs: int  # compared, but carried over from the paper or arithmetic on it
    repetitions: int  # compared, but the number of another cell
    shown: int  # beside the paper's, no claim of agreement

    @property
    def independent(self) -> int:
        return self._sum("compared")

    @property
    def inside(self) -> int:
        return self._sum("inside")

    @property
    def known(self) -> int:
        return self._sum("known")

    @property
    def failing(self) -> int:
        return self._sum("failing")

    @property
    def null_too(self) -> int:
        return self._sum("null_too")

    @property
    def told(self) -> str:
        """What is read first: the numbers that nothing was fitted to. At most 25 words."""
        own = self.kinds.get("predicted")
        if own is None:
            return "No number is computed without a fit to the paper."
        rest = own.compared - own.inside
        missed = f"{rest} {'does' if rest == 1 else 'do'} not" + (", for reasons that are stated" if rest and not own.failing else "")
        return f"Of {own.compared} numbers computed without a fit to the paper, {own.inside} agree with it; {missed}."

    @property
    def by_kind(self) -> str:
        known = f"; {self.known} lie outside for stated reasons" if self.known else ""
        return "; ".join(kind.told for kind in self.kinds.values()) + known

    @property
    def apart(self) -> str:
        return f"apart from them {self.inputs} inputs carried over, {self.repetitions} repetitions, {self.shown} shown beside the paper's"

    def _sum(self, what: str) -> int:
        return sum(getattr(kind, what) for kind in self.kinds.values())


def count(cells: list, claims: list) -> Counts:
    """Cells of the tables and claims of the text together."""
    judged = [c for c in [*cells, *claims] if c.verdict in ("inside", "outside", "known", "stale entry")]
    own = [c for c in judged if c.independent]
    order = ("predicted", *(kind for kind in KINDS if kind != "predicted"))
    kinds = {kind: _of_kind(kind, part) for kind in order if (part := [c for c in own if c.kind == kind])}
    return Counts(kinds, sum(c.kind in CARRIED for c in judged), sum(bool(c.repeats) and c.kind not in CARRIED for c in judged),
                  sum(c.verdict in ("shown", "shown, not compared") for c in [*cells, *claims]))


def _of_kind(kind: str, own: list) -> OfKind:
    inside = [c for c in own if c.verdict == "inside"]
    with_rule = [c for c in own if c.simplest]
    return OfKind(kind, len(own), len(inside), sum(c.verdict == "known" for c in own),
                  sum(c.verdict in ("outside", "stale entry") for c in own), sum(c.null_passes for c in inside),
                  sum(c.closer_than_simplest for c in inside) if with_rule else None)


def mark_repetitions(cells: list, claims: list) -> None:
    """A computed number that agrees with an earlier one in all digits of the files follows from it: it repeats that one."""
    first = {}
    for c in [*cells, *claims]:
        text = csv_text(number(c.ours))
        if not c.independent or len(text.replace("-", "").replace(".", "").strip("0")) < FEWEST_DIGITS:
            continue
        if text in first:
            c.repeats = first[text]
        else:
            first[text] = c.name
