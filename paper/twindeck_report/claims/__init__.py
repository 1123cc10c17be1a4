"""data/<study>/paper/claims.csv: numbers that the paper states in its text, each with where it says so, of which kind ours is, and,
where no result of ours can be set beside it, why not. What is computed is compared or shown; nothing is filled."""
from dataclasses import dataclass

from ..cells import decimals, number
from ..errors import InputError
from ..study import Study
from ..tolerances import CARRIED, KINDS
from . import bridge, identification, updating, wind
from .nulls import NULLS, REPEATS

# claim -> (ours from the study's results, deviation that the printed text allows or None, why)
COMPUTED = {**bridge.COMPUTED, **identification.COMPUTED, **updating.COMPUTED, **wind.COMPUTED}
COLUMNS = ["claim", "value", "unit", "source", "kind"]


@dataclass
class Claim:
    name: str
    source: str  # where the paper says it
    kind: str
    unit: str
    paper: str
    ours: float | None  # None: not computed
    allowed: float | None  # None: shown beside the paper's, no claim of agreement
    basis: str  # why that much is allowed; of what is not computed, why not
    known: bool = False  # listed in known_deviations.toml
    repeats: str = ""  # the cell of a table, or the claim, that says the same number
    null: float | None = None  # what stands in the number's place if nothing is computed for it
    null_passes: bool = False
    simplest: str = ""  # as a cell's; no claim that is compared is recovered
    closer_than_simplest: bool = False

    @property
    def inside(self) -> bool:
        return self.holds(self.ours)

    def holds(self, value: float) -> bool:
        return abs(value - number(self.paper)) <= self.allowed * (1.0 + 1e-9)

    @property
    def independent(self) -> bool:
        """A computed number of its own that is compared."""
        return self.ours is not None and self.allowed is not None and self.kind not in CARRIED and not self.repeats

    @property
    def verdict(self) -> str:
        if self.ours is None:
            return "not computed"
        if self.allowed is None:
            return "shown, not compared"
        if self.known:
            return "stale entry" if self.inside else "known"
        return "inside" if self.inside else "outside"

    @property
    def shown(self) -> str:
        return "" if self.ours is None else f"{self.ours:.{decimals(self.paper)}f}"


def check_claims(study: Study, skip_missing: bool = False) -> list:
    """Empty when the study has no claims.csv. @param skip_missing  a claim whose step has not run counts as not computed"""
    path = study.data / "paper" / "claims.csv"
    if not path.is_file():
        return []
    table = study.read_csv(path, COLUMNS, text=True)
    repeated = table["claim"][table["claim"].duplicated()]
    if len(repeated):
        raise InputError(f"{path}: claim {repeated.iloc[0]} stands twice")
    return [_judged(study, _claim(study, path, row, skip_missing)) for row in table.to_dict("records")]


def _claim(study: Study, path, row: dict, skip_missing: bool) -> Claim:
    name = row["claim"]
    if row["kind"] not in KINDS:
        raise InputError(f"{path}: {name}: kind {row['kind']!r}; expected one of {', '.join(KINDS)}")
    compute, tolerance, basis = COMPUTED.get(name, (None, None, ""))
    if compute and number(row["value"]) is None:
        raise InputError(f"{path}: {name}: value {row['value']!r} is not a number")
    note = row.get("why_not", "")
    if compute is None and not note:
        raise InputError(f"{path}: {name}: no result of ours is known for it; say in why_not why there is none")
    try:
        ours = compute(study) if compute else None
    except InputError:
        if not skip_missing:
            raise
        ours = None
    allowed = None if ours is None or tolerance is None else tolerance(row["value"])
    return Claim(name, row["source"], row["kind"], row["unit"], row["value"], ours, allowed,
                 basis if ours is not None else note or "The step that gives it is not part of this study, or did not find it.",
                 repeats=REPEATS.get(name, ""))


def _judged(study: Study, claim: Claim) -> Claim:
    """Its null in its place; a claim that the null meets too is shown."""
    if claim.independent and claim.name in NULLS:
        value, meaning = NULLS[claim.name]
        claim.null = value(study) if callable(value) else value
        claim.null_passes = claim.null is not None and claim.holds(claim.null)
        if claim.null_passes:
            claim.allowed, claim.basis = None, f"Shown, not compared: {meaning} would pass. {claim.basis}"
    return claim
