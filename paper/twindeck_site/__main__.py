"""python3 -m twindeck_site --bin build/bin --out build/site"""
import argparse
import shutil
import subprocess
import sys
from pathlib import Path

from twindeck_reference.__main__ import page as reference

from . import gallery, links

INSTALL = "apt-get install --no-install-recommends mkdocs doxygen"
# Pages in the order of the menu; what is not named here is under Guides.
FIRST = (("Start", "index.md"), ("Install", "install.md"), ("Tutorial", "tutorial.md"), ("Guides", "guides.md"), ("Studies", "gallery.md"))
LAST = (("Reference", "reference.md"), ("C++ headers", "headers.md"), ("Decisions", "decisions/index.md"), ("Contributing", "contributing.md"),
        ("Changes", "changelog.md"))
RENAMED = {"README.md": "guides.md"}
# The theme `mkdocs`: of Debian 12's `readthedocs` two scripts are missing from the package.
CONFIGURATION = """site_name: twindeck
docs_dir: pages
site_dir: {site}
use_directory_urls: false
strict: true
theme:
  name: mkdocs
  highlightjs: false
markdown_extensions: [tables, fenced_code, toc]
nav:
{menu}
"""
# Headers of the libraries; the steps are programs, which the reference describes.
DOXYGEN = """PROJECT_NAME = twindeck
INPUT = {source}
RECURSIVE = YES
FILE_PATTERNS = *.hpp
EXCLUDE_PATTERNS = */steps/* */precompiled/*
STRIP_FROM_PATH = {source}
EXTRACT_ALL = YES
JAVADOC_AUTOBRIEF = YES
GENERATE_LATEX = NO
GENERATE_HTML = YES
HTML_OUTPUT = {out}
SEARCHENGINE = NO
HAVE_DOT = NO
QUIET = YES
WARNINGS = NO
WARN_IF_DOC_ERROR = NO
WARN_IF_INCOMPLETE_DOC = NO
"""


def _copy(source: Path, target: Path, changes: dict) -> None:
    text = source.read_text(encoding="utf-8")
    for old, new in changes.items():
        text = text.replace(f"]({old}", f"]({new}")
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(text, encoding="utf-8")


def title(file: Path) -> str:
    return next(line for line in file.read_text(encoding="utf-8").splitlines() if line.startswith("# "))[2:].strip()


def assemble(root: Path, results: Path, reference_text: str, pages: Path) -> None:
    """The pages as Markdown in one folder, whose links are relative to it."""
    shutil.rmtree(pages, ignore_errors=True)
    shutil.copytree(root / "docs/pictures", pages / "pictures")
    upwards = {"../README.md": "index.md", "../CONTRIBUTING.md": "contributing.md", "../CHANGELOG.md": "changelog.md"}
    for file in sorted((root / "docs").glob("*.md")):
        if file.name != "reference.md":
            _copy(file, pages / RENAMED.get(file.name, file.name), {**upwards, "README.md": "guides.md", "decisions/)": "decisions/index.md)"})
    listed = ["# Decisions", "", "Choices that others might undo, each with its reasons.", ""]
    for file in sorted((root / "docs/decisions").glob("*.md")):
        _copy(file, pages / "decisions" / file.name, {"../README.md": "../guides.md"})
        listed.append(f"- [{file.name[:4]}: {title(file)}]({file.name})")
    (pages / "decisions/index.md").write_text("\n".join(listed) + "\n", encoding="utf-8")
    top = {"docs/README.md": "guides.md", "docs/decisions/)": "decisions/index.md)", "docs/": "", "CONTRIBUTING.md": "contributing.md",
           "CHANGELOG.md": "changelog.md"}
    for name, target in (("README.md", "index.md"), ("CONTRIBUTING.md", "contributing.md"), ("CHANGELOG.md", "changelog.md")):
        _copy(root / name, pages / target, top)
    (pages / "reference.md").write_text(reference_text, encoding="utf-8")
    (pages / "gallery.md").write_text(gallery.page(root / "workflows", results, pages / "pictures"), encoding="utf-8")


def headers_page(root: Path, made: bool) -> str:
    """The page that leads to Doxygen's, or says how to get it."""
    link = ('<a href="api/index.html">The headers, one page each</a>' if made
            else f"Doxygen was not there when these pages were made (`{INSTALL}`).")
    rooms = sorted(p.name for p in (root / "src").iterdir() if p.is_dir() and p.name not in ("steps", "precompiled"))
    return ("# C++ headers\n\n" + link + "\n\nEach folder of `src/` is a library: " + ", ".join(f"`{room}`" for room in rooms) +
            ". `src/layers.toml` says which library may use which. A header states what it computes, the equation with its source, the unit and the shape of each "
            "argument, and what it throws.\n")


def menu(pages: Path) -> str:
    placed = {name for _, name in (*FIRST, *LAST)}
    guides = [p for p in sorted(pages.glob("*.md")) if p.name not in placed]
    lines = [f'  - "{label}": {name}' for label, name in FIRST] + ["  - All guides:"]
    lines += [f'      - "{title(p)}": {p.name}' for p in guides]
    return "\n".join(lines + [f'  - "{label}": {name}' for label, name in LAST])


def main(arguments) -> int:
    parser = argparse.ArgumentParser(prog="twindeck_site", description=__doc__)
    parser.add_argument("--root", type=Path, default=Path("."), help="the repository")
    parser.add_argument("--bin", type=Path, default=Path("build/bin"), help="folder of the executables, which the reference is made from")
    parser.add_argument("--results", type=Path, default=Path("results"), help="results of the studies, for the gallery")
    parser.add_argument("--out", type=Path, default=Path("build/site"), help="folder of the pages; replaced")
    parser.add_argument("--no-headers", action="store_true", help="leave Doxygen out")
    options = parser.parse_args(arguments)
    if not shutil.which("mkdocs"):
        print(f"docs: mkdocs is not here, no pages were made: {INSTALL}", file=sys.stderr)
        return 0
    work, site = options.out.resolve().parent / "docs", options.out.resolve()
    doxygen = None if options.no_headers else shutil.which("doxygen")
    assemble(options.root, options.results, reference(options.bin), work / "pages")
    (work / "pages/headers.md").write_text(headers_page(options.root, bool(doxygen)), encoding="utf-8")
    (work / "mkdocs.yml").write_text(CONFIGURATION.format(site=site, menu=menu(work / "pages")), encoding="utf-8")
    done = subprocess.run(["mkdocs", "build", "--quiet", "--clean", "--config-file", work / "mkdocs.yml"], capture_output=True, text=True)
    if done.returncode != 0:
        print(f"docs: mkdocs: {done.stderr.strip() or done.stdout.strip()}", file=sys.stderr)
        return 2
    if doxygen:
        text = DOXYGEN.format(source=(options.root / "src").resolve(), out=site / "api")
        subprocess.run([doxygen, "-"], input=text, text=True, check=True, stdout=subprocess.DEVNULL)
    elif not options.no_headers:
        print(f"docs: doxygen is not here, the pages of the headers are left out: {INSTALL}", file=sys.stderr)
    broken = links.broken_in_site(site)
    for link in broken:
        print(f"docs: leads nowhere: {link}", file=sys.stderr)
    print(f"{options.out}/index.html: {len(list(site.rglob('*.html')))} pages, {len(broken)} broken links")
    return 2 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
