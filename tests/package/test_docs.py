"""The guides' links and the folder of static pages that `make docs` makes of them.

Oracles: the tree, which has the files that links name; planted links that lead nowhere, which must be found; a diagnosis made up here.
"""
import json
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
sys.path.insert(0, str(ROOT / "paper"))
from twindeck_site import __main__ as site  # noqa: E402
from twindeck_site import gallery, links  # noqa: E402


class Docs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()

    def test_links_of_the_guides_lead_somewhere(self):
        files = [*(ROOT / "docs").rglob("*.md"), *ROOT.glob("*.md")]
        self.assertGreater(len(files), 20)
        self.assertEqual(links.broken_in_markdown([f for f in files if f.name != "reference.md"]), [])

    def test_a_link_that_leads_nowhere_is_found(self):
        page = self.folder / "page.md"
        page.write_text("[a](page.md) [b](gone.md) [c](https://example.org/x) `[d](code.md)` [e](#here)\n")
        self.assertEqual(links.broken_in_markdown([page]), [f"{page}: gone.md"])
        (self.folder / "index.html").write_text('<h1 id="top">x</h1><a href="#top">a</a><a href="#gone">b</a><a href="gone.html">c</a><a href="api/i.html">d</a>')
        self.assertEqual(links.broken_in_site(self.folder), [f"index.html: {link}" for link in ("#gone", "gone.html", "api/i.html")])

    def test_the_gallery_says_what_the_diagnosis_says(self):
        results = self.folder / "results/smoke/s9_diagnosis"
        results.mkdir(parents=True)
        (results / "diagnosis.json").write_text(json.dumps({"verdict": "named", "sentences": {"why": "A cable | is slack."}}))
        page = gallery.page(ROOT / "workflows", self.folder / "results", self.folder / "pictures")
        rows = [line for line in page.splitlines() if line.startswith("| `")]
        self.assertEqual(len(rows), len(list((ROOT / "workflows").glob("*/study.toml"))))
        self.assertIn("| named | A cable \\| is slack. |", next(row for row in rows if "`smoke`" in row))
        self.assertIn("| not run here |", next(row for row in rows if "`weimar_frame`" in row))

    def test_the_assembled_pages_have_whole_links(self):
        pages = self.folder / "pages"
        site.assemble(ROOT, self.folder / "none", "# Reference\n", pages)
        (pages / "headers.md").write_text(site.headers_page(ROOT, False))
        for name in (name for _, name in (*site.FIRST, *site.LAST)):
            self.assertTrue((pages / name).is_file(), name)
        self.assertEqual(links.broken_in_markdown(list(pages.rglob("*.md"))), [])

    @unittest.skipUnless(shutil.which("mkdocs"), f"no mkdocs here ({site.INSTALL}): the pages are not made")
    def test_the_site_is_made_and_whole(self):
        out = self.folder / "site"
        self.assertEqual(site.main(["--root", str(ROOT), "--bin", str(BIN), "--results", str(self.folder / "none"), "--out", str(out), "--no-headers"]), 0)
        for name in ("index.html", "tutorial.html", "gallery.html", "reference.html", "decisions/index.html"):
            self.assertTrue((out / name).is_file(), name)
        self.assertIn("youngs_modulus_Pa", (out / "reference.html").read_text())


if __name__ == "__main__":
    unittest.main()
