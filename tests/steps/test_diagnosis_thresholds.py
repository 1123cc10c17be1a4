"""Thresholds of step 9 from null data sets: run once, kept by a hash, named in the result.

Oracles: the second run must read what the first one wrote; another scatter is another hash; the committed threshold of the chain is
recomputed from its own null data sets with TWINDECK_SLOW=1.
"""
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import test_diagnosis as chain  # noqa: E402

COMMITTED = chain.ROOT / "tests/data/thresholds"


class Thresholds(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        chain.write_model(self.folder / "model")
        chain.write_features(self.folder / "features")

    def diagnose(self, name, *settings):
        out = self.folder / name
        arguments = [item for setting in settings for item in ("--set", setting)]
        done = chain.subprocess.run(
            [chain.BIN / "s9_diagnosis", "--model", self.folder / "model", "--features", self.folder / "features", "--out", out, "--catalogue",
             chain.ROOT / "workflows/common/hypotheses", *arguments], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((out / "diagnosis.json").read_text())

    def test_nulls_run_once_and_are_kept(self):
        cache = self.folder / "cache"
        settings = ("nulls=6", f'threshold_cache="{cache}"')
        analytic = self.diagnose("analytic", f'threshold_cache="{cache}"')
        self.assertEqual(analytic["detection"]["threshold_from"], "analytic tail")
        first = self.diagnose("first", *settings)
        self.assertEqual(first["detection"]["threshold_from"], "6 nulls")
        kept = list(cache.iterdir())
        self.assertEqual(len(kept), 1)
        second = self.diagnose("second", *settings)
        self.assertEqual(second["detection"]["threshold_from"], f"nulls cached in {kept[0].name}")
        self.assertEqual(second["detection"]["threshold"], first["detection"]["threshold"])
        self.diagnose("other", *settings, "scatter.gain=0.02")
        self.assertEqual(len(list(cache.iterdir())), 2)

    def test_the_committed_threshold_is_used(self):
        copied = shutil.copytree(COMMITTED, self.folder / "copied")  # where it does not fit, a run would write one beside it
        result = self.diagnose("committed", "nulls=200", f'threshold_cache="{copied}"')
        self.assertRegex(result["detection"]["threshold_from"], "^nulls cached in [0-9a-f]{16}.toml$")

    @unittest.skipUnless(os.environ.get("TWINDECK_SLOW"), "200 null data sets: with TWINDECK_SLOW=1")
    def test_the_committed_threshold_is_what_the_nulls_give(self):
        cache = self.folder / "cache"
        self.diagnose("anew", "nulls=200", f'threshold_cache="{cache}"')
        (file,) = cache.iterdir()
        values = [float(re.search(r"threshold = (\S+)", path.read_text())[1]) for path in (file, COMMITTED / file.name)]
        self.assertAlmostEqual(*values, delta=0.02)  # rounding of the same sums, nothing else


if __name__ == "__main__":
    unittest.main()
