"""Thresholds of step 9 from null data sets: run once, kept by a hash, named in the result.

Oracles: the second run must read what the first one wrote; another scatter is another hash; the committed threshold of the chain is
recomputed from its own null data sets with TWINDECK_SLOW=1.
"""
import hashlib
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

    def run_step(self, name, *settings, catalogue=chain.ROOT / "workflows/common/hypotheses", more=()):
        arguments = [item for setting in settings for item in ("--set", setting)]
        return chain.subprocess.run(
            [chain.BIN / "s9_diagnosis", "--model", self.folder / "model", "--features", self.folder / "features", "--out", self.folder / name,
             "--catalogue", catalogue, "--set", "form=off", "--quiet", *arguments, *more], capture_output=True, text=True, check=False)

    def diagnose(self, name, *settings, **options):
        done = self.run_step(name, *settings, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / name / "diagnosis.json").read_text())

    def test_nulls_run_once_and_are_kept(self):
        cache = self.folder / "cache"
        settings = ("nulls=6", f'threshold_cache="{cache}"')
        analytic = self.diagnose("analytic", f'threshold_cache="{cache}"')
        self.assertEqual(analytic["detection"]["threshold_from"], "analytic tail")
        first = self.diagnose("first", *settings)
        kept = list(cache.iterdir())
        self.assertEqual(len(kept), 1)
        self.assertEqual(first["detection"]["threshold_from"], f"6 nulls, {kept[0].name}")
        second = self.diagnose("second", *settings)
        first.pop("seconds"), second.pop("seconds")
        self.assertEqual(second, first, "kept or run now, the same bytes")
        for name in ("first", "second"):
            inputs = json.loads((self.folder / name / "manifest.json").read_text())["inputs"]
            self.assertEqual(inputs[str(kept[0])], hashlib.sha256(kept[0].read_bytes()).hexdigest())
        self.diagnose("other", *settings, "scatter.gain=0.02")
        self.assertEqual(len(list(cache.iterdir())), 2)

    def test_a_changed_threshold_is_refused(self):
        """Whatever is changed in the file; and another prior, seed or covariance is another file."""
        cache = self.folder / "cache"
        settings = ("nulls=2", f'threshold_cache="{cache}"')
        self.diagnose("first", *settings)
        (file,) = cache.iterdir()
        before = file.read_text()
        (line,) = (line for line in before.splitlines() if line.startswith("threshold"))
        for changed in ("threshold = nan", "threshold = -inf", "threshold = 9.5", 'threshold = "3.0"', ""):
            file.write_text(before.replace(line, changed))
            done = self.run_step("changed", *settings)
            self.assertEqual(done.returncode, 2, f"{changed}: {done.stderr}")
            self.assertIn(f"{file}: ", done.stderr)
            self.assertIn("is not what a run of s9_diagnosis kept", done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)
        file.write_text("threshold = \n")
        self.assertEqual(self.run_step("changed", *settings).returncode, 2)
        file.write_text(before)
        self.diagnose("again", *settings)
        catalogue = shutil.copytree(chain.ROOT / "workflows/common/hypotheses", self.folder / "catalogue")
        gain = catalogue / "gain.toml"
        gain.write_text(re.sub(r"prior_weight *= *\S+", "prior_weight = 0.123", gain.read_text()))
        self.diagnose("prior", *settings, catalogue=catalogue)
        self.assertEqual(len(list(cache.iterdir())), 2)
        done = self.run_step("seed", *settings, more=("--seed", "7"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(list(cache.iterdir())), 3)

    def test_a_prior_that_is_no_number_is_refused(self):
        catalogue = shutil.copytree(chain.ROOT / "workflows/common/hypotheses", self.folder / "catalogue")
        gain = catalogue / "gain.toml"
        text = gain.read_text()
        for weight in ("nan", "-1.0", '"often"'):
            gain.write_text(re.sub(r"prior_weight *= *\S+", f"prior_weight = {weight}", text))
            done = self.run_step("weight", catalogue=catalogue)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertRegex(done.stderr, r"\As9_diagnosis: .*gain\.toml:\d+: prior_weight: is .*\n\Z")

    def test_the_committed_threshold_is_used(self):
        copied = shutil.copytree(COMMITTED, self.folder / "copied")  # where it does not fit, a run would write one beside it
        result = self.diagnose("committed", "nulls=200", f'threshold_cache="{copied}"')
        self.assertRegex(result["detection"]["threshold_from"], "^200 nulls, [0-9a-f]{16}.toml$")
        self.assertEqual(sorted(p.name for p in copied.iterdir()), sorted(p.name for p in COMMITTED.iterdir()))

    @unittest.skipUnless(os.environ.get("TWINDECK_SLOW"), "200 null data sets: with TWINDECK_SLOW=1")
    def test_the_committed_threshold_is_what_the_nulls_give(self):
        cache = self.folder / "cache"
        self.diagnose("anew", "nulls=200", f'threshold_cache="{cache}"')
        (file,) = cache.iterdir()
        values = [float(re.search(r"threshold = (\S+)", path.read_text())[1]) for path in (file, COMMITTED / file.name)]
        self.assertAlmostEqual(*values, delta=0.02)  # rounding of the same sums, nothing else


if __name__ == "__main__":
    unittest.main()
