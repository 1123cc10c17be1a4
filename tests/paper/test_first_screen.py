"""The first screen of a report in a browser, at the widths of a desk and a telephone: what a reader sees without scrolling.

Oracle: the rule of the page (one sentence of at most 25 words; below it the structure with the place marked and, beside it, bars of the modes; the states
side by side; buttons; the rest folded) and made-up studies by construction: one with a printed paper, an own one with a cause at node 11, with none, with an
unknown one, and without a diagnosis.
"""
import json
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

import browser  # noqa: E402
import made_up_answer  # noqa: E402
import made_up_study  # noqa: E402
from made_up_case import MadeUpCase  # noqa: E402
from test_own_report import STEPS, own_case  # noqa: E402

WIDTHS = ((1400, 900), (390, 844))
TALLEST = 12_000  # [px] of the whole page on a desk
SEEN = """(() => { const box = n => { const e = document.querySelector('#overview ' + n); if (!e) return null; const b = e.getBoundingClientRect();
  return { left: b.left, right: b.right, top: b.top, bottom: b.bottom }; };
  const text = n => [...document.querySelectorAll('#overview ' + n)].filter(e => e.getClientRects().length).map(e => e.textContent.trim().replace(/\\s+/g, ' '));
  return { headline: box('.headline'), place: box('.place svg'), tell: box('.tell'), states: box('.states'), buttons: box('.buttons'), words: text('.headline')[0],
    marks: document.querySelectorAll('#overview .place .ring, #overview .place .marked').length, bars: text('.told'), cells: text('.states td'),
    links: text('.button'), open: document.querySelectorAll('section > details[open]').length, experts: text('.experts').length,
    tall: document.documentElement.scrollHeight, wide: document.documentElement.scrollWidth,
    small: Math.min(...[...document.querySelectorAll('#overview .told, #overview .states td, #overview .button')].map(e => parseFloat(getComputedStyle(e).fontSize))) }; })()"""


def diagnosis(verdict, cause=True):
    effect = made_up_answer.diagnosis()["effects"][0] | {
        "cause": "mass", "location": "node:11", "sentence": "At node 11 the structure carries 800 kg more than modelled.", "rivals": [],
        "place": {"words": "the deck at x = 25 m", "x_m": 25.0, "y_m": 0.0, "z_m": 10.0}}
    return made_up_answer.diagnosis(verdict=verdict, effects=[effect] if cause else [], localisation=[{"location": "node:11", "score": 4.2, "words": "the deck at x = 25 m"}])


@unittest.skipUnless(browser.program(), "no Chromium here (Debian: apt-get install chromium): the first screen is not measured in a browser")
class FirstScreen(unittest.TestCase):
    def page(self, case, commands=("tables", "figures", "report")):
        for command in commands:
            code, _, err = case.run(command)
            self.assertEqual(code, 0, err)
        return (case.results / "report/report.html").resolve()

    def looked_at(self, page, marks, start):
        with browser.Browser(webgl=False) as b:
            for width, height in WIDTHS:
                b.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
                b.open(page)
                seen = b.run(SEEN)
                with self.subTest(width=width, page=str(page), start=start):
                    self.holds(seen, width, height, marks, start)
                self.buttons_open_what_they_name(b)
            self.assertEqual(b.errors, [])

    def holds(self, seen, width, height, marks, start):
        self.assertTrue(seen["words"].startswith(start), seen["words"])
        self.assertLessEqual(len(seen["words"].split()), 25)
        order = [seen[part] for part in ("headline", "place", "states", "buttons")]
        for above, below in zip(order, order[1:]):
            self.assertLessEqual(above["bottom"], below["top"] + 1)
        self.assertLessEqual(seen["tell"]["bottom"], seen["states"]["top"] + 1)
        self.assertLessEqual(seen["place"]["right"], seen["tell"]["left"], "the bars stand beside the picture")
        self.assertLess(abs(seen["place"]["top"] - seen["tell"]["top"]), 20)
        self.assertLessEqual(seen["buttons"]["bottom"], height, "nothing of it needs scrolling")
        self.assertEqual(seen["marks"] > 0, marks)
        self.assertGreaterEqual(len(seen["bars"]), 2)
        self.assertTrue(all(line.count("Hz") == 3 for line in seen["bars"]), f"measured, before, after: {seen['bars']}")
        self.assertGreater(len(seen["cells"]), 6)
        self.assertEqual(seen["links"][:3], ["Details", "Shapes in 3D", "All tables"])
        self.assertEqual((seen["open"], seen["experts"]), (0, 0), "everything below is folded, what is for experts too")
        self.assertLess(seen["tall"], TALLEST)
        self.assertLessEqual(seen["wide"], width)
        self.assertGreaterEqual(seen["small"], 10.5, "letters that can be read")

    def buttons_open_what_they_name(self, b):
        b.run("document.documentElement.style.scrollBehavior = 'auto'")
        for name in ("answer", "tables"):
            b.run(f"document.querySelector('.button[href=\"#{name}\"]').click()")
            told = b.run(f"new Promise(r => setTimeout(() => {{ const s = document.getElementById('{name}'); "
                         "r([s.querySelector('details').open, Math.abs(s.getBoundingClientRect().top), document.documentElement.scrollHeight - scrollY - innerHeight]); }, 300))")
            self.assertTrue(told[0], name)
            self.assertLess(min(told[1:]), 60.0, f"the button lands at {name}, or where the page ends")

    def test_a_study_with_a_paper(self):
        case = MadeUpCase(self.addCleanup)
        made_up_answer.add_virtual(case.workflow, case.results)
        self.looked_at(self.page(case), False, "The model misses 8 measured frequencies")

    def test_an_own_structure(self):
        case = own_case(self.addCleanup)
        self.looked_at(self.page(case), False, "The model misses 8 measured frequencies")
        settings = case.workflow / "study.toml"
        settings.write_text(settings.read_text(encoding="utf-8").replace(json.dumps(STEPS), json.dumps([*STEPS, "s9_diagnosis"])), encoding="utf-8")
        (case.results / "s6_updating/model/model.toml").write_text('title = "made up"\n', encoding="utf-8")
        made_up_study.write_manifest(case.results / "s6_updating")
        for told, marks, start in ((diagnosis("named"), True, "At node 11 the structure carries 800 kg more than modelled;"), (diagnosis("none", False), False, "None of the"),
                                   (diagnosis("unknown"), True, "None of the known causes explains")):
            made_up_answer.write_diagnosis(case.results / "s9_diagnosis", told)
            self.looked_at(self.page(case), marks, start)


if __name__ == "__main__":
    unittest.main()
