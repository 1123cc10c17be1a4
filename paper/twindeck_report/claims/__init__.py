"""data/<study>/paper/claims.csv: numbers that the paper states in its text, each with where it says so, of which kind ours is, and,
where no result of ours can be set beside it, why not. What is computed is compared or shown; nothing is filled."""
from dataclasses import dataclass

from ..cells import decimals, number
from ..errors import InputError
from ..known import LARGEST_SHARE, entries_of
from ..study import Study
from ..tolerances import KINDS
from . import bridge, identification, updating, wind

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

    @property
    def inside(self) -> bool:
        return abs(self.ours - number(self.paper)) <= self.allowed * (1.0 + 1e-9)

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


def check_claims(study: Study) -> list:
    """Empty when the study has no claims.csv."""
    path = study.data / "paper" / "claims.csv"
    if not path.is_file():
        return []
    table = study.read_csv(path, COLUMNS, text=True)
    repeated = table["claim"][table["claim"].duplicated()]
    if len(repeated):
        raise InputError(f"{path}: claim {repeated.iloc[0]} stands twice")
    claims = [_claim(study, path, row) for row in table.to_dict("records")]
    _mark_known(study, claims)
    return claims


def _claim(study: Study, path, row: dict) -> Claim:
    name = row["claim"]
    if row["kind"] not in KINDS:
        raise InputError(f"{path}: {name}: kind {row['kind']!r}; expected one of {', '.join(KINDS)}")
    compute, tolerance, basis = COMPUTED.get(name, (None, None, ""))
    if compute and number(row["value"]) is None:
        raise InputError(f"{path}: {name}: value {row['value']!r} is not a number")
    note = row.get("why_not", "")
    if compute is None and not note:
        raise InputError(f"{path}: {name}: no result of ours is known for it; say in why_not why there is none")
    ours = compute(study) if compute else None
    allowed = None if ours is None or tolerance is None else tolerance(row["value"])
    return Claim(name, row["source"], row["kind"], row["unit"], row["value"], ours, allowed,
                 basis if ours is not None else note or "The step that gives it is not part of this study, or did not find it.")


def _mark_known(study: Study, claims: list) -> None:
    path = study.data / "known_deviations.toml"
    by_name = {claim.name: claim for claim in claims if claim.allowed is not None}
    entries = entries_of(study, claims=True)
    for entry in entries:
        if entry["row"] not in by_name or entry["column"] != "value":
            raise InputError(f"{path}: claims {entry['row']} {entry['column']}: no compared claim of that name (column = \"value\")")
        claim = by_name[entry["row"]]
        claim.known, claim.basis = True, entry["reason"]
    comparable = sum(claim.kind != "input" for claim in by_name.values())
    if len(entries) > max(2, LARGEST_SHARE * comparable):
        raise InputError(f"{path}: {len(entries)} entries on claims; at most two, or a tenth of the {comparable} compared ones that are not "
                         f"inputs, may be listed")
