"""What each compared column is judged with in place of ours: numbers that need none of the work that the column stands for. A column
whose null meets the paper as well as its tolerance asks for proves nothing, so it is shown and not compared."""
from dataclasses import dataclass

from .cells import csv_text, number
from .compare import judge, load_paper, rms_of
from .errors import InputError
from .study import Study
from .tolerances import Tolerances

LEAST_FAILING_SHARE = 1 / 3  # of a column's cells that its null must fail, unless it fails the column's rms limit: DESIGN section 5


@dataclass(frozen=True)
class NullVerdict:
    table: str
    column: str
    null: str  # its name in tolerances.toml
    meaning: str
    cells: int  # that it puts a number into
    passed: int  # of these inside the tolerance
    rms: float | None
    limit: float | None  # of the column's rms rule

    @property
    def passes(self) -> bool:
        """Neither beyond the rms limit nor outside in a third of the cells."""
        beyond = self.limit is not None and self.rms is not None and self.rms > self.limit
        return not beyond and self.cells - self.passed < LEAST_FAILING_SHARE * self.cells


def _modes(study: Study, step: str) -> dict:
    table = study.step_csv(f"{step}/modes.csv", ["mode", "frequency_Hz"])
    return {str(int(mode)): float(f) for mode, f in zip(table["mode"], table["frequency_Hz"])}


def _refined_model(study, paper, column):
    found = _modes(study, "s4_refinement")
    return {row: found.get(row) for row in paper.index}


def _preliminary_model(study, paper, column):
    found = _modes(study, "s1_model")
    return {row: found.get(partner.removesuffix("N")) for row, partner in paper["numerical_mode"].items()}


def _model_as_designed(study, paper, column):
    table = study.step_csv("s4_refinement/comparison.csv", ["stage", "experimental_mode", "computed_Hz"])
    own = table[table["stage"] == "refined"].drop_duplicates("experimental_mode").set_index("experimental_mode")["computed_Hz"]
    return {row: float(own[f"{row}X"]) if f"{row}X" in own.index else None for row in paper.index}


def _one_value(study, paper, column):
    printed = [number(text) for text in paper[column] if number(text) is not None]
    return dict.fromkeys(paper.index, sum(printed) / len(printed))


def _other_case(study, paper, column):
    return {row: number(paper.at[other, column]) if (other := _opposite(row)) in paper.index else None for row in paper.index}


def _opposite(row: str) -> str:
    return row.replace("without_", "with_", 1) if row.startswith("without_") else row.replace("with_", "without_", 1)


def _row_a(study, paper, column):
    table = study.step_csv("tables/table_12.csv", ["ns", column], text=True).set_index("ns")
    return dict.fromkeys(paper.index, number(table.at["A", column]) if "A" in table.index else None)


def _still_air(study, paper, column):
    table = study.step_csv("s7_aerodynamics/summary.csv", ["quantity", "value"]).set_index("quantity")["value"]
    return dict.fromkeys(paper.index, float(table["still_air_frequency_1"]) if "still_air_frequency_1" in table.index else None)


NULLS = {
    "refined_model": (_refined_model, "the refined model's mode of the same number"),
    "preliminary_model": (_preliminary_model, "the preliminary model's mode of the same number"),
    "model_as_designed": (_model_as_designed, "the refined model's frequency of the same pair, without any test"),
    "one_value": (_one_value, "the mean of the printed column in every row"),
    "other_case": (_other_case, "the same stay's printed number with sleeves for that without, and the other way round"),
    "row_A": (_row_a, "wind across the deck (row A) in every row"),
    "still_air": (_still_air, "the first frequency without wind in every row"),
}


def judge_nulls(study: Study, tolerances: Tolerances, cells: list) -> list:
    """Puts each column's null into its cells (`null`, `null_passes`); what has nothing to show against it is shown from here on.
    @return the verdicts, one a column with a null"""
    verdicts = [_judge(study, tolerances, rule, cells)
                for rules in tolerances.columns.values() for rule in rules.values() if rule.null and rule.rule != "shown"]
    demoted = {f"{v.table}.{v.column}": v for v in verdicts if v.passes}
    for cell in cells:
        rule = tolerances.columns.get(cell.table, {}).get(cell.column)
        verdict = demoted.get(f"{cell.table}.{cell.column}") or (demoted.get(rule.repeats) if rule and cell.repeats else None)
        if verdict:
            cell.shown, cell.allowed = True, None
            cell.basis = f"Shown, not compared: {verdict.meaning} would pass ({verdict.passed} of {verdict.cells} cells). {cell.basis}"
    return verdicts


def _judge(study: Study, tolerances: Tolerances, rule, cells: list) -> NullVerdict:
    if rule.null not in NULLS:
        raise InputError(f"{study.data / 'tolerances.toml'}: {rule.table}.columns.{rule.name}: null {rule.null!r}; expected one of "
                         f"{', '.join(NULLS)}")
    compute, meaning = NULLS[rule.null]
    paper = load_paper(study, rule.table, tolerances.keys[rule.table])
    own = [c for c in cells if c.table == rule.table and c.column == rule.name and number(c.paper) is not None]
    values = compute(study, paper, rule.name) if own else {}
    told = [c for c in own if values.get(c.row) is not None]
    for cell in told:
        cell.null = csv_text(values[cell.row])
        cell.null_passes = judge(rule, tolerances.columns[rule.table], cell.row, cell.paper, cell.null, paper).inside
    limit = next((r.limit for r in tolerances.rms if (r.table, r.column) == (rule.table, rule.name)), None)
    return NullVerdict(rule.table, rule.name, rule.null, meaning, len(told), sum(c.null_passes for c in told),
                       rms_of(told, rule.table, rule.name, null=True), limit)
