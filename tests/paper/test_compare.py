"""Two runs beside each other. Oracle: runs that differ by what is planted in them (made_up_runs.py), and that a run compared with itself
differs in nothing."""
import contextlib
import csv
import io
import os
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(HERE), str(ROOT / "paper"), str(ROOT / "python")]

import made_up_answer  # noqa: E402
import made_up_runs as made  # noqa: E402
import twindeck  # noqa: E402
from twindeck_compare.cli import main  # noqa: E402

Z_90 = 1.6448536269514722  # normal quantile of 0.95: half of a 90 % interval over the standard deviation


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.a, self.b = self.folder / "before", self.folder / "after"

    def row(self, found, item, quantity):
        table = found.table
        rows = table[(table["item"] == item) & (table["quantity"] == quantity)].to_dict("records")
        self.assertEqual(len(rows), 1, f"{item} {quantity}: {rows}")
        return rows[0]

    def run_compare(self, *arguments):
        """@return (exit code, printed, on stderr)"""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main([*map(str, arguments), "--out", str(self.folder / "compare")])
        return code, out.getvalue(), err.getvalue()


class Options(InFolder):
    def test_what_was_asked_differently(self):
        made.identified(self.a, [2.0, 3.0, 5.0], made.SHAPES, inputs={"x/records/r.npy": "aa" * 32, "x/channels.csv": "bb" * 32}, seed=1)
        made.identified(self.b, [2.0, 3.0, 5.0], made.SHAPES, config="blocks = 10\nband.highest = 8  # Hz\n", seed=2, version="0.2.0",
                        inputs={"y/records/r.npy": "aa" * 32, "y/channels.csv": "cc" * 32}, warnings=["clock lags"])
        found = twindeck.compare(self.a, self.b)
        self.assertEqual([(r["quantity"], r["a"], r["b"]) for r in found.options.to_dict("records") if r["part"] == "options"],
                         [("blocks", "20", "10"), ("seed", "1", "2"), ("version", "0.1.0", "0.2.0")])
        self.assertEqual(self.row(found, "configuration", "band.highest")["a"], "8 Hz")
        inputs = found.table[found.table["part"] == "inputs"]
        self.assertEqual(sorted(inputs["status"]), ["differs", "same"], "the same bytes in another folder are the same input")
        self.assertEqual(self.row(found, "warning", "")["status"], "only in B")

    def test_what_all_steps_say_of_the_program_is_said_once(self):
        for folder, version in ((self.a, "0.1.0"), (self.b, "0.2.0")):
            made.identified(folder, [2.0, 3.0, 5.0], made.SHAPES, version=version)
            made.updated(folder, {"k": 1.1}, version=version, seed=1 if folder == self.a else 7)
        found = twindeck.compare(self.a, self.b)
        self.assertEqual(found.changed[["step", "quantity", "b"]].values.tolist(), [["all steps", "version", "0.2.0"], ["s6_updating", "seed", "7"]])

    def test_a_runs_own_files_are_named_within_the_run(self):
        for folder, root in ((self.a, "results/x"), (self.b, "/elsewhere/y")):
            made.updated(folder, {"k": 1.1}, root=root, inputs={f"{root}/s3_identification/features/rows.csv": "aa" * 32})
        found = twindeck.compare(self.a, self.b)
        self.assertEqual(self.row(found, "file", "{results}/s3_identification/features/rows.csv")["status"], "same")


class Results(InFolder):
    def test_a_run_differs_from_itself_in_nothing(self):
        made.identified(self.a, [2.0, 3.0, 5.0], made.SHAPES)
        made.updated(self.a, {"k": 1.1})
        made.diagnosed(self.a, made_up_answer.diagnosis())
        found = twindeck.compare(self.a, self.a)
        self.assertEqual(len(found.changed), 0)
        self.assertGreater(len(found.table), 40)

    def test_a_moved_frequency_in_standard_deviations(self):
        made.identified(self.a, [2.0, 3.0, 5.0], made.SHAPES)
        made.identified(self.b, [2.01, 3.0, 5.0], made.SHAPES)
        found = twindeck.compare(self.a, self.b)
        row = self.row(found, "mode 1", "frequency_Hz")
        self.assertEqual((row["unit"], row["status"]), ("Hz", "moved"))
        self.assertAlmostEqual(row["change"], 0.01)
        self.assertAlmostEqual(row["change_pct"], 0.5)
        self.assertAlmostEqual(row["change_in_std"], 0.01 / 0.005)
        self.assertEqual(len(found.changed), 1)

    def test_modes_are_paired_by_shape_and_not_by_number(self):
        """B has one mode more, between the first and the second of A, with a shape of its own."""
        four = {1: (1.0, 0.5, 0.0, 0.0), 2: (-0.5, 1.0, 0.0, 0.0), 3: (0.0, 0.0, 1.0, 0.0)}
        made.identified(self.a, [2.0, 3.0, 5.0], four)
        made.identified(self.b, [2.0, 2.5, 3.0, 5.0], {1: four[1], 2: (0.0, 0.0, 0.0, 1.0), 3: tuple(-v for v in four[2]), 4: four[3]})
        found = twindeck.compare(self.a, self.b)
        self.assertEqual(self.row(found, "mode 2 (B: mode 3)", "frequency_Hz")["status"], "same")
        self.assertEqual(self.row(found, "mode 2 (B: mode 3)", "MAC with A's shape")["b"], 1.0)
        self.assertEqual(self.row(found, "mode 2", "frequency_Hz")["status"], "only in B")
        self.assertEqual({r["item"] for r in found.changed.to_dict("records")}, {"mode 2"})

    def test_close_modes_that_turned_stay_together(self):
        """Two modes 0.1 % apart turn by 45 degrees in their plane: every MAC is 0.5, their frequencies tell which is which."""
        made.identified(self.a, [3.000, 3.003], {1: (1.0, 0.0), 2: (0.0, 1.0)})
        made.identified(self.b, [3.000, 3.003], {1: (1.0, 1.01), 2: (-1.01, 1.0)})
        found = twindeck.compare(self.a, self.b)
        self.assertEqual({r["status"] for r in found.table.to_dict("records") if r["quantity"] == "frequency_Hz"}, {"same"})

    def test_other_channels_are_paired_by_number_and_said(self):
        made.identified(self.a, [2.0, 3.0], {1: (1.0, 0.5), 2: (-0.5, 1.0)})
        made.identified(self.b, [2.1, 3.0], {1: (1.0, 0.5, 0.1), 2: (-0.5, 1.0, 0.1)})
        found = twindeck.compare(self.a, self.b)
        self.assertIn("paired by their number", found.notes[0])
        self.assertAlmostEqual(self.row(found, "mode 1", "frequency_Hz")["change"], 0.1)

    def test_modes_are_those_of_the_same_condition(self):
        """B looked at the storm alone, whose modes are then its first list; they are A's second."""
        made.identified_in(self.a, {"calm": 2.0, "storm": 1.9})
        made.identified_in(self.b, {"storm": 1.9})
        found = twindeck.compare(self.a, self.b)
        self.assertEqual(self.row(found, "mode 1 (storm)", "frequency_Hz")["status"], "same")
        self.assertIn("s3_identification: modes of condition calm stand in A alone", found.notes)
        self.assertEqual([r["item"] for r in found.table.to_dict("records") if r["quantity"] == "frequency_Hz"], ["mode 1 (storm)"])

    def test_one_condition_that_each_run_calls_otherwise(self):
        made.identified_in(self.a, {"summer": 2.0})
        made.identified_in(self.b, {"winter": 2.1})
        found = twindeck.compare(self.a, self.b)
        self.assertAlmostEqual(self.row(found, "mode 1", "frequency_Hz")["change"], 0.1)
        self.assertIn("s3_identification: modes of condition summer in A are held against those of winter in B", found.notes)

    def test_parameters_of_one_run_only(self):
        made.updated(self.a, {"k": 0.5, "m": 1.1}, computed=2.0)
        made.updated(self.b, {"k": 0.5, "E": 2}, computed=2.2)
        found = twindeck.compare(self.a, self.b)
        self.assertEqual(self.row(found, "k", "final_value")["status"], "same")
        self.assertEqual(self.row(found, "m", "final_value")["status"], "only in A")
        self.assertEqual((self.row(found, "E", "bound")["status"], self.row(found, "E", "bound")["b"]), ("only in B", "upper"))
        self.assertAlmostEqual(self.row(found, "after 1X", "computed_Hz")["change_pct"], 10.0)

    def test_a_stated_deviation_of_a_parameter_is_used(self):
        """A table of parameters that states standard deviations: the larger of both is what the change is held against."""
        for folder, value, std in ((self.a, 1.0, 0.02), (self.b, 1.1, 0.05)):
            made.write_step(folder / "s6_updating", "s6_updating", {"parameters.csv": ([*made.PARAMETERS, "final_value_std"],
                                                                                      [["k", "-", 1, value, 0, 0, 2, "none", std]])})
        self.assertAlmostEqual(self.row(twindeck.compare(self.a, self.b), "k", "final_value")["change_in_std"], 0.1 / 0.05)

    def test_critical_speeds_of_one_model_at_several_dampings(self):
        """B leaves model A out but for the row at another damping, as a study of the damping asks for; no speed moved. B's dampings are whole
        numbers, which are written without a point."""
        made.in_wind(self.a, {("A", 0.5): 17.79, ("C", 1.0): 20.5, ("A", 1.0): 21.04})
        made.in_wind(self.b, {("C", 1): 20.5, ("A", 1): 21.04})
        found = twindeck.compare(self.a, self.b)
        speeds = found.results[found.results["quantity"] == "V_cr_m_s"]
        self.assertEqual(dict(zip(speeds["item"], speeds["status"])),
                         {"standin A off 0.5 %": "only in A", "standin C off 1 %": "same", "standin A off 1 %": "same"})

    def test_diagnoses(self):
        one = made_up_answer.diagnosis()
        made.diagnosed(self.a, one)
        other = made_up_answer.diagnosis(verdict="unknown", effects=[], gain={**one["gain"], "reduction_pct": 35.0}, parameters_on_bounds=["E_s"],
                                         model_parameters=[{**one["model_parameters"][0], "after": {"value": 2.07e11, "low": 2.04e11, "high": 2.1e11}}])
        made.diagnosed(self.b, other)
        found = twindeck.compare(self.a, self.b)
        verdict = self.row(found, "verdict", "")
        self.assertEqual((verdict["a"], verdict["b"]), ("named", "unknown"))
        self.assertEqual(self.row(found, "effect fric at dampers:C1,C2", "probability")["status"], "only in A")
        self.assertEqual(self.row(found, "effect fric at dampers:C1,C2", "Fc_N")["unit"], "N")
        self.assertAlmostEqual(self.row(found, "gain", "reduction_pct")["change_in_std"], 10.0 / ((40.0 - 8.0) / 2 / Z_90))
        # 90 % intervals 9 and 6 GPa wide, on both sides of it; the larger standard deviation is A's
        self.assertAlmostEqual(self.row(found, "parameter E_s", "after")["change_in_std"], 3e9 / (9e9 / 2 / Z_90))
        self.assertEqual(self.row(found, "parameter on a bound", "")["b"], "E_s")

    def test_steps_of_one_run_only(self):
        made.identified(self.a, [2.0, 3.0, 5.0], made.SHAPES)
        made.updated(self.a, {"k": 0.5})
        made.identified(self.b, [2.0, 3.0, 5.0], made.SHAPES)
        (self.b / "s9_diagnosis").mkdir()
        found = twindeck.compare(self.a, self.b)
        self.assertEqual(found.changed[["step", "quantity", "status"]].values.tolist(), [["s6_updating", "finished", "only in A"]])
        self.assertEqual(found.notes, ["s9_diagnosis of B is not finished: it has no manifest.json"])


class Balance(HTMLParser):
    """Tags that are closed in another order than they were opened, and links that leave the page."""

    def __init__(self):
        super().__init__()
        self.open, self.wrong, self.outside, self.ids, self.targets = [], [], [], set(), set()

    def handle_starttag(self, tag, attributes):
        told = dict(attributes)
        if tag != "meta":
            self.open.append(tag)
        self.ids.add(told.get("id"))
        for link in (told.get("href"), told.get("src")):
            if link and link.startswith("#"):
                self.targets.add(link[1:])
            elif link:
                self.outside.append(link)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append((tag, self.getpos()))


class Page(InFolder):
    def setUp(self):
        super().setUp()
        made.identified(self.a, [2.0, 3.0, 5.0], made.SHAPES)
        made.identified(self.b, [2.02, 3.0, 5.0], made.SHAPES, config="blocks = 10\n")
        made.updated(self.a, {"k": 0.5, "m<b>": 1.0})
        made.updated(self.b, {"k": 0.6})
        made.diagnosed(self.a, made_up_answer.diagnosis())
        made.diagnosed(self.b, made_up_answer.diagnosis(verdict="none", effects=[]))

    def test_terminal_table_and_page(self):
        code, printed, err = self.run_compare(self.a, self.b)
        self.assertEqual((code, err), (0, ""))
        self.assertLess(len(printed.splitlines()), 60, "a short page")
        lines = " ".join(printed.split())
        for told in ("A before", "B after", "blocks 20 10", "verdict named none", "k final value 0.5 0.6 +20 %", "mode 1 frequency 2 2.02 Hz +1 % 4"):
            self.assertIn(told, lines)
        with open(self.folder / "compare/before__after.csv", newline="", encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual(len(rows), len(twindeck.compare(self.a, self.b).table))
        moved = next(r for r in rows if (r["item"], r["quantity"]) == ("mode 1", "frequency_Hz"))
        self.assertAlmostEqual(float(moved["change_in_std"]), 4.0)
        page = (self.folder / "compare/before__after.html").read_text(encoding="utf-8")
        reader = Balance()
        reader.feed(page)
        self.assertEqual((reader.wrong, reader.open, reader.outside), ([], [], []))
        self.assertLessEqual(reader.targets, reader.ids)
        self.assertNotIn("m<b>", page)
        self.assertIn("2.02", page)

    def test_same_runs_same_bytes(self):
        pages = []
        for _ in range(2):
            self.run_compare(self.a, self.b)
            pages.append([(self.folder / f"compare/before__after.{end}").read_bytes() for end in ("csv", "html")])
        self.assertEqual(pages[0], pages[1])

    def test_nothing_differs(self):
        code, printed, _ = self.run_compare(self.a, self.a)
        self.assertEqual(code, 0)
        self.assertIn("nothing differs", printed)

    def test_names_of_runs_with_equal_folders(self):
        code, printed, _ = self.run_compare(self.a / "s6_updating", self.b / "s6_updating")
        self.assertEqual(code, 0)
        self.assertIn("A before/s6_updating", " ".join(printed.split()))
        self.assertTrue((self.folder / "compare/before_s6_updating__after_s6_updating.csv").is_file())


class BadInput(InFolder):
    def setUp(self):
        super().setUp()
        made.updated(self.a, {"k": 0.5})
        made.updated(self.b, {"k": 0.6})

    def refused(self, *arguments, told):
        code, printed, err = self.run_compare(*arguments)
        self.assertEqual((code, printed), (2, ""))
        self.assertEqual(err.count("\n"), 1, err)
        for part in ("compare: ", *told):
            self.assertIn(part, err)
        self.assertFalse((self.folder / "compare").exists())

    def test_one_line_each(self):
        self.refused(self.a, self.folder / "nowhere", told=["nowhere", "no such folder"])
        self.refused(told=["make compare A=results/x B=results/y"])
        self.refused(self.a, "", told=["two runs are needed"])
        (self.folder / "empty").mkdir()
        self.refused(self.folder / "empty", self.b, told=["empty", "no manifest.json"])
        made.identified(self.folder / "other", [2.0, 3.0, 5.0], made.SHAPES)
        self.refused(self.a / "s6_updating", self.folder / "other/s3_identification", told=["s6_updating", "s3_identification", "the same steps"])

    def test_files_that_changed_or_cannot_be_read(self):
        with open(self.b / "s6_updating/parameters.csv", "a", encoding="utf-8") as stream:
            stream.write("m,-,1,1,0,0,2,none\n")
        self.refused(self.a, self.b, told=["s6_updating/parameters.csv", "changed since s6_updating wrote it"])
        (self.b / "s6_updating/manifest.json").write_text("{", encoding="utf-8")
        self.refused(self.a, self.b, told=["manifest.json", "not valid JSON"])
        (self.b / "s6_updating/manifest.json").write_text("[]", encoding="utf-8")
        self.refused(self.a, self.b, told=["manifest.json", "not the manifest of a step"])


class Make(InFolder):
    def test_the_target_hands_both_folders_on(self):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
        done = subprocess.run(["make", "-n", "compare", "A=results/x", "B=results/y"], cwd=ROOT, env=environment, capture_output=True, text=True)
        self.assertEqual(done.stdout.strip(), 'workflows/python.sh -m twindeck_compare "results/x" "results/y"', done.stderr)
        done = subprocess.run(["workflows/python.sh", "-m", "twindeck_compare", "", ""], cwd=ROOT, env=environment, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)


if __name__ == "__main__":
    unittest.main()
