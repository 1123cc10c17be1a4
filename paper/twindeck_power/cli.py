"""python3 -m twindeck_power --study S --bin build/bin [--only NAME ...] [--list] [--keep]: the power of the check against the paper."""
import argparse
import csv
import shutil
import sys
import time
from pathlib import Path

from twindeck_report.check import run_check
from twindeck_report.errors import InputError
from twindeck_report.study import Study

from .judge import Judge
from .perturbation import LEAST, read_plan
from .scratch import Scratch

HEADER = ["perturbation", "caught", "paper", "ratchet", "cells", "margin", "why", "file", "steps", "seconds"]
# Steps from which a cell is compared with the paper; the others are held by the ratchet alone.
GATES = ("s1_model", "s3_identification", "s4_refinement", "s6_updating", "s7_aerodynamics")


def main(arguments) -> int:
    options = _parse(arguments)
    try:
        return _run(options)
    except InputError as problem:
        print(f"check-power: {problem}", file=sys.stderr)
        return 2


def _run(options) -> int:
    study = Study(options.study, Path("results") / options.study, Path("data") / options.study, Path("workflows") / options.study)
    plan = read_plan(study.data / "power.toml")
    chosen = [p for p in plan.perturbations if not options.only or p.slug in options.only]
    unknown = set(options.only or ()) - {p.slug for p in plan.perturbations}
    if unknown:
        raise InputError(f"power.toml: no perturbation {', '.join(sorted(unknown))}; --list names them")
    if options.list:
        for p in chosen:
            print(f"{p.slug:<44} {p.file} {' '.join(p.keys) or p.column}")
        return 0
    result = run_check(study)
    if not result.passed:
        raise InputError(f"{study.results}: the unchanged study does not pass its check ({len(result.failures)} failures, the first: "
                         f"{result.failures[0]}); run `make all STUDY={study.name}` first")
    judge, out, rows = Judge(study, result), Path("results/check_power/power.csv"), []
    gates, whole = (sum(seconds) / 60 for seconds in zip(*(_estimate(options, plan, p) for p in chosen)))
    print(f"{len(chosen)} changed inputs; up to {gates:.0f} minutes for the steps that are compared with the paper, {whole:.0f} if every step has "
          "to run, at the speed of the unchanged run", flush=True)
    for i, p in enumerate(chosen, 1):
        row = _measure(options, plan, judge, p)
        rows.append(row)
        _write(out, rows, plan.perturbations if options.only else None)
        print(f"[{i}/{len(chosen)}] {p.name}: {_words(row)} ({row['seconds']} s)", flush=True)
    return _tell(rows, bool(options.only))


def _measure(options, plan, judge: Judge, p) -> dict:
    started = time.monotonic()
    root = options.scratch / p.slug
    scratch = Scratch(root, Path.cwd(), options.study, options.bin.resolve(), plan.quick)
    scratch.own(p.file)
    p.apply(root)
    study = Study(options.study, scratch.results, root / "data" / options.study, root / "workflows" / options.study)
    found, refused = None, ""
    # First what is compared with the paper, until the paper gate has noticed; then, if nothing has, what the ratchet alone holds.
    for only_gates in (True, False):
        while not refused and (waiting := [s for s in scratch.waiting() if not only_gates or _leads_to_gate(scratch, s)]):
            # of those that wait for no other the quickest
            step = min((s for s in waiting if not scratch.reads(s) & set(waiting)), key=scratch.seconds)
            failure = scratch.run(step)
            refused = failure
            found = judge.look(study, p.prints)
            if found.paper:
                break
        if refused or (found and (found.paper or found.ratchet)):
            break
    if found is None:
        found = judge.look(study, p.prints)
    if not options.keep:
        shutil.rmtree(root)
    caught = bool(refused or found.paper or found.ratchet)
    cells = ([refused] if refused else []) + found.cells
    return {"perturbation": p.name, "caught": _yes(caught), "paper": _yes(found.paper), "ratchet": _yes(found.ratchet),
            "cells": "; ".join(c.replace(";", ",") for c in cells), "margin": "" if refused and not found.cells else f"{found.nearest:.3g}",
            "why": "" if caught else p.uncheckable, "file": p.file, "steps": " ".join(scratch.done),
            "seconds": f"{time.monotonic() - started:.1f}"}


def _leads_to_gate(scratch: Scratch, step: str) -> bool:
    behind = scratch.steps[scratch.steps.index(step) + 1:]
    return step.split("/")[1] in GATES or any(step in scratch.reads(later) and _leads_to_gate(scratch, later) for later in behind)


def _estimate(options, plan, p) -> tuple:
    """Seconds if every step that reads the file, and every step behind it, has to run, as long as each took in the unchanged study: of those
    that lead to a gate, and of all."""
    scratch = Scratch(options.scratch / p.slug, Path.cwd(), options.study, options.bin.resolve(), plan.quick)
    reached = []
    for step in scratch.steps:
        if p.file in scratch.inputs(step) or any(before in reached for before in scratch.reads(step)):
            reached.append(step)
    shutil.rmtree(scratch.root)
    return sum(scratch.seconds(s) for s in reached if _leads_to_gate(scratch, s)), sum(scratch.seconds(s) for s in reached)


def _yes(found) -> str:
    return "yes" if found else "no"


def _words(row: dict) -> str:
    if row["caught"] == "no":
        return f"NOT CAUGHT, nearest {row['margin']} of what is allowed"
    return f"caught{' by the paper gate' if row['paper'] == 'yes' else ''}: {row['cells'].split('; ')[0]}"


def _write(path: Path, rows: list, kept) -> None:
    """With `kept` (all perturbations) the rows of earlier runs stay for those that are not run now, in the order of power.toml."""
    path.parent.mkdir(parents=True, exist_ok=True)
    by_name = {row["perturbation"]: row for row in rows}
    if kept is not None and path.is_file():
        with path.open(encoding="utf-8", newline="") as lines:
            by_name = {row["perturbation"]: row for row in csv.DictReader(lines)} | by_name
        by_name = {p.name: by_name[p.name] for p in kept if p.name in by_name}
    with path.open("w", encoding="utf-8", newline="") as out:
        writer = csv.DictWriter(out, HEADER, lineterminator="\n", extrasaction="ignore")
        writer.writeheader()
        writer.writerows(by_name.values())


def _tell(rows: list, partial: bool) -> int:
    caught, paper = (sum(row[name] == "yes" for row in rows) for name in ("caught", "paper"))
    print(f"check-power: {caught} of {len(rows)} changed inputs caught ({100 * caught / max(len(rows), 1):.0f} %), {paper} by the paper gate "
          f"({100 * paper / max(len(rows), 1):.0f} %); results/check_power/power.csv")
    silent = [row["perturbation"] for row in rows if row["caught"] == "no" and not row["why"]]
    for name in silent:
        print(f"check-power: {name}: not caught; sharpen the check, or say in power.toml (uncheckable) why no cell can notice it", file=sys.stderr)
    if not partial and len(rows) < LEAST:
        print(f"check-power: {len(rows)} changed inputs, at least {LEAST} are wanted", file=sys.stderr)
        return 1
    return 1 if silent else 0


def _parse(arguments):
    parser = argparse.ArgumentParser(prog="twindeck_power", description=__doc__)
    parser.add_argument("--study", default="ponte_del_mare")
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="the steps' executables (default build/bin)")
    parser.add_argument("--scratch", type=Path, default=Path("build/check_power"), help="where the changed copies are made (default build/check_power)")
    parser.add_argument("--only", action="append", metavar="NAME", help="this changed input alone (may be given several times)")
    parser.add_argument("--list", action="store_true", help="name the changed inputs and end")
    parser.add_argument("--keep", action="store_true", help="leave the changed copies where they are")
    options = parser.parse_args(arguments)
    options.scratch = options.scratch.resolve()
    return options
