"""report.html in a real browser, from disk, with the network off; skipped where no Chromium is installed.

Oracle: the made-up study by construction (a strip of shells with half waves as modes), and the browser itself: what it asked the network
for, what stands in its console, whether pictures hold more than one colour and change from frame to frame.
"""
import os
import sys
import tempfile
import time
import unittest
import zlib
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

import browser  # noqa: E402
import made_up_answer  # noqa: E402
import made_up_study  # noqa: E402
from twindeck_report import cli  # noqa: E402
from twindeck_report.page import scripts  # noqa: E402

CANVAS = """(() => { const c = document.querySelector('#mode-shapes canvas'), d = document.createElement('canvas');
d.width = 200; d.height = 120; const p = d.getContext('2d'); p.drawImage(c, 0, 0, 200, 120);
return Array.from(p.getImageData(0, 0, 200, 120).data); })()"""
LARGEST = 15_000_000


def colours(pixels):
    return {tuple(pixels[i : i + 3]) for i in range(0, len(pixels), 4)}


def pixels_of(png):
    """Raw rows of a PNG, filters and all: enough to tell whether a picture is more than one colour."""
    data, at = b"", 8
    while at < len(png):
        size, kind = int.from_bytes(png[at : at + 4], "big"), png[at + 4 : at + 8]
        if kind == b"IDAT":
            data += png[at + 8 : at + 8 + size]
        at += 12 + size
    return zlib.decompress(data)


@unittest.skipUnless(
    browser.program(), "no Chromium here (Debian: apt-get install chromium): the page is not looked at in a browser"
)
class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.addClassCleanup(os.chdir, os.getcwd())
        data, workflow, results = made_up_study.make_study(cls.folder)
        made_up_answer.add_virtual(workflow, results)
        cls.page = results / "report/report.html"
        os.chdir(cls.folder)
        for command in ("tables", "figures", "report"):
            with redirect_stdout(StringIO()):
                code = cli.main(
                    [command, "--study", "made_up", "--results", str(results), "--data", str(data), "--workflow", str(workflow)]
                )
            assert code == 0, command

    def looked_at(self, webgl):
        with browser.Browser(webgl) as b:
            b.open(self.page.resolve())
            b.wait("window.twindeck && twindeck.modes && twindeck.modes.viewer.frames > 1")
            renderer = b.run("document.getElementById('mode-shapes').dataset.renderer")
            self.drawn_and_moving(b)
            self.colours_what_updating_changed(b)
            self.stands_still_for_print(b)
            self.poles_tell_their_numbers(b)
            self.modes_are_chosen_by_hand(b)
            self.rows_are_found(b)
            self.figures_are_small_until_they_are_clicked(b)
            shot = Path(self.folder) / f"page_{renderer}.png"
            self.assertGreater(len(set(pixels_of(b.screenshot(shot)))), 20, "the screenshot is not blank")
            self.assertEqual(b.errors, [])
            asked = [a for a in b.requests if not a.startswith(("data:", "file:", "blob:"))]
            self.assertEqual(asked, [], "nothing is asked of the network")
        return renderer

    def drawn_and_moving(self, b):
        b.run("document.documentElement.style.scrollBehavior = 'auto'; location.hash = '#shapes'")
        b.run("twindeck.modes.run(true)")
        first, frames = b.run(CANVAS), b.run("twindeck.modes.viewer.frames")
        self.assertGreater(len(colours(first)), 10, "the canvas draws more than its background")
        b.wait(f"twindeck.modes.viewer.frames > {frames + 5}")
        self.assertNotEqual(b.run(CANVAS), first, "the animation runs")
        b.run("twindeck.modes.run(false)")
        still = b.run(CANVAS)
        b.run("twindeck.modes.viewer.orbit.azimuth += 0.7; twindeck.modes.viewer.paint()")
        self.assertNotEqual(b.run(CANVAS), still, "the picture turns")
        # half waves: mode m of the strip has its largest displacement where sin(m pi x / 100) is one, and no motion at its ends
        b.run(
            "(() => { const m = twindeck.modes; m.list.value = 1; m.list.dispatchEvent(new Event('change')); m.phase = Math.PI / 2; m.viewer.paint(); })()"
        )
        self.assertIn("mode 2", b.run("document.querySelector('#mode-shapes .caption').textContent"))
        moved = b.run(
            "(() => { const v = twindeck.modes.viewer; return Array.from(v.moved).map((x, i) => x - v.scene.base[i]); })()"
        )
        rise = moved[2::3]
        self.assertAlmostEqual(rise[0], 0.0, places=5)
        self.assertAlmostEqual(rise[2 * 5], max(rise), places=4)
        self.assertAlmostEqual(rise[2 * 15], -max(rise), places=4)

    def colours_what_updating_changed(self, b):
        """Alike shapes have no difference; a node of the model as designed that is moved by a tenth of the largest displacement is where the models differ."""
        told = b.run("""(() => { const m = twindeck.modes, last = m.data.sets[m.data.sets.length - 1];
          m.sets.value = m.data.sets.findIndex(s => s.kind === 'model'); m.choose(0);
          if (!m.earlier()) return null;
          const its = m.shape(last.modes[0], 'shape', Int16Array), own = m.shape(m.mode, 'shape', Int16Array);
          its.set(own);
          const alike = Math.max(...m.difference().length);
          its[3 * 7 + 1] += 3277;
          const found = m.difference(), at = found.length.indexOf(Math.max(...found.length));
          m.change.click();
          const words = m.text.textContent;
          m.change.click();
          return [alike, at, found.most, words]; })()""")
        self.assertIsNotNone(told, "the updated model and the one as designed have the same nodes")
        self.assertLess(told[0], 1e-6)
        self.assertEqual(told[1], 7)
        self.assertAlmostEqual(told[2], 0.1, delta=0.01)
        self.assertIn("Colour: difference to mode", told[3])

    def stands_still_for_print(self, b):
        b.run("window.dispatchEvent(new Event('beforeprint'))")
        b.call("Emulation.setEmulatedMedia", media="print")
        shown = b.run(
            "['#mode-shapes canvas', '#mode-shapes img.now', '.stills', 'nav.contents'].map(n => getComputedStyle(document.querySelector(n)).display)"
        )
        self.assertEqual(shown, ["none", "block", "block", "none"])
        self.assertGreater(b.run("document.querySelector('#mode-shapes img.now').naturalWidth"), 300)
        b.call("Emulation.setEmulatedMedia", media="")
        self.assertTrue(b.pdf().startswith(b"%PDF"))

    def poles_tell_their_numbers(self, b):
        b.run("location.hash = '#identification'")
        b.wait("twindeck.poles.drawn > 0")
        told = b.run(
            """(() => { const p = twindeck.poles, s = p.seen.find(s => s.p[3] === 7), m = p.picture.getScreenCTM();
          const at = new DOMPoint(s.x, s.y).matrixTransform(m);
          p.picture.dispatchEvent(new PointerEvent('pointermove', { clientX: at.x, clientY: at.y }));
          return [p.label.hidden, p.label.textContent, s.p]; })()"""
        )
        self.assertFalse(told[0])
        order, frequency, damping = told[2][:3]
        for part in (f"{frequency:.4f} Hz", f"{damping:.2f} %", f"order {order}", "stable: frequency, damping, shape"):
            self.assertIn(part, told[1])

    def modes_are_chosen_by_hand(self, b):
        """A click on a pole of a mode deletes the mode, on another pole keeps it; the file names both by all their digits; dragging zooms."""
        click = """(s => { const p = twindeck.poles, at = new DOMPoint(s.x, s.y).matrixTransform(p.picture.getScreenCTM());
          for (const kind of ['pointerdown', 'pointerup']) p.picture.dispatchEvent(new PointerEvent(kind, { clientX: at.x, clientY: at.y })); return s.p; })"""
        deleted = b.run(f"{click}(twindeck.poles.seen.find(s => s.p[4] === 2))")
        kept = b.run(f"{click}(twindeck.poles.seen.find(s => s.p[4] === null))")
        header, *lines = b.run("twindeck.poles.choices.csv()").strip().split("\n")
        self.assertEqual(header, "setup,order,frequency_Hz,damping_ratio_pct,action")
        cells = [line.split(",") for line in lines]
        self.assertEqual([(c[0], int(c[1]), float(c[2]), float(c[3]), c[4]) for c in cells],
                         [("ST1", *deleted[:3], "delete"), ("ST1", *kept[:3], "keep")])
        self.assertEqual(b.run("document.querySelectorAll('#poles .mode.gone').length"), 1, "the deleted mode's line")
        self.assertEqual(b.run("document.querySelectorAll('#poles .choices li').length"), 2)
        folder = Path(self.folder) / "downloads"
        folder.mkdir(exist_ok=True)
        b.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(folder.resolve()))
        b.run("document.querySelector('#poles [name=download]').click()")
        deadline = time.monotonic() + 30
        while not (folder / "modes_kept.csv").is_file() and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertEqual((folder / "modes_kept.csv").read_text(encoding="utf-8").strip().split("\n"), [header, *lines], "from a page on disk, with no server")
        (folder / "modes_kept.csv").unlink()
        b.run(f"{click}(twindeck.poles.seen.find(s => s.p[4] === 2))")
        self.assertEqual(len(b.run("twindeck.poles.choices.csv()").strip().split("\n")), 2, "a second click takes the choice back")
        low, high = b.run("""(() => { const p = twindeck.poles, box = p.picture.getBoundingClientRect(), y = box.top + 100;
          const at = f => new DOMPoint(p.x(f), 100).matrixTransform(p.picture.getScreenCTM()).x;
          const send = (kind, f) => p.picture.dispatchEvent(new PointerEvent(kind, { clientX: at(f), clientY: y }));
          send('pointerdown', 1.0); send('pointermove', 1.5); send('pointerup', 1.5); return p.zooms.get(p.panel); })()""")
        self.assertAlmostEqual(low, 1.0, places=2)
        self.assertAlmostEqual(high, 1.5, places=2)
        self.assertTrue(all(0.99 < f < 1.51 for f in b.run("twindeck.poles.seen.map(s => s.p[1])")), "only poles of the zoomed band are drawn")

    def figures_are_small_until_they_are_clicked(self, b):
        """All of them in less than a third of the height that they have one below the other."""
        small, large, again = b.run("""(() => { document.querySelector('#figures details').open = true;
          const all = [...document.querySelectorAll('#figures figure')], height = () => document.getElementById('figures').getBoundingClientRect().height;
          const found = [height()];
          for (let i = 0; i < 2; ++i) { all.forEach(f => f.click()); found.push(height()); }
          return found; })()""")
        self.assertLess(small, large / 3)
        self.assertEqual(small, again, "a second click makes them small")

    def rows_are_found(self, b):
        """Worst first, the first rows only; a search shows every row that holds its words."""
        count = "[...document.querySelectorAll('#cells tbody tr')].filter(r => getComputedStyle(r).display !== 'none').length"
        total, first = b.run("document.querySelectorAll('#cells tbody tr').length"), b.run(count)
        self.assertLess(first, total)
        b.run(
            "(() => { const i = document.querySelector('[data-filter=cells]'); i.value = 'table_12 v_cr';"
            " i.dispatchEvent(new Event('input')); })()"
        )
        rows = b.run("[...document.querySelectorAll('#cells tbody tr')].map(r => r.textContent.toLowerCase())")
        self.assertEqual(b.run(count), sum("table_12" in row and "v_cr" in row for row in rows))
        b.run("document.querySelector('[data-more=cells]').click()")

    def test_with_webgl(self):
        if not scripts.three():
            self.skipTest("three.js is not installed (libjs-three): the page draws without it")
        self.assertIn(self.looked_at(webgl=True), ("webgl", "canvas"))

    def test_without_webgl(self):
        self.assertEqual(self.looked_at(webgl=False), "canvas")

    def test_nothing_sticks_out_sideways_with_every_section_open(self):
        with browser.Browser(webgl=False) as b:
            for width, height in ((390, 844), (1400, 900)):
                b.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
                b.open(self.page.resolve())
                b.run("document.querySelectorAll('details').forEach(d => { d.open = true; })")
                self.assertLessEqual(b.run("document.documentElement.scrollWidth"), width)

    def test_page_can_be_sent_by_mail(self):
        self.assertLess(self.page.stat().st_size, LARGEST)

    def test_console_errors_are_noticed(self):
        """The watch itself can fail."""
        bad = Path(self.folder) / "bad.html"
        bad.write_text(
            "<canvas></canvas><img src='https://example.org/a.png'><script>console.error('told'); nothing.at.all;</script>",
            encoding="utf-8",
        )
        with browser.Browser(webgl=False) as b:
            b.open(bad.resolve())
            b.run("1")
            self.assertGreaterEqual(len(b.errors), 2)
            self.assertIn("https://example.org/a.png", b.requests)


if __name__ == "__main__":
    unittest.main()
