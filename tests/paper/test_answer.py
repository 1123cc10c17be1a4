"""The first screen: a diagnosis in five sentences, the virtual campaign's first and scored, the same numbers everywhere on the page.

Oracle: the made-up diagnosis and score (made_up_answer.py), number by number; refusals by their words.
"""
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

import made_up_answer  # noqa: E402
from made_up_case import MadeUpCase  # noqa: E402
from twindeck_report.errors import InputError  # noqa: E402
from twindeck_report.page import answer, diagnosis  # noqa: E402
from twindeck_report.page.numbers import physical, span  # noqa: E402
from twindeck_report.page.pieces import render  # noqa: E402
from twindeck_report.study import Study  # noqa: E402


def words_of(page):
    return " ".join(re.sub(r"<[^>]+>", " ", page).split())


class FirstScreen(unittest.TestCase):
    """A study whose report is made once, with a virtual campaign beside it."""

    @classmethod
    def setUpClass(cls):
        cls.case = MadeUpCase(cls.addClassCleanup)
        cls.virtual = made_up_answer.add_virtual(cls.case.workflow, cls.case.results)
        for command in ("tables", "figures", "report"):
            code, _, err = cls.case.run(command)
            assert code == 0, err

    def refused(self, words):
        code, _, err = self.case.run("report")
        self.assertEqual(code, 2)
        self.assertEqual(len(err.strip().splitlines()), 1, err)
        for part in words:
            self.assertIn(part, err)

    def test_the_page_opens_with_the_virtual_campaign_and_its_score(self):
        page = (self.case.results / "report/report.html").read_text(encoding="utf-8")
        first = words_of(page[page.index('id="overview"'):page.index('id="steps"')])
        order = [first.index(part) for part in (
            "Made-up bridge, virtual campaign (its truth is known)", "What is wrong", made_up_answer.SENTENCES["what"], "How sure", made_up_answer.SENTENCES["how_sure"],
            "How much better", made_up_answer.SENTENCES["how_much_better"], "What next", made_up_answer.SENTENCES["next"], "What was hidden",
            "In the set. Friction: the dampers C1 and C2 stand still below 500 N each.", "hidden 500 N, found 434 N (181 N to 608 N, 90 %); the interval holds it",
            "hidden 10 MN/m, found 5.4 MN/m (4.7 MN/m to 6.4 MN/m, 90 %); the interval misses it", "Missed. The stays S1 and S2 vibrate.",
            "Every number on this page")]
        self.assertEqual(order, sorted(order))
        self.assertNotIn("node:725", first, "a place has words on the first screen")

    def test_a_score_of_another_run_is_refused(self):
        path = self.virtual / "score/score.json"
        text = path.read_text(encoding="utf-8")
        self.addCleanup(path.write_text, text, encoding="utf-8")
        path.write_text(json.dumps(json.loads(text) | {"diagnosis_sha256": "0" * 64}), encoding="utf-8")
        self.refused(("score.json: it scores another run than", "run `make score`"))

    def test_an_edited_virtual_diagnosis_is_refused(self):
        path = self.virtual / "s9_diagnosis/diagnosis.json"
        text = path.read_text(encoding="utf-8")
        self.addCleanup(path.write_text, text, encoding="utf-8")
        path.write_text(text.replace("0.87", "0.99"), encoding="utf-8")
        self.refused(("diagnosis.json: stale hash",))


class OneStudy(unittest.TestCase):
    """A study that has step 9 alone: its answer and its account."""

    def setUp(self):
        root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.workflow, self.results = root / "workflow", root / "results"
        self.workflow.mkdir()
        (self.workflow / "study.toml").write_text('title = "Made-up frame"\nseed = 1\nmeasured = "published"\nsteps = ["s9_diagnosis"]\n', encoding="utf-8")
        self.study = Study("frame", self.results, root / "data", self.workflow)

    def account(self, told):
        made_up_answer.write_diagnosis(self.results / "s9_diagnosis", told)
        return words_of(render("parts/diagnosis.html.j2", diagnosis=diagnosis.diagnosis_data(self.study, {}), where=None))

    def answer(self, told):
        made_up_answer.write_diagnosis(self.results / "s9_diagnosis", told)
        return words_of(render("parts/answers.html.j2", answers=answer.answers(self.study)))

    def test_five_sentences_and_no_word_of_a_truth(self):
        text = self.answer(made_up_answer.diagnosis())
        for part in (*made_up_answer.SENTENCES.values(), "Verdict: named"):
            self.assertIn(part, text)
        self.assertNotIn("Made-up frame", text, "the page's heading says it already")
        self.assertNotIn("hidden", text)
        self.assertNotIn("published", text, "measurements of one's own are not published")
        self.study.data.joinpath("paper").mkdir(parents=True)
        self.assertIn("Made-up frame (published measurements)", self.answer(made_up_answer.diagnosis()))

    def test_a_campaign_that_was_not_scored_says_nothing_of_the_truth(self):
        (self.results / "score").mkdir(parents=True)
        (self.results / "score/score.json").write_text(json.dumps({"schema": 1, "scored": False, "why": "no truth"}), encoding="utf-8")
        text = self.answer(made_up_answer.diagnosis())
        self.assertIn(made_up_answer.SENTENCES["what"], text)
        self.assertNotIn("hidden", text)

    def test_a_diagnosis_without_sentences_is_refused(self):
        told = made_up_answer.diagnosis()
        del told["sentences"]
        with self.assertRaisesRegex(InputError, "sentences: missing; .* run `make s9 STUDY=frame`"):
            self.answer(told)

    def test_one_number_of_odds_on_the_page(self):
        text = self.account(made_up_answer.diagnosis())
        self.assertIn("Log odds of something missing against nothing: 53.2", text)
        self.assertRegex(text, r"fric dampers:C1,C2 53\.2")
        self.assertIn("The likeliest of 2 entries that were fitted", text, "two more were screened out or have no row that shows them")
        card = text[text.index("How sure: likelier"):text.index("The likeliest of")]
        self.assertNotIn("log odds", card)
        self.assertIn("mass that the model does not have (the deck at x = 34 m), probability 0.11: mass 800 kg (600 kg … 1,100 kg)", card)
        self.assertIn("E_s 210 GPa (205 GPa to 216 GPa) 204 GPa (200 GPa to 209 GPa)", text)
        self.assertIn("the deck at x = 34 m (node 725) node:725", text)

    def test_an_unknown_that_the_data_do_not_show_has_no_number(self):
        told = made_up_answer.diagnosis()
        for side, words in (("open", "mass not known"), ("lower limit", "mass at least 600 kg"), ("upper limit", "mass at most 1,100 kg")):
            told["effects"][0]["rivals"][0]["parameters"][0]["one_sided"] = side
            self.assertIn(f"probability 0.11: {words}", self.account(told))
        own = told["effects"][0]["parameters"][0]
        own["one_sided"] = "open"
        self.assertRegex(self.account(told), r"How big: Fc not known \(90 %\)")

    def test_several_causes_are_counted(self):
        for count, words in ((1, "One cause explains it"), (2, "2 causes explain it together")):
            self.assertEqual(diagnosis.verdict_in_words({"verdict": "named", "effects": [{}] * count})[1], words)
        self.assertEqual(diagnosis.verdict_in_words({"verdict": "unknown", "effects": [{}] * 2})[1], diagnosis.VERDICTS["unknown"][1])

    def test_a_gain_whose_interval_holds_zero_is_not_claimed(self):
        gain = made_up_answer.diagnosis()["gain"]
        self.assertIn("No gain shown. Held out from the fit", self.account(made_up_answer.diagnosis(gain=gain | {"interval_pct": [-2.0, 40.0]})))
        self.assertNotIn("No gain shown", self.account(made_up_answer.diagnosis()))

    def test_what_cannot_be_asked_is_one_line(self):
        text = self.account(made_up_answer.diagnosis())
        self.assertEqual(text.count("Cannot be asked with these rows"), 1)


class Numbers(unittest.TestCase):
    def test_units_take_prefixes_and_numbers_no_exponents(self):
        for value, unit, text in ((2.1e11, "Pa", "210 GPa"), (8.24e6, "N/m", "8.24 MN/m"), (434.0, "N", "434 N"), (0.612, "-", "0.612"), (1500.0, "kg/m3", "1,500 kg/m3"),
                                  (18549.0, "kg", "18,500 kg"), (0.0, "Pa", "0 Pa"), (-2e3, "N", "-2 kN"), (0.00012, "1/K", "0.00012 1/K"), (800.0, "kg", "800 kg")):
            self.assertEqual(physical(value, unit), text)
        self.assertEqual(span({"value": 1.0, "low": 0.9, "high": 1.1}, ""), "1 (0.9 to 1.1)")


if __name__ == "__main__":
    unittest.main()
