"""A made-up study in a temporary folder that is the working folder meanwhile, the package's commands run on it, and ways to change one
thing in it."""
import io
import os
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout

import made_up_study
from twindeck_report import cli


class MadeUpCase:
    """The folders of one study: data, workflow, results. `add_cleanup` is a test's addCleanup or a class's addClassCleanup."""

    def __init__(self, add_cleanup):
        folder = tempfile.TemporaryDirectory()
        add_cleanup(folder.cleanup)
        self.data, self.workflow, self.results = made_up_study.make_study(folder.name)
        add_cleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def run(self, command, *options):
        """(exit code, stdout, stderr)"""
        out, err = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(err):
            code = cli.main([command, "--study", "made_up", "--results", str(self.results), "--data", str(self.data),
                             "--workflow", str(self.workflow), *options])
        return code, out.getvalue(), err.getvalue()


class CheckCase(unittest.TestCase):
    """A made-up study whose tables are made, once a test."""

    def setUp(self):
        self.case = MadeUpCase(self.addCleanup)
        self.data, self.workflow, self.results = self.case.data, self.case.workflow, self.case.results
        self.run_command = self.case.run
        self.assertEqual(self.run_command("tables")[0], 0)

    def edit(self, path, old, new):
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new, 1), encoding="utf-8")

    def set_cell(self, table, key, row, column, value):
        """Changes one cell of a generated table; returns its old text."""
        path = self.results / "tables" / f"{table}.csv"
        rows = made_up_study.read_rows(path)
        changed = next(r for r in rows if r[key] == row)
        old, changed[column] = changed[column], value
        made_up_study.write_rows(path, list(rows[0]), [list(r.values()) for r in rows])
        return old

    def know(self, *cells):
        """Each (table, row, column), (table, None, column) for a limit on the root mean square, or ("orders", name, None)."""
        (self.data / "known_deviations.toml").write_text("".join(
            f'[[deviation]]\ntable = "{t}"\n' + (f'row = "{r}"\n' if r else "rms = true\n") + (f'column = "{c}"\n' if c else "")
            + 'reason = "a made-up reason"\n' for t, r, c in cells))

    def remake_with(self, step, file, key, row, column, factor):
        """Moves one result of a step, as a model that differs there would give it, and makes the tables again."""
        path = self.results / step / file
        rows = made_up_study.read_rows(path)
        for entry in rows:
            if row in (entry[key], None):
                entry[column] = repr(float(entry[column]) * factor)
        made_up_study.write_rows(path, list(rows[0]), [list(r.values()) for r in rows])
        made_up_study.write_manifest(self.results / step)
        self.assertEqual(self.run_command("tables")[0], 0)

    def deviations(self):
        """{(table, row, column): row of deviations.csv} of the last check."""
        return {(r["table"], r["row"], r["column"]): r for r in made_up_study.read_rows(self.results / "report/deviations.csv")}
