"""report/deviations.csv, nulls.csv, claims.csv, statements.csv, deviations.md and junit.xml: the check's result for a spreadsheet, a
reader and a CI server."""
import csv
from pathlib import Path
from xml.etree import ElementTree

from .cells import csv_text, number
from .check import CheckResult, explain, percent
from .compare import row_for_csv
from .conclusions import summed_up

HEADER = ["table", "row", "column", "paper", "ours", "deviation", "allowed", "used_pct", "kind", "verdict", "basis"]
SIMPLEST = ["table", "row", "column", "paper", "ours", "simplest_rule", "closer"]
KIND_HEADER = ["kind", "compared", "inside", "known", "failing", "a null would meet too", "closer than the simplest rule"]
CONCLUSIONS = ["statement", "where", "verdict", "why"]
STATEMENTS = ["statement", "where", "found", "verdict"]

NULLS = ["table", "column", "null", "meaning", "cells", "passed", "rms", "limit", "verdict"]
CLAIM_HEADER = ["claim", "section", "unit", "paper", "ours", "deviation", "allowed", "kind", "verdict", "basis"]


def claim_row(claim) -> list:
    paper = number(claim.paper)
    deviation = None if claim.ours is None or paper is None else claim.ours - paper
    return [claim.name, claim.source, claim.unit, claim.paper, csv_text(claim.ours), csv_text(deviation), csv_text(claim.allowed), claim.kind,
            claim.verdict, claim.basis]


def null_row(verdict) -> list:
    return [verdict.table, verdict.column, verdict.null, verdict.meaning, verdict.cells, verdict.passed, csv_text(verdict.rms),
            csv_text(verdict.limit), "shown" if verdict.passes else "compared"]


def write_deviations(result: CheckResult, conclusions: list, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "deviations.csv").open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(HEADER)
        writer.writerows(row_for_csv(cell) for cell in result.cells)
    with (folder / "nulls.csv").open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(NULLS)
        writer.writerows(null_row(verdict) for verdict in result.nulls)
    with (folder / "claims.csv").open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(CLAIM_HEADER)
        writer.writerows(claim_row(claim) for claim in result.claims)
    with (folder / "statements.csv").open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(STATEMENTS)
        writer.writerows([s.statement, s.source, s.found, s.verdict] for s in result.statements)
    with (folder / "simplest.csv").open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(SIMPLEST)
        writer.writerows(simplest_rows(result))
    with (folder / "conclusions.csv").open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(CONCLUSIONS)
        writer.writerows(conclusion_row(c) for c in conclusions)
    (folder / "deviations.md").write_text(markdown(result, conclusions), encoding="utf-8")
    ElementTree.indent(tree := junit(result))
    tree.write(folder / "junit.xml", encoding="utf-8", xml_declaration=True)


def kind_rows(result: CheckResult) -> list:
    return [[k.kind, k.compared, k.inside, k.known, k.failing, k.null_too, "" if k.closer is None else k.closer] for k in result.counts.kinds.values()]


def simplest_rows(result: CheckResult) -> list:
    """Recovered numbers beside what the simplest rule gives, those that it does not beat first."""
    own = [c for c in result.cells if c.simplest and c.independent]
    return [[c.table, c.row, c.column, c.paper, c.ours, c.simplest, "ours" if c.closer_than_simplest else "the simplest rule"]
            for c in sorted(own, key=lambda c: not c.closer_than_simplest)]


def conclusion_row(conclusion) -> list:
    return [conclusion.statement, conclusion.where, conclusion.verdict, conclusion.why]


def markdown(result: CheckResult, conclusions: list) -> str:
    lines = ["# Deviations from the paper", "", result.summary(), ""]
    if result.failures:
        lines += ["## What fails", ""] + [f"- {line}" for line in result.failures] + [""]
    lines += ["## Independent computed numbers by kind", ""] + table(KIND_HEADER, kind_rows(result))
    if conclusions:
        lines += ["## What the paper states", "", f"{summed_up(conclusions)}.", ""] + table(CONCLUSIONS, [conclusion_row(c) for c in conclusions])
    lines += ["## Root mean square of relative deviations", ""]
    lines += table(["table", "column", "ours", "limit", "verdict", "basis"],
                   [[r.rule.table, r.rule.column, percent(r.value), percent(r.rule.limit),
                     r.verdict, r.known or r.rule.basis] for r in result.rms])
    lines += ["## What stands in a column's place, and how far it gets", "",
              "A column whose null passes is shown and not compared: it neither goes beyond the rms limit nor misses a third of the cells.", ""]
    lines += table(NULLS, [[_short(str(text)) for text in null_row(v)] for v in result.nulls])
    lines += ["## Recovered numbers beside the simplest rule", "",
              "A peak of the mean spectrum, a taut string through our second harmonic, or one value for all. A number counts where ours is closer.", ""]
    lines += table(SIMPLEST, [[_short(str(text)) for text in row] for row in simplest_rows(result)])
    lines += ["## Orderings and signs that carry conclusions", ""]
    lines += table(["order", "statement", "found", "verdict", "basis"],
                   [[o.name, o.statement, o.found, o.verdict, o.known or o.basis] for o in result.orders])
    lines += ["## Claims of the text", ""]
    lines += table(["claim", "where", "unit", "paper", "ours", "kind", "verdict", "basis"],
                   [[c.name, c.source, c.unit, c.paper, c.shown, c.kind, c.verdict, c.basis] for c in result.claims])
    lines += ["## Statements of the text on wind", "", "Ours rest on synthetic aerodynamic data: a miss is a finding and fails nothing.", ""]
    lines += table(STATEMENTS, [[s.statement, s.source, s.found, s.verdict] for s in result.statements])
    lines += ["## Printed numbers of the tables", ""] + [f"- {line}" for line in result.coverage()] + [""]
    lines += ["## Ratchet", "", result.ratchet.told, ""]
    lines += table(["cell", "baseline", "now", "reason"], [[*move] for move in result.ratchet.excused])
    lines += ["## Every cell, worst first, then what is only shown", ""]
    lines += table(HEADER, [[_short(text) for text in row_for_csv(cell)] for cell in result.cells])
    return "\n".join(lines)


def table(head: list, rows: list) -> list:
    """A Markdown table and an empty line; `none` if it would have no rows."""
    if not rows:
        return ["none", ""]
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(str(c).replace("|", "\\|") for c in row) + " |" for row in rows] + [""]


def _short(text: str) -> str:
    """Six digits are enough to read."""
    try:
        return f"{float(text):.6g}"
    except ValueError:
        return text


def junit(result: CheckResult) -> ElementTree.ElementTree:
    cases = [(c.table, f"{c.row} {c.column}", c.verdict in ("inside", "known", "shown"), explain(c)) for c in result.cells]
    cases += [(r.rule.table, f"rms {r.rule.column}", r.verdict in ("inside", "known"), percent(r.value)) for r in result.rms]
    cases += [("orders", o.name, o.verdict in ("holds", "known"), o.found) for o in result.orders]
    cases += [("claims", c.name, c.verdict in ("inside", "known"), c.shown) for c in result.claims if c.allowed is not None]
    cases += [("ratchet", c.name, False, problem) for c, _, problem in result.ratchet.moved]
    cases += [("ratchet", line, False, line) for line in result.ratchet.stale]
    cases += [("hashes", str(path), False, problem) for path, problem in result.stale]
    cases += [("tables", name, False, "missing") for name in result.missing]
    failures = sum(not ok for *_, ok, _ in cases)
    suite = ElementTree.Element("testsuite", name="paper check", tests=str(len(cases)), failures=str(failures), errors="0")
    for group, name, ok, message in cases:
        case = ElementTree.SubElement(suite, "testcase", classname=f"paper.{group}", name=name)
        if not ok:
            ElementTree.SubElement(case, "failure", message=message)
    return ElementTree.ElementTree(suite)
