"""How many independent computed numbers the check compares, by kind; apart from them what was carried over and what says a number
again."""
from collections import Counter
from dataclasses import dataclass

from .tolerances import CARRIED, KINDS


@dataclass(frozen=True)
class Counts:
    kinds: dict  # kind -> independent computed numbers compared
    inside: int
    known: int
    failing: int
    null_too: int  # inside, and a null would be as well: they tell nothing by themselves
    inputs: int  # compared, but carried over from the paper or arithmetic on it
    repetitions: int  # compared, but the number of another cell
    shown: int  # beside the paper's, no claim of agreement
    known_orders: int = 0  # orders that do not hold for a stated reason

    @property
    def independent(self) -> int:
        return sum(self.kinds.values())

    @property
    def told(self) -> str:
        kinds = ", ".join(f"{n} {kind}" for kind, n in self.kinds.items()) or "none"
        orders = f" and {self.known_orders} known order{'s' if self.known_orders > 1 else ''}" if self.known_orders else ""
        return (f"{self.independent} independent computed numbers compared ({kinds}): {self.inside} inside, {self.known} known deviations{orders}, "
                f"{self.failing} failing; {self.null_too} of those inside a null would meet as well")

    @property
    def apart(self) -> str:
        return f"apart from them {self.inputs} inputs carried over, {self.repetitions} repetitions, {self.shown} shown beside the paper's"


def count(cells: list, claims: list, orders: list = ()) -> Counts:
    """Cells of the tables and claims of the text together; orders that are known not to hold beside them."""
    judged = [c for c in [*cells, *claims] if c.verdict in ("inside", "outside", "known", "stale entry")]
    own = [c for c in judged if c.independent]
    found = Counter(c.kind for c in own)
    verdicts = Counter(c.verdict for c in own)
    return Counts({kind: found[kind] for kind in KINDS if found[kind]}, verdicts["inside"], verdicts["known"],
                  verdicts["outside"] + verdicts["stale entry"], sum(c.null_passes and c.verdict == "inside" for c in own),
                  sum(c.kind in CARRIED for c in judged), sum(bool(c.repeats) and c.kind not in CARRIED for c in judged),
                  sum(c.verdict in ("shown", "shown, not compared") for c in [*cells, *claims]),
                  sum(o.verdict == "known" for o in orders))
