"""table_NN.csv, .tex and .html: ours, and beside each compared column the paper's number and the kind of ours."""
import csv
import html
import re
import time
from pathlib import Path

import pandas as pd

from ..cells import csv_text, number, shown
from ..compare import row_names
from ..errors import InputError
from ..manifests import write_manifest
from ..study import Study
from ..tolerances import Tolerances, read_tolerances
from . import TABLES, paper_number, table_name


def write_tables(study: Study) -> list:
    """Every table of the study, then tables/manifest.json. Returns the names written."""
    started = time.monotonic()
    tolerances = read_tolerances(study)
    built = {number_: full_table(study, number_, tolerances) for number_ in TABLES}  # all or nothing
    folder = study.results / "tables"
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for number_, table in built.items():
        printed = study.paper_table(paper_number(number_))
        title = f"Table {str(number_).replace('_', ' ')}. {TABLES[number_].TITLE}{_note(study, TABLES[number_])}"
        name = folder / table_name(number_)
        write_csv(table, name.with_suffix(".csv"))
        name.with_suffix(".tex").write_text(latex(table, printed, title, f"tab:{table_name(number_)}", _numbered(number_)),
                                              encoding="utf-8")
        name.with_suffix(".html").write_text(html_table(table, printed, title), encoding="utf-8")
        written += [name.with_suffix(suffix) for suffix in (".csv", ".tex", ".html")]
    write_manifest("tables", folder, study.used, written, started)
    return [table_name(n) for n in built]


def _note(study: Study, module) -> str:
    """What a table's module has to add to its title from the results, in words that begin with a blank or a mark."""
    return module.note(study) if hasattr(module, "note") else ""


def full_table(study: Study, number_, tolerances: Tolerances) -> pd.DataFrame:
    """Ours in the paper's columns, then <column>_paper (as printed) and <column>_kind for each compared column."""
    printed = study.paper_table(paper_number(number_))
    name = table_name(number_)
    if name not in tolerances.columns:
        raise InputError(f"{study.data / 'tolerances.toml'}: no entry {name}; every table needs its rules")
    ours = TABLES[number_].build(study)
    if list(ours.columns) != list(printed.columns) or len(ours) != len(printed):
        raise InputError(f"{study.data / 'paper' / name}.csv: columns {', '.join(printed.columns)} ({len(printed)} rows) are "
                         f"not those of {name}: {', '.join(ours.columns)} ({len(ours)} rows)")
    table = ours.astype(object)
    for column, rule in tolerances.columns[name].items():
        if column not in printed.columns:
            raise InputError(f"{study.data / 'tolerances.toml'}: {name}.columns.{column}: no such column in the paper's table")
        table[f"{column}_paper"] = printed[column]
        # a cell that the paper leaves empty has nothing to be of a kind
        rows = row_names(printed, tolerances.keys[name])
        table[f"{column}_kind"] = [rule.kind_of(row) if text else "" for row, text in zip(rows, printed[column])]
    return table


def write_csv(table: pd.DataFrame, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(table.columns)
        writer.writerows([csv_text(cell) for cell in row] for row in table.itertuples(index=False))


def html_table(table: pd.DataFrame, printed: pd.DataFrame, title: str) -> str:
    """Ours at the paper's digits, the paper's number beside each compared one in grey, the kind as its tooltip."""
    head, body = [], []
    for column in printed.columns:
        head.append(f"<th>{html.escape(heading(column))}</th>")
        if f"{column}_paper" in table:
            head.append('<th class="paper">paper</th>')
    for i in range(len(table)):
        cells = []
        for column in printed.columns:
            kind = table[f"{column}_kind"][i] if f"{column}_kind" in table else ""
            text = shown(table[column][i], printed[column][i])
            css = ' class="number"' if number(text) is not None else ""
            hint = f' title="{kind}"' if kind else ""
            cells.append(f"<td{css}{hint}>{html.escape(text)}</td>")
            if f"{column}_paper" in table:
                cells.append(f'<td class="paper">{html.escape(printed[column][i])}</td>')
        body.append("<tr>" + "".join(cells) + "</tr>")
    kinds = "; ".join(f"{heading(c)}: {k}" for c, k in column_kinds(table, printed))
    return (f'<table class="paper-table">\n<caption>{html.escape(title)}<br><small>{html.escape(kinds)}</small></caption>\n'
            f"<thead><tr>{''.join(head)}</tr></thead>\n<tbody>\n" + "\n".join(body) + "\n</tbody>\n</table>\n")


def latex(table: pd.DataFrame, printed: pd.DataFrame, title: str, label: str = "", of_paper: str = "") -> str:
    """A booktabs table: ours, the paper's number in parentheses where it is another. `\\fitwidth` may be defined by the document that
    takes it in, to hold a wide table inside the page. `of_paper` is the number that the table shall bear."""
    lines, alignments = [], _alignments(printed)
    for i in range(len(table)):
        cells = []
        for column in printed.columns:
            text = tex(shown(table[column][i], printed[column][i]))
            repeats = number(printed[column][i]) is None and csv_text(table[column][i]) == printed[column][i]
            if f"{column}_paper" in table and printed[column][i] and not repeats:
                text += f" ({tex(printed[column][i])})"
            cells.append(re.sub(r"([,*/])", r"\1\\allowbreak{}", text) if "p{" in alignments[column] else text)
        lines.append("  " + " & ".join(cells) + r" \\")
    alignment = "".join(alignments.values())
    found = column_kinds(table, printed)
    one = {k for _, k in found}
    kinds = f"Every number: {one.pop()}" if len(one) == 1 else "; ".join(f"{heading(c)}: {k}" for c, k in found)
    caption = tex(f"{title.partition('. ')[2]}; in parentheses the paper's. {kinds}.")
    return "\n".join([
        r"\providecommand{\fitwidth}[1]{#1}",
        r"\begin{table}", *([f"  \\renewcommand{{\\thetable}}{{{of_paper}}}"] if of_paper else []), r"  \centering", f"  \\caption{{{caption}}}" + (f"\\label{{{label}}}" if label else ""),
        f"  \\fitwidth{{\\begin{{tabular}}{{{alignment}}}", r"  \toprule",
        "  " + " & ".join(tex(heading(c)) for c in printed.columns) + r" \\", r"  \midrule", *lines,
        r"  \bottomrule", r"  \end{tabular}}", r"\end{table}", ""])


def _numbered(number_) -> str:
    """12 -> 12; 12_quasi_steady -> 12 (quasi steady)."""
    first, _, rest = str(number_).partition("_")
    return f"{first} ({rest.replace('_', ' ')})" if rest else first


def _alignments(printed: pd.DataFrame) -> dict:
    """Numbers to the right, words to the left, long words in a column that breaks them; beside such a column long headings break too."""
    longest = {c: max((len(text) for text in printed[c]), default=0) for c in printed.columns}
    wide = max(longest.values()) > 60

    def one(column):
        if longest[column] > 24:
            return r">{\raggedright\arraybackslash}p{%dem}" % min(14, 6 + longest[column] // 8)
        if wide and len(heading(column)) > 12:
            return r">{\raggedright\arraybackslash}p{5em}"
        return "r" if any(number(text) is not None for text in printed[column]) else "l"

    return {column: one(column) for column in printed.columns}


def column_kinds(table: pd.DataFrame, printed: pd.DataFrame) -> list:
    """[(column, kinds)] of the compared columns."""
    return [(c, " and ".join(dict.fromkeys(k for k in table[f"{c}_kind"] if k))) for c in printed.columns
            if f"{c}_kind" in table and any(table[f"{c}_kind"])]


UNITS = ("kNs_per_m", "kN_per_m", "m_per_s", "Hz", "pct")


def heading(column: str) -> str:
    """f_N_Hz -> f_N (Hz)."""
    for unit in UNITS:
        if column.endswith("_" + unit):
            name, shown_unit = column[: -len(unit) - 1], {"pct": "%"}.get(unit, unit.replace("_per_", "/"))
            return f"{_words(name)} ({shown_unit})"
    return _words(column)


def _words(name: str) -> str:
    """Symbols keep their underscore (f_X, zeta), words lose it."""
    symbol, _, rest = name.partition("_without_") if "_without_" in name else name.partition("_with_")
    if rest:
        return f"{symbol} {'without' if '_without_' in name else 'with'} {rest}"
    return name if len(name) <= 4 else name.replace("_", " ")


SPECIAL = {**{c: "\\" + c for c in "&%$#_{}"}, "^": r"\textasciicircum{}", "~": r"\textasciitilde{}", "\\": r"\textbackslash{}",
           "°": r"$^\circ$", "²": "$^2$", "½": r"$\frac{1}{2}$", "₁": "$_1$", "₂": "$_2$",
           "ρ": r"$\rho$", "α": r"$\alpha$", "β": r"$\beta$", "ξ": r"$\xi$", "θ": r"$\theta$"}


def tex(text: str) -> str:
    return "".join(SPECIAL.get(character, character) for character in text)
