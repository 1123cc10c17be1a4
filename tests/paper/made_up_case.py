"""A made-up study in a temporary folder that is the working folder meanwhile, and the package's commands run on it."""
import io
import os
import tempfile
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
        os.chdir(folder.name)  # CHANGELOG.md is looked for here

    def run(self, command):
        """(exit code, stdout, stderr)"""
        out, err = io.StringIO(), io.StringIO()
        with redirect_stdout(out), redirect_stderr(err):
            code = cli.main([command, "--study", "made_up", "--results", str(self.results), "--data", str(self.data),
                             "--workflow", str(self.workflow)])
        return code, out.getvalue(), err.getvalue()
