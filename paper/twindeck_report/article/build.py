"""results/<study>/paper/: numbers.tex, captions.tex and errata.tex, and paper.pdf where LaTeX is there."""
import os
import re
import shutil
import subprocess
from pathlib import Path

from ..check import run_check
from ..errors import InputError
from ..study import Study
from ..figures import FIGURES
from ..tables.writer import tex
from .numbers import macros, numbers

SOURCE = Path(__file__).resolve().parents[2] / "article"
PACKAGES = "texlive-latex-base texlive-latex-recommended texlive-fonts-recommended"


def write_article(study: Study) -> Path:
    """@throws InputError when LaTeX is not there, or stops: with what it said first, and where its log lies."""
    folder = study.results / "paper"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "numbers.tex").write_text(macros(numbers(study, run_check(study))), encoding="utf-8")
    (folder / "captions.tex").write_text(captions(), encoding="utf-8")
    (folder / "errata.tex").write_text(errata(study), encoding="utf-8")
    latex = shutil.which("pdflatex")
    if latex is None:
        raise InputError(f"pdflatex is not here, so that {folder / 'paper.pdf'} was not made (its numbers are in {folder / 'numbers.tex'}); "
                         f"run `apt-get install --no-install-recommends {PACKAGES}`, then `make paper STUDY={study.name}` again")
    environment = {**os.environ, "TEXINPUTS": f".:{SOURCE}//:", "SOURCE_DATE_EPOCH": "0", "FORCE_SOURCE_DATE": "1"}
    for _ in range(2):  # the second run settles the references
        run = subprocess.run([latex, "-interaction=nonstopmode", "-halt-on-error", "-jobname=draft", "article.tex"], cwd=folder, env=environment,
                             capture_output=True, text=True, errors="replace")
        if run.returncode:
            said = re.search(r"^! ?(.*)$", run.stdout, re.M)
            raise InputError(f"{SOURCE / 'article.tex'}: LaTeX stopped: {said.group(1) if said else 'no message'}; see {folder / 'draft.log'}")
    for suffix in (".aux", ".out", ".toc"):
        (folder / f"draft{suffix}").unlink(missing_ok=True)
    (folder / "draft.log").unlink(missing_ok=True)
    return (folder / "draft.pdf").rename(folder / "paper.pdf")


def captions() -> str:
    """Each figure's caption and number by its name: \\csname caption:fig_02\\endcsname. Figures that the paper does not have are S1, S2, …"""
    lines, own = [], 0
    for figure in FIGURES:
        name = figure.NAME
        of_paper = re.fullmatch(r"fig_(\d+)", name)
        own += of_paper is None
        for what, text in (("caption", tex(figure.CAPTION)), ("number", str(int(of_paper.group(1))) if of_paper else f"S{own}")):
            lines.append(f"\\expandafter\\def\\csname {what}:{name}\\endcsname{{{text}}}")
    return "\n".join(lines) + "\n"


def errata(study: Study) -> str:
    """errata.toml as a list: what the paper says, and what that does to our results."""
    rows = study.read_toml(study.data / "errata.toml").get("erratum", [])
    lines = [f"\\item[{{{tex(row['item'])}.}}] {tex(row['what'])} \\emph{{Here:}} {tex(row['effect'])}" for row in rows]
    return "\n".join([r"\begin{description}", *lines, r"\end{description}"]) + "\n" if lines else "None found.\n"
