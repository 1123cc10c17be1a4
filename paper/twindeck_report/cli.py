"""python3 -m twindeck_report tables|figures|report|unchanged|verify|article|baseline|moves|prose --study S [--results DIR] [--data DIR] [--workflow DIR]"""
import argparse
import os
import sys
from pathlib import Path

from .check import run_check
from .checksums import write_checksums
from .conclusions import conclude, summed_up
from .deviations import write_deviations
from .errors import InputError
from .own_study import is_own, verify_own, write_own_report, write_own_tables
from .prose import check_prose, write_prose
from .ratchet import add_moves, write_baseline
from .study import Study
from .unchanged import changed_pages, changed_steps, refuse_changed

EXAMPLES = """examples:
  PYTHONPATH=paper python3 -m twindeck_report tables --study ponte_del_mare
  PYTHONPATH=paper python3 -m twindeck_report verify --study ponte_del_mare --results results/ponte_del_mare \\
      --data data/ponte_del_mare

exit codes: 0 done; 1 the paper check fails (cells on stderr); 2 bad input (one line on stderr)"""


def main(arguments) -> int:
    options = _parse(arguments)
    study = Study(options.study, options.results or Path("results") / options.study,
                  options.data or Path("data") / options.study, options.workflow or Path("workflows") / options.study)
    try:
        if getattr(options, "only", None):
            return _figure(study, options.only)
        if options.command == "moves":
            return _moves(study, options.reason)
        return COMMANDS[options.command][0](study)
    except InputError as problem:
        print(f"twindeck_report {options.command}: {problem}", file=sys.stderr)
        return 2


def _tables(study: Study) -> int:
    from .tables.writer import write_tables

    refuse_changed(study, changed_steps(study))
    written = write_own_tables(study) if is_own(study) else write_tables(study)
    print(f"{len(written)} tables in {study.results / 'tables'}")
    return 0


def _figures(study: Study) -> int:
    from .figures.writer import write_figures

    refuse_changed(study, changed_steps(study))
    written = write_figures(study)
    print(f"{len(written)} figures in {study.results / 'figures'}: {', '.join(written)}")
    return 0


def _figure(study: Study, name: str) -> int:
    from .figures.writer import write_figure

    print(f"{write_figure(study, name)} written")
    return 0


def _report(study: Study) -> int:
    from .report import write_report

    _unchanged(study)
    print(f"{write_own_report(study) if is_own(study) else write_report(study)} written")
    return 0


def _unchanged(study: Study) -> int:
    refuse_changed(study, changed_steps(study) + changed_pages(study))
    virtual = study.virtual()
    if virtual is not None:
        refuse_changed(virtual, changed_steps(virtual))
    return 0


def _verify(study: Study) -> int:
    if is_own(study):
        stale = verify_own(study)
        for line in stale:
            print(f"check: {line}", file=sys.stderr)
        print(f"study {study.name}: no printed tables to compare with; "
              + (f"{len(stale)} stale or missing files" if stale else "every file is as its step wrote it"))
        return 1 if stale else 0
    result, untrue = run_check(study), check_prose(study)
    conclusions = conclude(study, result)
    write_deviations(result, conclusions, study.results / "report")
    for line in result.coverage():
        print(line)
    print(result.summary())
    if conclusions:
        print(summed_up(conclusions))
    for line in [*result.failures, *untrue]:
        print(f"paper check: {line}", file=sys.stderr)
    return 0 if result.passed and not untrue else 1


def _article(study: Study) -> int:
    from .article.build import write_article

    if is_own(study):
        raise InputError(f"study {study.name}: it has no printed paper, and the article tells of one; see its report.html instead")
    print(f"{write_article(study)} written")
    return 0


def _baseline(study: Study) -> int:
    """Sets ratchet_baseline.csv from results that pass but for the ratchet itself; results that fail are not worth holding on to."""
    result = run_check(study)
    failures = [line for line in result.failures if line not in result.held_back]
    if failures:
        for line in failures:
            print(f"paper check: {line}", file=sys.stderr)
        print(f"{study.data / 'ratchet_baseline.csv'} left as it was: the paper check fails")
        return 1
    write_baseline(study, result.held)
    print(f"{study.data / 'ratchet_baseline.csv'}: {len(result.held)} cells; ratchet_moves.csv emptied")
    return 0


def _prose(study: Study) -> int:
    print("\n".join(f"{guide} written" for guide in write_prose(study)) or "the guides say what the results are")
    return 0


def _checksums(study: Study) -> int:
    print(f"{write_checksums(study)} listed")
    return 0


def _moves(study: Study, reason: str) -> int:
    if len(reason.split()) < 3:
        raise InputError("moves: say in a sentence why these cells have to move: make moves REASON=\"...\", or --reason TEXT")
    result = run_check(study)
    print(f"{study.data / 'ratchet_moves.csv'}: {add_moves(study, result.ratchet, reason)} cells added")
    return 0


COMMANDS = {
    "tables": (_tables, "tables as CSV, LaTeX and HTML, ours beside the paper's"),
    "figures": (_figures, "figures as PDF and PNG with the plotted data beside them"),
    "report": (_report, "report.html, one self-contained page"),
    "unchanged": (_unchanged, "refuse files that were changed after they were written (make report)"),
    "verify": (_verify, "compare the tables with the paper as printed"),
    "article": (_article, "our article as PDF (needs LaTeX)"),
    "baseline": (_baseline, "hold every computed cell where it is now (ratchet_baseline.csv), and empty ratchet_moves.csv"),
    "moves": (_moves, "list the cells that moved since the baseline in ratchet_moves.csv, with a reason"),
    "prose": (_prose, "write the numbers that the guides and README.md tell of the results"),
    "checksums": (_checksums, "list the study's input files with their SHA-256 (data/SHA256SUMS)"),
}


def _parse(arguments):
    parser = argparse.ArgumentParser(prog="twindeck_report", description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    for name, (_, meaning) in COMMANDS.items():
        command = commands.add_parser(name, help=meaning, description=meaning)
        command.add_argument("--study", required=True, help="name of the study, e.g. ponte_del_mare")
        command.add_argument("--results", type=Path, help="results of the study's steps (default results/<study>)")
        command.add_argument("--data", type=Path, help="the paper as printed and the rules (default data/<study>)")
        if name == "figures":
            command.add_argument("--only", metavar="NAME", help="this figure alone, e.g. fig_05, into results/<study>/look")
        if name == "moves":
            command.add_argument("--reason", default=os.environ.get("REASON", ""), metavar="TEXT",
                                 help="why these cells have to move (default: REASON of the environment, where make puts it)")
        command.add_argument("--workflow", type=Path, help="study.toml and the steps' configs (default workflows/<study>)")
    return parser.parse_args(arguments)
