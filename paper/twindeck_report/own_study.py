"""A study without a printed paper: an engineer's own structure. Tables of what the steps found, a report page, and a check of the
files' hashes in place of the comparison with a paper."""
import html
import time

import pandas as pd

from .cells import csv_text, number
from .figures import figures_of
from .manifests import stale_inputs, stale_outputs, write_manifest
from .page.complexity import complexity
from .page.layout import layout
from .page.mac import mac_matrices
from .page.parts import common_parts
from .page.pieces import image, quantities, render, text
from .page.quality import quality
from .page.reliability import reliability
from .page.source import read_source
from .page.spectra import spectra
from .study import Study
from .tables.writer import heading, write_csv
from .unchanged import changed_steps, step_folders

# file of a step -> (name of the table, what it shows)
TABLES = {
    "s1_model/modes.csv": ("modes", "Modes of the model"),
    "s2_sensors/setups.csv": ("setups", "Sensor setups, and the modes that each finds in a blind test of its own"),
    "s3_identification/modes.csv": ("identified_modes", "Modes identified from the records"),
    "s4_refinement/comparison.csv": ("comparison", "Model and measurement, before updating"),
    "s5_sensitivity/selection.csv": ("selection", "What the frequencies can tell about each parameter"),
    "s6_updating/parameters.csv": ("parameters", "Parameters after updating"),
    "s6_updating/comparison.csv": ("updated_comparison", "Model and measurement, before and after updating"),
    "s6_updating/leave_one_out.csv": ("left_out", "Each pair left out of the updating and predicted"),
    "s7_aerodynamics/critical.csv": ("critical", "Critical wind speeds"),
    "s8_validation/rms.csv": ("accelerations", "RMS of accelerations in wind, against the records"),
}
WHERE_ASKED = ("s6_updating/leave_one_out.csv",)  # files that a step writes where its configuration asks for it
NOT_OF_ANY_STUDY = ("published",)  # columns of a step's table that only a study with a paper fills
STATED_PAIRS = {"published": "stated"}  # how step 4 names pairs that study.toml or the configuration states
FLAGS = ("selected", "converged")  # columns of 0 and 1
LONG_TEXT = 30  # letters; a cell with more of them gets room, so that its row does not become a tower
# Figures on the page: what a picture shows that no other part of the page does. Name -> (title, caption).
FIGURES = {
    "sensitivity_map": ("Sensitivities", "Relative sensitivities d ln f / d ln p of the model's modes, exact derivatives. Parameters in blue were selected for updating; "
                        "the bars show each parameter's score."),
    "updating_history": ("The updating", "Cost and parameters, divided by the sizes of their initial values (by their ranges where those are 0), over the iterations of the best start. Grey: outside the bounds; red: parameters "
                         "that end on one. Dashed lines: the prestress was computed anew."),
}


def is_own(study: Study) -> bool:
    return not study.has_paper()


def write_own_tables(study: Study) -> list:
    started, written, names = time.monotonic(), [], []
    folder = study.results / "tables"
    folder.mkdir(parents=True, exist_ok=True)
    for file, (name, title) in TABLES.items():
        if not _has(study, file):
            continue
        table = CHANGES.get(file, lambda _, rows: rows)(study, study.step_csv(file)).astype(object)
        table = table.where(table.notna(), "").loc[:, lambda t: [c for c in t.columns if (t[c].astype(str) != "").any() and c not in NOT_OF_ANY_STUDY]]
        if "pairing" in table:
            table["pairing"] = table["pairing"].replace(STATED_PAIRS)
        write_csv(table, folder / f"{name}.csv")
        (folder / f"{name}.html").write_text(_html(table, title), encoding="utf-8")
        written += [folder / f"{name}.csv", folder / f"{name}.html"]
        names.append(name)
    by_condition = _by_condition(study)
    if by_condition is not None:
        write_csv(by_condition, folder / "identified_by_condition.csv")
        (folder / "identified_by_condition.html").write_text(_html(by_condition, "Modes identified, condition by condition"), encoding="utf-8")
        written += [folder / "identified_by_condition.csv", folder / "identified_by_condition.html"]
        names.append("identified_by_condition")
    write_manifest("tables", folder, study.used, written, started)
    return names


def _has(study: Study, file: str) -> bool:
    return file.split("/")[0] in study.steps() and (file not in WHERE_ASKED or (study.results / file).is_file())


def _with_blind_test(study: Study, setups):
    """Modes found by each setup that was tested, of how many, and what it found that is none."""
    tests = study.step_csv("s2_sensors/blind_test.csv", ["setup", "mode", "found"])
    modes = tests[tests["mode"] != "spurious"].groupby("setup")["found"]
    wrong = tests[tests["mode"] == "spurious"].groupby("setup").size()
    setups = setups[["setup", "family", "channels", "R_k", "rank"]]
    tested = setups["setup"].isin(modes.groups)
    found = setups["setup"].map(modes.sum()).where(tested)
    missed = tests[(tests["mode"] != "spurious") & (tests["found"] == 0)].groupby("setup")["mode"].agg(lambda m: " ".join(map(str, m)))
    return setups.assign(modes_found=found, of_modes=setups["setup"].map(modes.size()).where(tested), modes_missed=setups["setup"].map(missed).where(tested),
                         found_that_is_none=setups["setup"].map(wrong).where(tested).fillna(0).where(tested))


# What is left of a file in its table, and what joins it.
CHANGES = {"s2_sensors/setups.csv": _with_blind_test, "s8_validation/rms.csv": lambda _, rows: rows[rows["error_pct"].notna()]}


def _by_condition(study: Study):
    """The identified modes of every condition in one table; None where there is one condition only."""
    others = sorted((study.results / "s3_identification/conditions").glob("*/modes.csv")) if "s3_identification" in study.steps() else []
    if not others:
        return None
    first = study.step_csv("s3_identification/poles.csv", ["condition"])["condition"].iloc[0]
    columns = ["mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"]
    parts = [study.step_csv("s3_identification/modes.csv", columns)[columns].assign(condition=first)]
    parts += [study.read_csv(path, columns)[columns].assign(condition=path.parent.name) for path in others]
    return pd.concat(parts)[["condition", *columns]].astype(object)


def _html(table, title: str) -> str:
    head = "".join(f"<th>{html.escape(heading(c))}</th>" for c in table.columns)
    rows = "\n".join("<tr>" + "".join(map(_cell, row, table.columns)) + "</tr>" for row in table.itertuples(index=False))
    return f'<table class="paper-table"><caption>{html.escape(title)}</caption>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{rows}\n</tbody></table>\n'


def _cell(value, column: str) -> str:
    text = csv_text(value)
    if column in FLAGS and text in ("0", "1"):
        return f"<td>{'yes' if text == '1' else 'no'}</td>"
    if number(text) is None:
        kind = ' class="words"' if len(text) > LONG_TEXT else ""
        return f"<td{kind}>{html.escape(text)}</td>"
    digits = 2 if "_std_" in column else 5
    return f'<td class="number">{float(text):.{digits}g}</td>'


def write_own_report(study: Study):
    settings = study.read_toml(study.workflow / "study.toml")
    tables = [text(study, f"tables/{name}.html") for file, (name, _) in TABLES.items() if _has(study, file)]
    if (study.results / "tables/identified_by_condition.html").is_file():
        tables.append(text(study, "tables/identified_by_condition.html"))
    figures = [{"name": f.NAME, "title": FIGURES[f.NAME][0], "caption": FIGURES[f.NAME][1], "png": image(study, f.NAME)}
               for f in figures_of(study) if f.NAME in FIGURES and image(study, f.NAME)]
    page = render(
        "own_report.html.j2", **common_parts(study, settings), paper_sections=False, source=read_source(study), tables=tables,
        figures=figures, tiles=[], model=quantities(study, "s1_model/summary.csv"), updating=quantities(study, "s6_updating/summary.csv"),
        bounds=_on_bounds(study), layout=layout(study, settings), quality=quality(study), spectra=spectra(study), complexity=complexity(study),
        macs=mac_matrices(study), reliability=reliability(study))
    target = study.results / "report" / "report.html"
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(page, encoding="utf-8")
    return target


def _on_bounds(study: Study) -> list:
    if "s6_updating" not in study.steps():
        return []
    table = study.step_csv("s6_updating/parameters.csv", ["parameter", "bound"])
    return [f"{r['parameter']} ({r['bound']})" for r in table.to_dict("records") if r["bound"] in ("lower", "upper")]


def verify_own(study: Study) -> list:
    """What is wrong with the files, a line each; there are no printed tables to compare with."""
    tables = study.results / "tables"
    found = stale_outputs(tables) + changed_steps(study) + stale_inputs([*step_folders(study), tables])
    return [f"{path}: {problem}" for path, problem in found]
