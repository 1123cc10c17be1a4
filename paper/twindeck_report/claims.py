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


def _aerodynamics(quantity: str):
    """A number of s7_aerodynamics/summary.csv, None where it was not computed."""
    def compute(study: Study):
        if "s7_aerodynamics" not in study.steps():
            return None
        table = study.step_csv("s7_aerodynamics/summary.csv", ["quantity", "value"]).set_index("quantity")["value"]
        return float(table[quantity]) if quantity in table.index else None
    return compute


def _critical(column: str, model: str = ""):
    """A column of s7_aerodynamics/critical.csv, stand-in set without dampers: of a model, or the least of Table 12's."""
    def compute(study: Study):
        if "s7_aerodynamics" not in study.steps():
            return None
        table = study.step_csv("s7_aerodynamics/critical.csv", ["set", "model", "dampers", column])
        table = table[(table["set"] == "standin") & (table["dampers"] == "off") & table[column].notna()].drop_duplicates("model")
        rows = table[table["model"] == model] if model else table[table["model"].isin(list("ACDGHI"))]
        return float(rows[column].min()) if len(rows) else None
    return compute


def _zero_crossing(study: Study):
    """Where mode 1's total damping passes through zero in the data of Fig. 20, between two speeds by a line."""
    if "s7_aerodynamics" not in study.steps():
        return None
    table = study.step_csv("s7_aerodynamics/damping.csv",
                           ["set", "model", "dampers", "structural_damping_pct", "mode", "V_m_s", "damping_ratio_pct"])
    table = table[(table["set"] == "standin") & (table["dampers"] == "off") & (table["mode"] == 1)]
    table = table[table["structural_damping_pct"] == table["structural_damping_pct"].min()]
    rows = list(zip(table["V_m_s"], table["damping_ratio_pct"]))
    for (v0, x0), (v1, x1) in zip(rows, rows[1:]):
        if x0 > 0 >= x1:
            return float(v0 + (v1 - v0) * x0 / (x0 - x1))
    return None


def _scaled(value, factor):
    return None if value is None else factor * value


SYNTHETIC = "The aerodynamic coefficients are synthetic: shown beside the paper's."

COMPUTED = {  # claim -> (ours, allowed deviation for the printed text, why)
    "preliminary_f10": (_tenth_frequency, lambda text: 0.05 * float(text),
                        "As in Table 2: section sizes of ours were fitted to the preliminary frequencies."),
    "mac_diagonal_mean_table_10": (_mac_diagonal, lambda text: 0.5 * 10.0 ** -decimals(text),
                                   "Arithmetic on printed numbers: rounding alone."),
    "eq_7_displacement": (lambda study: _scaled(_aerodynamics("static_displacement_G_H")(study), 1e3), None, SYNTHETIC),
    "eq_7_rotation": (_aerodynamics("static_rotation_G_H"), None, SYNTHETIC),
    "least_damping_with_dampers": (_aerodynamics("least_damping_with_dampers_standin"), None,
                                   "Positions of the dampers are reconstructed and the aerodynamic set is synthetic."),
    "galloping_speed_fig_20": (_zero_crossing, lambda text: 1.0, "'About 24 m/s': the speed is fitted; the data step by 1 m/s."),
    "f_cr_over_f1_orthogonal_wind": (_critical("f_cr_over_f1", "A"), lambda text: 0.007,
                                     "The range of the ratio over Table 12 and on a prototype's structure."),
    "f_cr_over_f1_wind_Y": (_critical("f_cr_over_f1", "G"), lambda text: 0.007,
                            "The range of the ratio over Table 12 and on a prototype's structure."),
    "critical_speed_least_model_A": (_critical("V_cr_m_s"), lambda text: 0.01 * float(text),
                                     "The least of the six models; its level was fitted to this speed: 1 %."),
    "degrees_of_freedom": (_degrees_of_freedom, None, "Another mesh: shown beside the paper's."),
}
