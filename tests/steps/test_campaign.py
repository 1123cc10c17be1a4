"""s0_campaign and s2_sensors on small settings: contract of the campaign folder, the truth that is imposed, loggers, refusals; and that
nothing but a scorer reads the truth.

Oracles: Table 4 as printed (the ten named frequencies within 0.2 %, damping as imposed), the file contract of docs/my_records.md, whole
converter steps, Eq. (1) worked out here, the words of each refusal.
"""
import csv
import os
import pathlib
import re
import shutil
import struct
import subprocess
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
STUDY = ROOT / "workflows" / "ponte_del_mare_virtual"
RECORDS = """
[[record]]
setup = "ST1"
condition = "without_dampers"
duration = "300 s"
[[record]]
setup = "CP1"
condition = "with_dampers"
duration = "30 s"
[[record]]
setup = "ST1"
kind = "free_decay"
condition = "with_dampers"
duration = "20 s"
mass = "2 t"
point = "FO-36.8"
"""
FEW_STAYS = '[[stay_test]]\nstay = "NE8"\ncondition = "without_sleeves"\npull = "300.9 kN"\nlambda_squared = 2.60\ndamping = "0.46 %"\n'


def run(step, *arguments):
    return subprocess.run([BIN / step, *map(str, arguments)], cwd=ROOT, capture_output=True, text=True, timeout=300)


def rows(file):
    with open(file, newline="") as f:
        return list(csv.DictReader(f))


def small_study(folder, edit=lambda text: text):
    """The study's own settings with few and short records."""
    workflow = folder / "workflow"
    shutil.copytree(ROOT / "workflows" / "smoke", workflow)
    blocks = re.split(r"(?m)^(?=\[)", (STUDY / "s0_campaign.toml").read_text())
    kept = [b for b in blocks if not b.startswith(("[[record]]", "[[stay_test]]"))]
    text = "".join(kept).replace('duration = "1200 s"', 'duration = "40 s"')
    (workflow / "s0_campaign.toml").write_text(edit(text + RECORDS + FEW_STAYS))
    return workflow


def read_single(file):
    """(shape, values) of an NPY file of little-endian singles in C order."""
    content = file.read_bytes()
    length = struct.unpack("<H", content[8:10])[0]
    header = content[10:10 + length].decode()
    assert "'<f4'" in header and "False" in header, header
    shape = tuple(int(n) for n in re.search(r"\((\d+), (\d+)\)", header).groups())
    return shape, struct.unpack(f"<{shape[0] * shape[1]}f", content[10 + length:])


class Campaign(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.workflow = small_study(cls.folder)
        cls.out = cls.folder / "results" / "s0_campaign"
        done = run("s0_campaign", "--study", cls.workflow, "--out", cls.out, "--threads", 2, "--quiet")
        if done.returncode:
            raise AssertionError(done.stderr)
        cls.campaign = tomllib.loads((cls.out / "campaign.toml").read_text())

    def test_named_modes_are_table_4s(self):
        printed = rows(ROOT / "data/ponte_del_mare/paper/table_04.csv")
        true = {r["mode"]: r for r in rows(self.out / "truth/modes.csv") if r["condition"] == "without_dampers" and r["mode"]}
        self.assertEqual(len(true), 10)
        for row in printed:
            mode = true[row["mode"]]
            self.assertLess(abs(float(mode["frequency_Hz"]) / float(row["f_X_without_dampers_Hz"]) - 1), 0.002)
            self.assertAlmostEqual(float(mode["damping_ratio_pct"]), float(row["zeta_without_dampers_pct"]), places=9)
        unnamed = [r for r in rows(self.out / "truth/modes.csv") if r["condition"] == "without_dampers" and not r["mode"]]
        self.assertTrue(any(float(r["stay_share"]) > 0.9 and float(r["frequency_Hz"]) < 1.0 for r in unnamed), "stays vibrate too")

    def test_folder_keeps_the_contract(self):
        channels = {r["channel"]: r for r in rows(self.out / "channels.csv")}
        conditions = tomllib.loads((self.out / "conditions.toml").read_text())
        self.assertEqual([(r["setup"], r["kind"], r["condition"]) for r in self.campaign["record"]],
                         [("ST1", "ambient", "without_dampers"), ("CP1", "ambient", "with_dampers"), ("ST1", "free_decay", "with_dampers"),
                          ("NE8", "stay", "without_sleeves")])
        for record, seconds in zip(self.campaign["record"], (300, 30, 20, 40)):
            shape, _ = read_single(self.out / record["file"])
            self.assertEqual(shape, (seconds * 100, len(record["channels"])))
            self.assertEqual(record["sampling_rate_Hz"], 100.0)
            self.assertLessEqual(set(record["channels"]), set(channels))
            self.assertIn(record["condition"], conditions)
        self.assertEqual({c for c, r in channels.items() if r["reference"] == "1"}, {"FO-26.3z", "FO+10.5z", "CI-15.8z", "CI+21.0z"})
        for r in channels.values():
            self.assertAlmostEqual(sum(float(r[d]) ** 2 for d in ("dx", "dy", "dz")), 1.0, places=6)
        self.assertEqual((conditions["without_dampers"]["dampers"], conditions["with_dampers"]["dampers"]), ("off", "on"))
        self.assertGreater(conditions["without_dampers"]["amplitude_m"], 0.0)

    def test_readings_are_whole_steps_of_the_converter(self):
        _, values = read_single(self.out / self.campaign["record"][0]["file"])
        step = 1.5e-4
        self.assertLess(max(abs(v / step - round(v / step)) for v in values[:20000]), 1e-3)
        self.assertGreater(max(values), 20 * step)

    def test_a_small_motion_leaves_the_dampers_stuck_and_stiffens(self):
        self.assertTrue(all(float(r["sliding_pct"]) == 0.0 for r in rows(self.out / "truth/dampers.csv") if r["condition"] == "with_dampers"))
        first = {r["condition"]: float(r["frequency_Hz"]) for r in rows(self.out / "truth/modes.csv") if r["mode"] == "1"}
        self.assertGreater(first["with_dampers"], 1.15 * first["without_dampers"])

    def test_a_released_mass_rings_down(self):
        (_, n), values = read_single(self.out / self.campaign["record"][2]["file"])

        def square(first, last):
            return sum(v * v for v in values[first * n:last * n])
        self.assertGreater(square(0, 500), 20 * square(1500, 2000))

    def test_same_bytes_whatever_the_threads(self):
        other = self.folder / "one_thread"
        self.assertEqual(run("s0_campaign", "--study", self.workflow, "--out", other, "--threads", 1, "--quiet").returncode, 0)
        files = [p.relative_to(self.out) for p in self.out.rglob("*") if p.is_file() and p.name != "manifest.json"]
        self.assertGreater(len(files), 8)
        self.assertEqual([str(f) for f in files if (self.out / f).read_bytes() != (other / f).read_bytes()], [])

    def test_nothing_but_a_scorer_reads_the_truth(self):
        """Step 3 reads the campaign as step 0 left it, then without its truth: the same bytes."""
        sets = [a for s in ("setup=ST1", "condition=without_dampers", "decimation=16", "block_rows=20", "maximum_order=30", "welch_segment=256",
                            "blocks=5", "stay.block_rows=30", "stay.maximum_order=20", "decay.block_rows=20", "decay.maximum_order=20",
                            "decay.length=10")
                for a in ("--set", s)]
        results = self.folder / "blind"
        shutil.copytree(self.out, results / "s0_campaign")
        outs = []
        for name in ("with", "without"):
            outs.append(self.folder / name / "s3_identification")
            done = run("s3_identification", "--results", results, "--out", outs[-1], "--quiet", *sets)
            self.assertIn(done.returncode, (0,), done.stderr)
            shutil.rmtree(results / "s0_campaign" / "truth", ignore_errors=True)
        files = [p.relative_to(outs[0]) for p in outs[0].rglob("*") if p.is_file() and p.name != "manifest.json"]
        self.assertIn(pathlib.Path("modes.csv"), files)
        self.assertEqual([str(f) for f in files if (outs[0] / f).read_bytes() != (outs[1] / f).read_bytes()], [])


class Refusals(unittest.TestCase):
    def refused(self, edit, words):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            workflow = small_study(folder, edit)
            done = run("s0_campaign", "--study", workflow, "--out", folder / "out", "--quiet")
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertIn(words, done.stderr)
            self.assertFalse((folder / "out").exists())

    def test_each_names_what_is_wrong(self):
        for edit, words in (
                (lambda t: t.replace('condition = "with_dampers"\nduration = "30 s"', 'condition = "with_damper"\nduration = "30 s"'),
                 "'with_damper' is not there (did you mean 'with_dampers'?)"),
                (lambda t: t.replace('setup = "CP1"', 'setup = "CP9"'), "'CP9' is not in the layout, which has ST1, ST2, CP1, CP2, M"),
                (lambda t: t.replace('vibrating_stays = ["NE5"', 'vibrating_stays = ["NE9"'), "'NE9' is no stay of the model"),
                (lambda t: t.replace('point = "FO-36.8"', 'point = "FO-36"'), "'FO-36' is no point of the layout"),
                (lambda t: t.replace('frequency = "1.243 Hz"', 'frequency = "1.268 Hz"'),
                 "corrections.csv: factor: the bridge has mode 4 at 1.2432 Hz, expected 1.268 Hz within 0.2 %")):
            with self.subTest(words):
                self.refused(edit, words)


class Sensors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.out = cls.folder / "s2_sensors"
        for arguments in (("s1_model", "--study", STUDY, "--out", cls.folder / "s1_model"),
                          ("s2_sensors", "--study", STUDY, "--results", cls.folder, "--out", cls.out, "--set", "draws=30", "--set", "blind.duration=3200",
                           "--set", 'blind.setups=["ST1"]')):
            done = run(*arguments, "--quiet")
            if done.returncode:
                raise AssertionError(done.stderr)
        cls.setups = {r["setup"]: r for r in rows(cls.out / "setups.csv")}

    def test_scores_are_the_mean_off_the_diagonal(self):
        for name, setup in self.setups.items():
            off = [float(r["mac"]) for r in rows(self.out / "automac.csv") if r["setup"] == name and r["mode"] != r["other_mode"]]
            self.assertEqual(len(off), 90)
            self.assertAlmostEqual(sum(off) / 90, float(setup["R_k"]), places=10)

    def test_search_beats_what_was_drawn_and_laid_out(self):
        sixteen = [float(s["R_k"]) for s in self.setups.values() if s["channels"] == "16"]
        self.assertEqual(float(self.setups["least_R_k"]["R_k"]), min(sixteen))
        self.assertLessEqual(float(self.setups["DC1"]["R_k"]), float(self.setups["DC2"]["R_k"]))
        self.assertEqual(float(self.setups["DC1"]["R_k"]), float(self.setups["DC1"]["best_drawn_R_k"]))
        determinants = {n: float(s["log_determinant"]) for n, s in self.setups.items() if s["log_determinant"]}
        self.assertEqual(max(determinants, key=determinants.get), "greatest_determinant")

    def test_blind_test_finds_the_models_modes(self):
        table = rows(self.out / "blind_test.csv")
        found = [r for r in table if r["found"] == "1"]
        self.assertEqual(len([r for r in table if r["mode"] != "spurious"]), 10)
        self.assertGreaterEqual(len(found), 7, "of ten modes, orders of at most 20 and a shorter record than the study's")
        for r in found:
            # The trapezoidal rule alone lengthens periods by (omega dt)^2/12, 0.3 % at 2 Hz.
            self.assertLess(abs(float(r["frequency_error_pct"])), 1.0)
            self.assertGreater(float(r["mac"]), 0.9)


if __name__ == "__main__":
    unittest.main()
