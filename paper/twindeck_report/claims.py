"""claims.csv: numbers that the paper states in its text. Those that the steps of today can compute are compared; the others are
reported as not computed yet and never filled."""
from dataclasses import dataclass

from .cells import decimals, number
from .errors import InputError
from .study import Study
from .tolerances import KINDS


@dataclass(frozen=True)
class Claim:
    name: str
    source: str  # where the paper says it
    kind: str
    unit: str
    paper: str
    ours: float | None  # None: not computed yet
    allowed: float | None  # None: shown beside the paper's, no claim of agreement (kind virtual)
    basis: str

    @property
    def verdict(self) -> str:
        if self.ours is None:
            return "not computed yet"
        if self.allowed is None:
            return "shown, not compared"
        return "inside" if abs(self.ours - number(self.paper)) <= self.allowed else "outside"

    @property
    def shown(self) -> str:
        return "" if self.ours is None else f"{self.ours:.{decimals(self.paper)}f}"


def check_claims(study: Study) -> list:
    """Empty when the study has no claims.csv."""
    path = study.data / "paper" / "claims.csv"
    if not path.is_file():
        return []
    table = study.read_csv(path, ["claim", "value", "unit", "source", "kind"], text=True)
    return [_claim(study, path, row) for row in table.to_dict("records")]


def _claim(study: Study, path, row: dict) -> Claim:
    name, paper = row["claim"], number(row["value"])
    if paper is None:
        raise InputError(f"{path}: {name}: value {row['value']!r} is not a number")
    if row["kind"] not in KINDS:
        raise InputError(f"{path}: {name}: kind {row['kind']!r}; expected one of {', '.join(KINDS)}")
    compute, tolerance, basis = COMPUTED.get(name, (None, None, ""))
    ours = compute(study) if compute else None
    allowed = None if ours is None or tolerance is None else tolerance(row["value"])
    return Claim(name, row["source"], row["kind"], row["unit"], row["value"], ours, allowed, basis)


def _tenth_frequency(study: Study):
    modes = study.step_csv("s1_model/modes.csv", ["mode", "frequency_Hz"])
    tenth = modes[modes["mode"] == 10]["frequency_Hz"]
    return float(tenth.iloc[0]) if len(tenth) else None


def _mac_diagonal(study: Study):
    """Arithmetic on the printed Table 10: the mean over the pairs of its rows and columns, which stand in the same order."""
    table = study.paper_table(10)
    diagonal = [float(table.iloc[i, i + 1]) for i in range(len(table))]
    return sum(diagonal) / len(diagonal)


def _degrees_of_freedom(study: Study):
    table = study.step_csv("s1_model/summary.csv", ["quantity", "value"]).set_index("quantity")["value"]
    return float(table["degrees_of_freedom"]) if "degrees_of_freedom" in table.index else None


COMPUTED = {  # claim -> (ours, allowed deviation for the printed text, why)
    "preliminary_f10": (_tenth_frequency, lambda text: 0.05 * float(text),
                        "As in Table 2: section sizes of ours were fitted to the preliminary frequencies."),
    "mac_diagonal_mean_table_10": (_mac_diagonal, lambda text: 0.5 * 10.0 ** -decimals(text),
                                   "Arithmetic on printed numbers: rounding alone."),
    "degrees_of_freedom": (_degrees_of_freedom, None, "Another mesh: shown beside the paper's."),
}
