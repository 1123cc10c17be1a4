"""The report of a study without a paper: its words, its warnings, its sections, in a browser at the widths of a telephone and a desk.

Oracle: a made-up study by construction (what its manifests warn of, what is wrong with its channels, where its supports are); closed forms of
phase collinearity and MAC; the browser itself for where links land and how large letters are.
"""
import html
import json
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

import browser  # noqa: E402
import made_up_study  # noqa: E402
from made_up_case import MadeUpCase  # noqa: E402
from twindeck_report import own_study  # noqa: E402
from twindeck_report.figures import updating_history  # noqa: E402
from twindeck_report.page import answer, chart, complexity, mac, marks, quality, spectra  # noqa: E402
from twindeck_report.study import Study  # noqa: E402

STEPS = ["s1_model", "s3_identification", "s4_refinement", "s5_sensitivity", "s6_updating"]
OF_THE_PAPER = (r"\bthe paper", r"\bEq\.", r"\b[Ss]ections? \d", r"\bFig\. ?\d", r"\bTables? \d", r"[Pp]ublished", r"Ponte", r"\bnot run\b", r"preliminary",
                r"as-built", r"fig_\d", r"reproduc", r"is missing: run", r"\bours\b", r"printed tables")
WARNED = {"s6_updating": ["the paired frequencies cannot tell E_c1, rho_2 apart: blame may fall on the wrong one"],
          "s1_model": ["material 'steel' has E = 210000 Pa: is E in <MPa>? Give pascals"],
          "s4_refinement": ["shapes disagree: 1X-1N (MAC 0.34)", "pairs: 9X is not among the measured modes and is passed over"]}


def set_manifest(folder, **values):
    path = folder / "manifest.json"
    path.write_text(json.dumps(json.loads(path.read_text(encoding="utf-8")) | values), encoding="utf-8")


def own_case(add_cleanup):
    """The made-up study without its paper: five steps, three of which warn, one dead and one clipped channel, a plane with two feet."""
    case = MadeUpCase(add_cleanup)
    shutil.rmtree(case.data / "paper")
    (case.workflow / "study.toml").write_text(f'title = "Made-up frame"\nseed = 1\nmeasured = "published"\nsteps = {json.dumps(STEPS)}\n', encoding="utf-8")
    for folder in case.results.iterdir():
        if folder.name not in STEPS:
            shutil.rmtree(folder)
    step = case.results / "s3_identification"
    shutil.copy(step / "features/channels.csv", step / "channels.csv")
    made_up_study.write_rows(step / "features/quality.csv",
                             ["setup", "record", "channel", "samples", "missing", "longest_gap", "clipped", "mean", "rms", "drift_rms", "dead", "lag_s", "lag_std_s"],
                             [["ST1", "wind.npy", f"P{i}z", 10000, 50 if i == 7 else 0, 12 if i == 7 else 0, 400 if i == 6 else 0, 0, 0.01, 0.02, int(i == 5),
                               0.05 if i == 8 else 0.0001, 0.001] for i in range(4, 12)])
    made_up_study.write_rows(step / "singular_values.csv", ["setup", "frequency_Hz", "sv1", "sv2", "condition"],
                             [["ST1", f, 1e-6 / (1e-3 + (f - 1.5) ** 2), 1e-9, "without_dampers"] for f in np.linspace(0.0, 3.0, 61)])
    nodes = [int(float(r["node"])) for r in made_up_study.read_rows(case.results / "s1_model/model/nodes.csv")]
    for model in case.results.glob("s*/model"):
        made_up_study.write_rows(model / "supports.csv", ["support", "node", "x", "y", "z", "rx", "ry", "rz"],
                                 [["plane", n, 0, 1, 0, 0, 0, 0] for n in nodes[2:]] + [["foot", n, 1, 1, 1, 0, 0, 0] for n in nodes[:2]])
    for token in STEPS:
        made_up_study.write_manifest(case.results / token)
        set_manifest(case.results / token, warnings=WARNED.get(token, []))
    return case


def visible(page):
    """The page's words without style, scripts, and the configurations as the user wrote them."""
    page = re.sub(r"<(script|style|pre)\b.*?</\1>", " ", page, flags=re.S)
    return " ".join(html.unescape(re.sub(r"<[^>]+>", " ", page)).split())


class OwnReport(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = own_case(cls.addClassCleanup)
        cls.write_page()

    @classmethod
    def write_page(cls):
        for command in ("tables", "figures", "report"):
            code, _, err = cls.case.run(command)
            assert code == 0, err
        cls.page = (cls.case.results / "report/report.html").read_text(encoding="utf-8")
        cls.text = visible(cls.page)

    def section(self, name):
        return re.search(rf'<section id="{name}">.*?</section>', self.page, flags=re.S).group()

    def test_nothing_of_the_paper(self):
        for words in OF_THE_PAPER:
            found = re.search(words, self.text)
            self.assertIsNone(found, f"{words}: …{self.text[max(0, found.start() - 60):found.end() + 60] if found else ''}…")

    def test_the_list_of_words_notices_the_papers_page(self):
        """The watch itself can fail: captions of the study with a paper hold these words."""
        from twindeck_report.figures import fig_01, sensitivity_map, updating_history

        held = " ".join((fig_01.CAPTION, sensitivity_map.__doc__, updating_history.CAPTION))
        self.assertGreater(sum(re.search(words, held) is not None for words in OF_THE_PAPER), 3)

    def test_every_warning_with_its_step_and_the_worst_first(self):
        told = [visible(item) for item in re.findall(r"<li class=.*?</li>", self.section("warnings"), flags=re.S)]
        for step, texts in WARNED.items():
            for text in texts:
                self.assertEqual(sum(item.startswith(step) and item.endswith(text) for item in told), 1, (step, text))
        rank = [0 if "not finished" in item else 1 if "may be wrong" in item else 2 for item in told]
        self.assertEqual(rank, sorted(rank))
        self.assertTrue(told[0].startswith("s1_model"), "of equal rank, the earlier step's comes first")
        self.assertIn(f"{len(told)} warnings of the steps", self.text)

    def test_a_step_that_did_not_converge_stands_above_all(self):
        folder = self.case.results / "s5_sensitivity"
        set_manifest(folder, status="unconverged", message="the norm stayed at 3")
        self.addCleanup(self.write_page)
        self.addCleanup(set_manifest, folder, status="converged", message="")
        beside = self.case.results / "s6_updating.unconverged"
        beside.mkdir()
        self.addCleanup(beside.rmdir)
        OwnReport.write_page()
        told = [visible(item) for item in re.findall(r"<li class=.*?</li>", self.section("warnings"), flags=re.S)]
        self.assertEqual(told[0], "s5_sensitivity not finished the norm stayed at 3")
        self.assertTrue(told[1].startswith("s6_updating not finished the last run is not what this page shows"))

    def test_channels_tell_what_is_odd(self):
        """P5z is dead, P6z clipped in 4 %, P7z lacks 0.5 %, P8z is 50 ms late; the others, 0.1 ms late, are sound."""
        rows = [visible(row) for row in re.findall(r"<tr><td>.*?</tr>", self.section("quality"), flags=re.S)]
        self.assertEqual(len(rows), 8)
        for name, words in (("P5z", "dead: it does not move at all"), ("P6z", "4 % of the samples clipped"), ("P7z", "0.5 % missing, longest gap 12 samples"),
                            ("P8z", "clock 50 ms behind the first channel's")):
            self.assertIn(words, next(row for row in rows[:4] if row.startswith(name)))
        self.assertTrue(all("nothing" in row for row in rows[4:]))
        told = visible(self.section("warnings"))
        self.assertIn("numbers may be wrong records: dead: P5z (ST1)", told)
        self.assertIn("read with care records: clipped: P6z (ST1)", told)

    def test_a_chart_a_record_and_a_chart_a_channel(self):
        spectra = self.section("spectra")
        self.assertEqual(spectra.count("<figcaption>ST1, without dampers</figcaption>"), 1)
        self.assertEqual(spectra.count("<figcaption>P4z</figcaption>"), 2, "without dampers and with")
        self.assertEqual(self.section("complexity").count("<svg"), 10, "one a mode of the printed ten")
        self.assertIn("Measured modes with each other", self.section("mac"))

    def test_sensors_and_supports_on_the_model(self):
        layout = self.section("layout")
        self.assertEqual(layout.count('class="sensor"'), 8)
        self.assertEqual(layout.count('class="support"'), 2, "what all nodes have held is the plane, not a support")
        self.assertIn("<title>support foot: holds x, z</title>", layout)

    def test_shapes_of_every_condition_move(self):
        told = json.loads(re.search(r'id="twindeck-data">(.*?)</script>', self.page, flags=re.S).group(1))["modes"]
        self.assertEqual([s["title"] for s in told["sets"]], ["Identified, without dampers", "Identified, with dampers", "Updated model", "Model as designed"])
        self.assertEqual([len(s["modes"]) for s in told["sets"][:2]], [10, 10])

    def test_pictures_have_sizes_and_links_have_places(self):
        pictures = re.findall(r"<img[^>]*>", self.page)
        self.assertTrue(all(re.search(r'width="\d+" height="\d+"', p) for p in pictures if "src=" in p))
        self.assertGreater(sum("src=" in p for p in pictures), 1)
        for target in re.findall(r'href="#([^"]+)"', self.page):
            self.assertEqual(self.page.count(f'id="{target}"'), 1, target)

    def test_no_columns_of_a_paper(self):
        header = (self.case.results / "tables/selection.csv").read_text(encoding="utf-8").splitlines()[0]
        self.assertIn("reason" if "reason" in header else "score", header)
        self.assertNotIn("published", header)

    @unittest.skipUnless(browser.program(), "no Chromium here: the page is not looked at in a browser")
    def test_at_two_widths(self):
        with browser.Browser(webgl=False) as b:
            for width, height in ((390, 844), (1400, 900)):
                b.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
                b.open((self.case.results / "report/report.html").resolve())
                b.run("document.documentElement.style.scrollBehavior = 'auto'")
                self.assertLessEqual(b.run("document.documentElement.scrollWidth"), width)
                letters = b.run("""['#poles svg .tick', '#spectra svg .tick', '.layout text'].map(n => {
                  const t = document.querySelector(n); return parseFloat(getComputedStyle(t).fontSize) * t.getScreenCTM().a; })""")
                self.assertGreater(min(letters), 8.0, f"letters of the diagrams in pixels at {width}: {letters}")
                for name in ("warnings", "spectra", "figures"):
                    b.run(f"location.hash = '#{name}'")
                    top = b.run(f"new Promise(r => setTimeout(() => r(document.getElementById('{name}').getBoundingClientRect().top), 300))")
                    self.assertLess(abs(top), 60.0, f"the link to {name} lands where it points at {width}")
            self.ramps_stay_in_the_picture(b)
            self.assertEqual(b.errors, [])

    def ramps_stay_in_the_picture(self, b):
        """A deck of 1000 points, 100 m long, and ten points of a ramp that leads 500 m away: all inside a narrow picture and a wide one."""
        outside = b.run("""(() => {
          const points = new Float32Array(3 * 1010), out = new Float32Array(3 * 1010);
          for (let i = 0; i < 1010; ++i)
            points.set(i < 1000 ? [i % 100, Math.floor(i / 100) * 0.5, 10] : [100 + 50 * (i - 999), 3 * (i - 999), 10 - (i - 999)], 3 * i);
          let found = 0;
          for (const [width, height] of [[360, 500], [1100, 500]])
            for (const view of ['space', 'plan', 'side', 'end']) {
              const orbit = new twindeck.modes.viewer.orbit.constructor(points);
              orbit.aspect = width / height;
              orbit.home(view);
              orbit.project(points, width, height, out);
              for (let i = 0; i < out.length; i += 3) found += out[i] < 0 || out[i] > width || out[i + 1] < 0 || out[i + 1] > height;
            }
          return found; })()""")
        self.assertEqual(outside, 0)


class Numbers(unittest.TestCase):
    """Parameters that begin at 0 or below it, and channels whose names are words for nothing. Oracle: the files as they are written here."""

    def setUp(self):
        root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.study = Study("made_up", root / "results", root / "data", root / "workflow")
        (root / "workflow").mkdir()
        (root / "workflow/study.toml").write_text('steps = ["s3_identification", "s6_updating"]\n')

    def write(self, name, header, rows):
        path = self.study.results / name
        path.parent.mkdir(parents=True, exist_ok=True)
        made_up_study.write_rows(path, header, rows)

    def test_a_parameter_that_begins_at_zero_has_no_per_cent(self):
        """Step 6 leaves its change empty, and divides it by its range in history.csv: 0 to 300 kg of -200 to 600 kg is 0 to 0.375."""
        self.write("s6_updating/summary.csv", ["quantity", "value"], [["pairs", 2], ["mean_abs_error_before_pct", 3], ["mean_abs_error_after_pct", 1]])
        self.write("s6_updating/parameters.csv", ["parameter", "unit", "initial_value", "final_value", "change_pct", "lower", "upper", "bound"],
                   [["mass", "kg", 0, 300, "", -200, 600, "none"], ["k", "-", 1, 1.1, 10, 0.5, 2, "none"], ["offset", "m", -2, -3, 50, -3, -1, "lower"]])
        self.write("s6_updating/starts.csv", ["start", "cost", "converged"], [[0, 1.0, 1]])
        self.write("s6_updating/history.csv", ["start", "outer", "iteration", "cost", "step_norm", "trust_radius", "mass", "k", "offset"],
                   [[0, 0, 0, 2.0, 0.0, 2.0, 0.0, 1.0, -1.0], [0, 0, 1, 1.0, 0.6, 2.0, 0.375, 1.1, -1.5]])
        self.assertIn("Changed: offset +50.0 % (on its lower bound), k +10.0 %, mass from 0 to 300 kg.", answer._updating(self.study))
        figure, _ = updating_history.draw(self.study)
        for axes, initial, (low, high) in zip(figure.axes[2:], (0.0, 1.0, -1.0), ((-0.25, 0.75), (0.5, 2.0), (-1.5, -0.5))):
            margin = 0.12 * (high - low)
            np.testing.assert_allclose(axes.get_ylim(), (low - margin, high + margin), err_msg=f"of {axes.get_title(loc='left')}")
            self.assertAlmostEqual(axes.lines[0].get_ydata()[0], initial)

    def test_rms_values_have_the_units_they_are_written_in(self):
        """Step 3 multiplies by the gain: what a logger recorded in mg stands in quality.csv in m/s²; volts without a scale stay volts."""
        self.write("s3_identification/channels.csv", ["channel", "quantity", "unit", "gain"],
                   [["a", "acceleration", "mg", 9.80665e-3], ["v", "velocity", "mm/s", 1e-3], ["u", "acceleration", "V", 1], ["n", "", "g", 9.80665]])
        self.assertEqual(quality._units(self.study), {"a": "m/s²", "v": "m/s", "u": "V", "n": "m/s²"})

    def test_setups_stand_beside_their_own_blind_tests(self):
        """S1 finds two of three modes and one that is none, S2 none at all; S3 was not tested."""
        setups = pd.DataFrame({"setup": ["S1", "S2", "S3"], "family": "string", "channels": 4, "R_k": [0.1, 0.2, 0.3], "rank": [1, 2, 3], "draws": 9})
        self.write("s2_sensors/blind_test.csv", ["setup", "mode", "found"], [["S1", 1, 1], ["S1", 2, 0], ["S1", 3, 1], ["S1", "spurious", 0],
                                                                             ["S2", 1, 0], ["S2", 2, 0], ["S2", 3, 0]])
        table = own_study._with_blind_test(self.study, setups)
        self.assertEqual(list(table.columns), ["setup", "family", "channels", "R_k", "rank", "modes_found", "of_modes", "modes_missed", "found_that_is_none"])
        told = table[["modes_found", "of_modes", "modes_missed", "found_that_is_none"]].astype(object).where(table[table.columns[-4:]].notna(), "")
        self.assertEqual(told.to_numpy().tolist(), [[2, 3, "2", 1], [0, 3, "1 2 3", 0], ["", "", "", ""]])

    def test_a_channel_may_be_called_na(self):
        """NA, nan and null are names too: a channel at the north abutment, for one."""
        rows = [[name, f, 1e-3, "ST1", "calm"] for name in ("NA", "null", "P1") for f in (0.0, 1.0, 2.0)]
        self.write("s3_identification/psd.csv", ["channel", "frequency_Hz", "psd_m2_s3", "setup", "condition"], rows)
        self.write("s3_identification/modes.csv", ["mode", "frequency_Hz"], [[1, 1.0]])
        self.assertEqual([c["name"] for c in spectra.spectra(self.study)["records"][0]["channels"]], ["NA", "null", "P1"])


class Pieces(unittest.TestCase):
    def test_phase_collinearity(self):
        """1 on a line whatever its angle; 0 on a circle; ((4 - 1) / (4 + 1))^2 for two components at right angles, 2 and 1 long."""
        line = np.array([1.0, -0.4, 0.7]) * np.exp(0.7j)
        self.assertAlmostEqual(complexity.phase_collinearity(line), 1.0, places=12)
        self.assertAlmostEqual(complexity.phase_collinearity(np.exp(2j * np.pi * np.arange(8) / 8)), 0.0, places=12)
        self.assertAlmostEqual(complexity.phase_collinearity(np.array([2.0, 1.0j])), 0.36, places=12)
        np.testing.assert_allclose(complexity.turned(line), [1.0, -0.4, 0.7], atol=1e-12)

    def test_mac(self):
        a = np.array([1.0, 2.0, np.nan, 1j])
        self.assertAlmostEqual(mac.mac(a, 3j * a), 1.0, places=12)
        self.assertAlmostEqual(mac.mac(np.array([1.0, 1.0]), np.array([1.0, -1.0])), 0.0, places=12)
        self.assertAlmostEqual(mac.mac(np.array([1.0, 0.0]), np.array([1.0, 1.0])), 0.5, places=12)

    def test_a_thinned_curve_keeps_its_peak(self):
        values = np.ones(10007)
        values[7777] = 50.0
        f, v = chart.thinned(np.arange(10007.0), values)
        self.assertLessEqual(len(f), chart.MOST_POINTS)
        self.assertEqual(v.max(), 50.0)
        self.assertEqual(f[v.argmax()], 7777.0)

    def test_ticks_are_round(self):
        self.assertEqual(chart.ticks(0.0, 3.0, 6), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0])
        self.assertEqual(chart.ticks(1.3, 2.2, 6), [1.4, 1.6, 1.8, 2.0, 2.2])

    def test_marks_of_one_node_become_one(self):
        found = [{"kind": "support", "at": [0.0, 0.0, 0.0], "words": "support foot: holds z"}, {"kind": "turning", "at": [0.0, 0.0, 0.0], "words": "base: spring 12 MN m/rad"},
                 {"kind": "support", "at": [5.0, 0.0, 0.0], "words": "support pin: holds x"}]
        self.assertEqual([(m["kind"], m["words"]) for m in marks.by_node(found)],
                         [("spring", "support foot: holds z; base: spring 12 MN m/rad"), ("support", "support pin: holds x")])

    def test_springs_in_words(self):
        case = own_case(self.addCleanup)
        model = case.results / "s1_model/model"
        made_up_study.write_rows(model / "springs.csv", ["spring", "group", "node", "node2", "direction_x", "direction_y", "direction_z", "quantity", "stiffness_N_m",
                                                         "damping_N_s_m", "friction_N", "arrangement", "active"],
                                 [["base_1", "base", 1, "", 0, 1, 0, "rotation", 12e6, 0, 0, "parallel", 1], ["C1", "damper", 2, "", 0, 0, 1, "translation", 0, 2e5, 0, "series", 1],
                                  ["off", "damper", 2, "", 0, 0, 1, "translation", 1e3, 0, 0, "parallel", 0]])
        study = Study("made_up", case.results, case.data, case.workflow)
        found = {m["words"]: m["kind"] for m in marks.marks(study, "s1_model/model")}
        self.assertEqual(found["base_1: spring 12 MN m/rad, turning"], "turning")
        self.assertEqual(found["C1: damper 200 kN s/m"], "spring")
        self.assertFalse(any("off" in words for words in found))


if __name__ == "__main__":
    unittest.main()
