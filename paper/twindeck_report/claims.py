"""claims.csv: numbers that the paper states in its text. Those that the steps of today can compute are compared; the others are
reported as not computed yet and never filled."""
from dataclasses import dataclass

from .cells import decimals, number
from .study import Study

FREQUENCY_TOLERANCE = 0.05  # as in Table 2: the preliminary model's section sizes are ours, fitted to those frequencies


@dataclass(frozen=True)
class Claim:
    name: str
    statement: str
    paper: str
    ours: float | None  # None: not computed yet
    allowed: float | None

    @property
    def verdict(self) -> str:
        if self.ours is None:
            return "not computed yet"
        return "inside" if abs(self.ours - number(self.paper)) <= self.allowed else "outside"

    @property
    def shown(self) -> str:
        return "" if self.ours is None else f"{self.ours:.{decimals(self.paper)}f}"


def check_claims(study: Study) -> list:
    """Empty when the study has no claims.csv."""
    path = next((p for p in (study.data / "paper/claims.csv", study.data / "claims.csv") if p.is_file()), None)
    if path is None:
        return []
    table = study.read_csv(path, ["claim", "value"], text=True)
    return [_claim(study, row) for row in table.to_dict("records")]


def _claim(study: Study, row: dict) -> Claim:
    compute = COMPUTED.get(row["claim"])
    ours = compute(study) if compute else None
    paper = number(row["value"])
    allowed = FREQUENCY_TOLERANCE * abs(paper) if ours is not None and paper is not None else None
    if paper is None:
        ours = None
    return Claim(row["claim"], row.get("statement") or row.get("what") or "", row["value"], ours, allowed)


def _tenth_frequency(study: Study):
    modes = study.step_csv("s1_model/modes.csv", ["mode", "frequency_Hz"])
    tenth = modes[modes["mode"] == 10]["frequency_Hz"]
    return float(tenth.iloc[0]) if len(tenth) else None


COMPUTED = {"tenth_preliminary_frequency": _tenth_frequency}
