"""The package of python/twindeck: its tutorial block by block, and what it reads, writes and refuses.

Oracle: what the page says is shown, to its stated digits; the properties of the structure that the measured modes stand for; files of the
repository's own template, which must come back unchanged.
"""

import ast
import contextlib
import doctest
import importlib
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent), str(ROOT / "python")]
import guide  # noqa: E402

try:
    import pandas as pd
    import twindeck
except ModuleNotFoundError as missing:  # an interpreter without pandas: nothing of this file can run
    raise unittest.SkipTest(str(missing)) from missing

BIN = pathlib.Path(os.environ["TWINDECK_BIN"]).resolve()
PAGE = ROOT / "docs" / "tutorial_python.md"
TEMPLATE = ROOT / "data" / "template"


def shown(block, names):
    """What a notebook shows of a block: what it prints, then the value of its last line. Spaces between columns count as one."""
    tree = ast.parse(block)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(tree, "<block>", "exec"), names)
        value = eval(compile(ast.Expression(last.value), "<block>", "eval"), names) if last is not None else None
    if isinstance(value, pd.DataFrame):
        out.write(value.to_string(index=False))
    elif value is not None and not isinstance(value, pathlib.Path):
        out.write(repr(value))
    return "\n".join(" ".join(line.split()) for line in out.getvalue().splitlines())


def spaced(text):
    return "\n".join(" ".join(line.split()) for line in text.splitlines())


class InFolder(unittest.TestCase):
    """Each test in an empty folder of its own, with this build's executables."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.enterContext(contextlib.chdir(self.folder))
        self.addCleanup(os.environ.__setitem__, "TWINDECK_BIN", os.environ["TWINDECK_BIN"])
        os.environ["TWINDECK_BIN"] = str(BIN)

    def refused(self, *parts):
        """A context in which an InputError must name all `parts`."""
        return self.assertRaisesRegex(twindeck.InputError, "".join(f"(?=.*{re.escape(p)})" for p in parts))


class Tutorial(InFolder):
    def test_every_block_shows_what_the_page_says(self):
        names, last, blocks = {"__name__": "notebook"}, "", 0
        for language, _, content in guide.blocks(PAGE.read_text(encoding="utf-8")):
            if language == "python":
                last, blocks = shown(content, names), blocks + 1
            elif language == "text":
                self.assertEqual(guide.differences(spaced(content), last), [])
        self.assertGreater(blocks, 10)
        # The structure's own factors, 0.4 and 1.3. Frequencies are rounded to 0.005 Hz, 0.2 % of the lowest; the least favourable of the
        # two parameters follows with 5 %.
        found = names["first"]["parameters"].set_index("parameter")["final_value"]
        self.assertAlmostEqual(found["k_bearing"] / 0.4, 1.0, delta=0.05)
        self.assertAlmostEqual(found["m_railing"] / 1.3, 1.0, delta=0.05)

    def test_examples_of_the_docstrings(self):
        for name in ("units", "model", "features", "running", "results", "tables", "writing"):
            module = importlib.import_module(f"twindeck.{name}")
            result = doctest.testmod(module, extraglobs={"pd": pd}, optionflags=doctest.ELLIPSIS)
            self.assertEqual(result.failed, 0, name)


class Reading(InFolder):
    def test_units_stand_in_the_frames(self):
        rows = {"frequency_Hz": "Hz", "frequency_std_Hz": "Hz", "damping_ratio_pct": "%", "stiffness_N_m": "N/m", "damping_N_s_m": "N s/m", "x_m": "m",
                "inertia_y_m4": "m4", "inertia_x_kg_m2": "kg m2", "psd_m2_s3": "m2/s3", "mode": "", "R_k": "", "k_base": "", "C_D": "", "pull_N": "N"}
        for column, unit in rows.items():
            self.assertEqual(twindeck.unit_of_column(column), unit, column)
        self.assertEqual(twindeck.read_model(TEMPLATE / "model")["nodes"].attrs["units"], {"x_m": "m", "y_m": "m", "z_m": "m"})

    def test_parameters_in_columns_are_ratios_without_a_unit(self):
        """The search begins at the initial values, which history.csv divides by: 1 of 2.1e11 Pa."""
        result = twindeck.run_step("s6", out="s6_updating", model=TEMPLATE / "model", features=TEMPLATE / "features", set={"starts": 1})
        self.assertEqual(result["history"]["E_steel"].iloc[0], 1.0)
        for table in ("history", "starts"):
            self.assertEqual({"E_steel", "k_base"} & set(result[table].attrs["units"]), set())
        self.assertEqual(result["parameters"]["bound"].isna().sum(), 0, "the text 'none' is a text")

    def test_a_table_changed_after_its_step_is_refused(self):
        result = twindeck.run_step("s1", out="s1_model", model=TEMPLATE / "model", set={"n_modes": 2})
        with open("s1_model/modes.csv", "a") as stream:
            stream.write("3,9.9,,,\n")
        with self.refused("s1_model/modes.csv", "changed since s1_model wrote it"):
            result["modes"]
        with self.refused("wrote no table 'moods'", "modes"):
            result["moods"]

    def test_what_is_no_finished_step_is_refused(self):
        os.mkdir("empty")
        with self.refused("nowhere", "no such folder"):
            twindeck.read_step("nowhere")
        with self.refused("manifest.json", "missing"):
            twindeck.read_step("empty")
        with self.refused("empty", "no manifest.json"):
            twindeck.read_run("empty")


class Writing(InFolder):
    def test_a_model_comes_back_as_it_was(self):
        """Frequencies of the template's model, read as frames and written again: the step's own twelve digits."""
        twindeck.read_model(TEMPLATE / "model").write("again")
        one, other = (twindeck.run_step("s1", out=f"{name}/s1_model", model=folder, set={"n_modes": 4})
                      for name, folder in (("a", TEMPLATE / "model"), ("b", "again")))
        self.assertEqual(one["modes"].to_csv(), other["modes"].to_csv())
        found = twindeck.run_step("s5", out="s5", model="again", set={"n_modes": 4})
        self.assertEqual(list(found["selection"]["parameter"]), ["k_base", "m_floor", "E_steel"])

    def test_features_come_back_as_they_were(self):
        given = twindeck.read_features(TEMPLATE / "features")
        given.write("again")
        again = twindeck.read_features("again")
        pd.testing.assert_frame_equal(given.rows, again.rows, rtol=1e-11)
        pd.testing.assert_frame_equal(given.channels, again.channels, check_dtype=False)  # 3.0 is written as 3
        self.assertEqual(given.conditions, again.conditions)
        errors = [twindeck.run_step("s4", out=f"{name}/s4", model=TEMPLATE / "model", features=folder, set={"n_modes": 4})["comparison"]["error_pct"]
                  for name, folder in (("a", TEMPLATE / "features"), ("b", "again"))]
        self.assertEqual(list(errors[0]), list(errors[1]))

    def test_a_covariance_replaces_standard_deviations(self):
        rows = pd.DataFrame({"type": "frequency_Hz", "mode": [1, 2], "value": [2.216, 7.598]})
        twindeck.write_features("measured", rows, covariance=[[4e-6, 1e-6], [1e-6, 4e-5]])
        self.assertEqual(twindeck.read_features("measured").covariance[0, 1], 1e-6)
        with self.refused("covariance: is 2, expected 2 x 2"):
            twindeck.write_features("measured", rows, covariance=[1.0, 2.0])
        twindeck.run_step("s4", out="s4", model=TEMPLATE / "model", features="measured", set={"n_modes": 4})

    def test_wrong_models_are_refused_and_leave_the_files(self):
        model = twindeck.read_model(TEMPLATE / "model")
        model.write("kept")
        before = {p.name: p.read_bytes() for p in pathlib.Path("kept").iterdir()}

        def attempt(*parts, parameters=model.parameters, **changed):
            with self.refused(*parts):
                twindeck.write_model("kept", parameters=parameters, settings=model.settings, **{**model.tables, **changed})

        nodes, elements = model["nodes"], model["elements"]
        attempt("nodes", "no column 'x_m'", "'x'", nodes=nodes.rename(columns={"x_m": "x"}))
        attempt("nodes", "unknown column 'comment'", nodes=nodes.assign(comment="here"))
        attempt("nodes, row 3, column z_m", "'high'", nodes=nodes.astype(object).assign(z_m=["high" if i == 3 else 0.0 for i in nodes.index]))
        attempt("node 1 stands twice", nodes=nodes.assign(node=1))
        attempt("elements, row 0, column node2", "'99' is not in nodes", elements=elements.assign(node2=[99, *elements["node2"][1:]]))
        attempt("elements, row 0, column material", "'steal'", "did you mean 'steel'", elements=elements.assign(material="steal"))
        attempt("elements, row 0, column type", "is empty", elements=elements.assign(type=None))
        attempt("unknown table 'knots'", knots=nodes)
        attempt("nodes: is a list", nodes=[1, 2])
        attempt("parameters, row 0", "lower <= initial <= upper", parameters=model.parameters.assign(initial=99.0))
        with self.refused("no table 'sections'"):
            twindeck.write_model("kept", nodes=nodes, elements=elements, materials=model["materials"])
        self.assertEqual({p.name: p.read_bytes() for p in pathlib.Path("kept").iterdir()}, before, "nothing was written")

    def test_tables_of_an_earlier_model_do_not_stay(self):
        model = twindeck.read_model(TEMPLATE / "model")
        model.write("model")
        pathlib.Path("model/frame.py").write_text("# mine\n")
        del model.tables["points"]
        model.write("model")
        self.assertFalse(pathlib.Path("model/points.csv").exists())
        self.assertTrue(pathlib.Path("model/frame.py").exists())

    def test_wrong_features_are_refused(self):
        good = twindeck.read_features(TEMPLATE / "features")
        rows = good.rows

        def attempt(*parts, changed, conditions=None):
            with self.refused(*parts):
                twindeck.write_features("never", changed, channels=good.channels, conditions=conditions)

        attempt("row 0, column std", "is empty", changed=rows.assign(std=None))
        attempt("row 0, column std", "above 0", changed=rows.assign(std=-1.0))
        attempt("row 0, column type", "'frequency' is no type", "did you mean 'frequency_Hz'", changed=rows.assign(type="frequency"))
        attempt("row 2, column channel", "'A_z' is not in channels", changed=rows.assign(channel=rows["channel"].replace("A_x", "A_z")))
        attempt("stands twice", changed=pd.concat([rows, rows[:1]], ignore_index=True))
        attempt("no column 'value'", changed=rows.drop(columns="value"))
        attempt("unknown key 'temperature'", "temperature_C", changed=rows, conditions={"still_air": {"temperature": 3.0}})
        self.assertFalse(pathlib.Path("never").exists())


class Running(InFolder):
    def test_a_failure_is_the_steps_own_message(self):
        with self.assertRaisesRegex(twindeck.StepError, "s1_model: .*did you mean 'n_modes'") as caught:
            twindeck.run_step("s1_model", out="out", model=TEMPLATE / "model", set={"n_mode": 3})
        self.assertEqual(caught.exception.code, 2)
        self.assertIn("--set", caught.exception.command)
        self.assertFalse(pathlib.Path("out").exists())

    def test_an_executable_that_is_not_there(self):
        with self.refused("s1_modell", str(BIN), "TWINDECK_BIN"):
            twindeck.run_step("s1_modell", out="out")

    def test_an_interpreter_without_pandas_says_so(self):
        """-S leaves site packages out, so that every interpreter lacks pandas."""
        done = subprocess.run([sys.executable, "-S", "-c", "import twindeck"], env={**os.environ, "PYTHONPATH": str(ROOT / "python")}, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr.splitlines()[-1], "twindeck needs pandas, which .* does not have")


if __name__ == "__main__":
    unittest.main()
