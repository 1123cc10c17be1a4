"""An engineer's own study: `make new`, the template run untouched, faults in the user's own files, the reference page.

Oracles: the values of the frame that the template's features were made from; Make itself for what is up to date; the files' lines for
messages; the executables' --describe for the reference page.
"""

import csv
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ["TWINDECK_BIN"]).resolve()
sys.path[:0] = [str(ROOT / "paper"), str(ROOT / "tests/paper")]
import browser  # noqa: E402
import twindeck_reference.__main__ as reference  # noqa: E402


class OwnStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.holder.cleanup)
        cls.root = pathlib.Path(cls.holder.name)
        for part in ("workflows", "paper", "data/template", "data/wind"):
            shutil.copytree(ROOT / part, cls.root / part, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "Makefile", cls.root / "Makefile")
        cls.new = cls.make("new", "STUDY=mine")
        cls.all = cls.make("all", "STUDY=mine")

    @classmethod
    def make(cls, *arguments, root=None):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
        return subprocess.run(["make", "NO_BUILD=1", f"BIN={BIN}", *arguments], cwd=root or cls.root, env=environment, capture_output=True, text=True,
                              timeout=600)

    @unittest.skipUnless(browser.program(), "no Chromium here (Debian: apt-get install chromium): no mode is deleted by a click")
    def test_a_mode_deleted_by_a_click_is_gone_from_every_later_step(self):
        """The file that the page's picker downloads goes back by `keep`. The other modes stay as they were, and steps 3 to 9 run again."""
        root = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        for part in ("workflows", "paper", "data", "results", "Makefile"):
            (shutil.copytree if (self.root / part).is_dir() else shutil.copy2)(self.root / part, root / part)
        results = root / "results/mine"

        def rows(name):
            with open(results / name, newline="") as stream:
                return list(csv.DictReader(stream))

        before = rows("s3_identification/modes.csv")
        click = """(() => { const p = twindeck.poles, s = p.seen.find(s => s.p[4] === 3), at = new DOMPoint(s.x, s.y).matrixTransform(p.picture.getScreenCTM());
          for (const kind of ['pointerdown', 'pointerup']) p.picture.dispatchEvent(new PointerEvent(kind, { clientX: at.x, clientY: at.y })); })()"""
        with browser.Browser(webgl=False) as b:
            b.open(results / "report/report.html")
            b.run("location.hash = '#identification'")
            b.wait("twindeck.poles.drawn > 0")
            b.run(click)
            b.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(root / "data/mine"))
            b.run("document.querySelector('#poles [name=download]').click()")
            deadline = time.monotonic() + 60
            while not (root / "data/mine/modes_kept.csv").is_file() and time.monotonic() < deadline:
                time.sleep(0.1)
            self.assertEqual(b.errors, [])
        settings = root / "workflows/mine/s3_identification.toml"
        settings.write_text('keep = "data/mine/modes_kept.csv"\n' + settings.read_text(encoding="utf-8"), encoding="utf-8")
        done = self.make("report", "STUDY=mine", root=root)
        self.assertEqual(done.returncode, 0, done.stderr)
        for step in ("s3_identification", "s4_refinement", "s5_sensitivity", "s6_updating", "s9_diagnosis"):
            self.assertIn(f"{step}: done", done.stdout + done.stderr)
        after = rows("s3_identification/modes.csv")
        self.assertEqual([m["frequency_Hz"] for m in after], [m["frequency_Hz"] for m in before if m["mode"] != "3"])
        gone = float(before[2]["frequency_Hz"])
        for step in ("s4_refinement", "s6_updating"):
            told = {float(row["measured_Hz"]) for row in rows(f"{step}/comparison.csv") if row["measured_Hz"]}
            self.assertEqual(len(told), len(after))
            self.assertGreater(min(abs(f - gone) for f in told), 0.01 * gone)
        self.assertEqual({row["mode"] for row in rows("s9_diagnosis/residuals.csv") if row["type"] == "frequency_Hz"}, {m["mode"] for m in after})

    def test_template_runs_untouched_to_a_report(self):
        self.assertEqual(self.new.returncode, 0, self.new.stderr)
        self.assertEqual(self.all.returncode, 0, self.all.stderr)
        page = (self.root / "results/mine/report/report.html").read_text(encoding="utf-8")
        for part in ("two-storey frame", "Parameters after updating", "k_base", "data:image/png;base64,", 'id="mode-shapes"', 'id="poles"', "Nothing is missing",
                     "Modes identified from the records"):
            self.assertIn(part, page)
        for section in ("warnings", "layout", "quality", "spectra", "complexity", "mac"):
            self.assertIn(f'<section id="{section}">', page)
        self.assertIn("Nothing odd in 4 channels", page)
        words = re.sub(r"<(script|style|pre)\b.*?</\1>|<[^>]+>", " ", page, flags=re.S)
        first = " ".join(words[words.index("The answer in sentences"):words.index("All files were")].split())
        self.assertIn("What is wrong Nothing beyond what the error of the model&#39;s form allows.", first)
        self.assertRegex(first, r"What updating did Mean error of 4 frequencies: 6\.9\d % before, 0\.0\d % after\. Changed: k_base -4\d\.\d %, m_floor \+9\.\d %\.")
        self.assertNotRegex(words, r"the paper|Eq\.|[Ss]ection \d|Fig\. ?\d|[Pp]ublished|not run|preliminary", "nothing of the paper")
        self.assertNotIn("template", (self.root / "workflows/mine/study.toml").read_text().replace("the template", ""))

    def test_the_girder_runs_untouched_to_a_fragility_curve(self):
        self.assertFalse((self.root / "data/mine/girder").exists() or (self.root / "workflows/mine/girder").exists())
        self.assertEqual(self.make("new", "STUDY=other", "TEMPLATE=gider").returncode, 2)
        self.assertEqual(self.make("new", "STUDY=bridge", "TEMPLATE=girder").returncode, 0)
        done = self.make("all", "STUDY=bridge")
        self.assertEqual(done.returncode, 0, done.stderr)

        def rows(name):
            with open(self.root / "results/bridge" / name, newline="") as stream:
                return list(csv.DictReader(stream))

        # Galloping of the first mode: V = 4 m omega xi/(rho B |C_L' + C_D|), with the mass of 1 m after updating; the polar's moment is left out.
        critical = rows("s7_aerodynamics/critical.csv")[0]
        surfacing = float(rows("s6_updating/parameters.csv")[0]["final_value"])
        mass = 7850 * (2 * 0.0402 + 0.012 * 3.0 * 19 / 45) + 500 * surfacing
        closed = 4 * mass * 2 * 3.14159265 * float(critical["f_cr_Hz"]) * 0.006 / (1.25 * 3.6 * abs(-2.2 + 0.35))
        self.assertAlmostEqual(float(critical["V_cr_m_s"]) / closed, 1.0, delta=0.03)
        curve = [float(r["probability"]) for r in rows("s10_reliability/fragility.csv") if r["limit_state"] == "comfort_vertical" and float(r["years"]) == 0]
        self.assertEqual(curve, sorted(curve))
        self.assertLess(curve[0], 1e-6)
        self.assertGreater(curve[-1], 0.9)
        self.assertGreater(float(rows("s10_reliability/visible.csv")[0]["smallest_loss_m"]), 0.0)
        page = (self.root / "results/bridge/report/report.html").read_text(encoding="utf-8")
        for part in ('<section id="reliability">', "In which wind does the bridge become uncomfortable", "What monitoring would see", "instability (5 to 95 %)"):
            self.assertIn(part, page)

    def test_updating_finds_what_the_records_were_made_with(self):
        with open(self.root / "results/mine/s6_updating/parameters.csv", newline="") as stream:
            found = {row["parameter"]: float(row["final_value"]) for row in csv.DictReader(stream)}
        self.assertAlmostEqual(found["k_base"] / (7 / 12), 1.0, delta=0.05)
        self.assertAlmostEqual(found["m_floor"] / 1.10, 1.0, delta=0.01)

    def test_second_make_runs_no_step(self):
        again = self.make("all", "STUDY=mine")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertNotIn("s6_updating:", again.stdout + again.stderr)

    def test_every_column_is_described(self):
        for step in ("s1_model", "s3_identification", "s4_refinement", "s5_sensitivity", "s6_updating"):
            self.assertEqual(reference.undescribed(self.root / "results/mine" / step), [])

    def test_why_names_the_newer_file(self):
        self.assertIn("s6_updating: up to date", self.make("why", "s6", "STUDY=mine").stdout)
        file = self.root / "workflows/mine/s6_updating.toml"
        stamp = file.stat()
        newer = (self.root / "results/mine/s6_updating/manifest.json").stat().st_mtime + 10
        os.utime(file, (newer, newer))
        try:
            self.assertIn("older than workflows/mine/s6_updating.toml", self.make("why", "s6", "STUDY=mine").stdout)
        finally:
            os.utime(file, (stamp.st_atime, stamp.st_mtime))

    def test_faults_in_the_users_files_name_file_line_and_key(self):
        self.make("new", "STUDY=faulty")
        config = self.root / "workflows/faulty/s1_model.toml"
        lines = config.read_text().splitlines()
        config.write_text("\n".join(lines).replace("n_modes = 8", "n_mode = 8") + "\n")
        line = next(i for i, text in enumerate(lines, 1) if text.startswith("n_modes"))
        done = self.make("all", "STUDY=faulty")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(f"s1_model.toml:{line}: unknown key 'n_mode'; did you mean 'n_modes'?", done.stderr)
        config.write_text("\n".join(lines) + "\n")
        masses = self.root / "data/faulty/model/masses.csv"
        masses.write_text(masses.read_text().replace("floor,5,", "floor,500,", 1))
        done = self.make("all", "STUDY=faulty")
        self.assertIn("data/faulty/model/masses.csv:2: node: node 500 is not in nodes.csv", done.stderr)

    def test_without_records_step_3_says_what_to_do(self):
        self.make("new", "STUDY=modes_alone")
        shutil.rmtree(self.root / "data/modes_alone/campaign")
        done = self.make("s3", "STUDY=modes_alone")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("data/modes_alone/campaign/campaign.toml: does not exist", done.stderr)
        self.assertIn("takes s3_identification out of the steps in study.toml", done.stderr)

    def test_names_that_are_no_names_or_taken(self):
        for arguments, part in ((("new",), "is no name for a study"), (("new", "STUDY=My-Bridge"), "is no name"), (("new", "STUDY=mine"), "is there already")):
            done = self.make(*arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(part, done.stderr)

    def test_edited_result_is_noticed(self):
        file = self.root / "results/mine/s6_updating/parameters.csv"
        before = file.read_text()
        file.write_text(before.replace("m_floor", "m_flour"))
        done = self.make("verify", "STUDY=mine")
        page = self.make("report", "STUDY=mine")
        file.write_text(before)
        self.assertEqual(done.returncode, 2)
        self.assertIn("parameters.csv: stale hash", done.stderr)
        self.assertEqual(page.returncode, 2)
        self.assertIn("parameters.csv: stale hash", page.stderr)
        self.assertEqual(self.make("report", "STUDY=mine").returncode, 0)
        self.assertEqual(self.make("verify", "STUDY=mine").returncode, 0)

    def test_the_same_frame_as_an_inp_file_gives_the_same_parameters(self):
        self.make("new", "STUDY=inp")
        data, out = self.root / "data/inp", self.root / "exported" / "s1_model"
        done = subprocess.run([BIN / "s1_model", "--model", data / "model", "--out", out, "--export-inp"], capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, 0, done.stderr)
        shutil.copy(out / "model_abaqus.inp", data / "frame.inp")
        (data / "model" / "model.toml").rename(data / "frame.toml")
        shutil.rmtree(data / "model")
        study = self.root / "workflows/inp/study.toml"
        study.write_text(study.read_text().replace('folder = "data/inp/model"', 'inp = "data/inp/frame.inp"'))
        done = self.make("steps", "STUDY=inp")
        self.assertEqual(done.returncode, 0, done.stderr)

        def values(study):
            with open(self.root / f"results/{study}/s6_updating/parameters.csv", newline="") as stream:
                return {row["parameter"]: float(row["final_value"]) for row in csv.DictReader(stream)}

        self.assertEqual(values("inp").keys(), values("mine").keys())
        for name, value in values("inp").items():
            self.assertAlmostEqual(value / values("mine")[name], 1.0, delta=1e-5)

    def test_own_measured_modes_go_in_and_out_again(self):
        """Modes that are the model's own leave the parameters at 1; taken away again, the study's features count."""
        self.make("new", "STUDY=modes")
        self.make("s1", "STUDY=modes")
        (self.root / "measured").mkdir()
        with open(self.root / "results/modes/s1_model/modes.csv", newline="") as stream:
            rows = [f"{row['mode']},{row['frequency_Hz']},0.002" for row in csv.DictReader(stream)][:4]
        (self.root / "measured/modes.csv").write_text("\n".join(["mode,frequency_Hz,frequency_std_Hz", *rows]) + "\n")

        def parameters(*arguments):
            done = self.make("s6", "STUDY=modes", *arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(self.root / "results/modes/s6_updating/parameters.csv", newline="") as stream:
                return [float(row["final_value"]) for row in csv.DictReader(stream)], done.stderr

        for value in parameters("MODES=measured")[0]:
            self.assertAlmostEqual(value, 1.0, delta=1e-6)
        self.assertNotIn("s6_updating:", parameters("MODES=measured")[1])
        self.assertLess(min(parameters()[0]), 0.7)


class Reference(unittest.TestCase):
    def test_every_key_has_a_row(self):
        page = reference.page(BIN)
        for step in sorted(BIN.glob("s[0-9]*_*")):
            keys = reference.described(step)
            self.assertTrue(keys, step.name)
            self.assertIn(f"## {step.name}.toml", page)
        for key in ("`model.inp`", "`parameter.lower`", "`n_modes`", "`youngs_modulus_Pa`"):
            self.assertIn(f"| {key} |", page)


if __name__ == "__main__":
    unittest.main()
