"""s3_identification with defaults alone on minimal and uncommon inputs, modes by hand, and what it doubts.

Oracle: the closed-form modes of the chain (test_identification), of three damped oscillators released from rest, of hinged and clamped
beams under tension.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from test_identification import N, RATE, ROOT, STEP, chain, frequency, rows  # noqa: E402
from test_identification_kinds import write  # noqa: E402

MODES = [(1.3360, 0.020), (7.3908, 0.075), (13.7967, 0.050)]  # three masses on springs and dashpots, Hz and damping ratio
SHAPES = np.array([[.328, .737, .591], [.591, .328, -.737], [.737, -.591, .328]])


def run(campaign, out, *arguments):
    done = subprocess.run([STEP, "--campaign", campaign, "--out", out, "--threads", "1", *arguments], cwd=ROOT, capture_output=True, text=True, timeout=300)
    return done


def released(seed, seconds=60.0, rate=200.0, noise=0.002):
    """Accelerations after a release at 1 s, each mode's in closed form, with white noise of a share of the channel's RMS."""
    random = np.random.default_rng(seed)
    t = np.arange(int(seconds * rate)) / rate - 1.0
    data = np.zeros((len(t), 3))
    for k, (f, zeta) in enumerate(MODES):
        w, root = 2 * math.pi * f, math.sqrt(1 - zeta**2)
        motion = np.where(t < 0, 0.0, -w * np.exp(-zeta * w * np.maximum(t, 0)) * (np.cos(w * root * t) - zeta / root * np.sin(w * root * t)))
        data += (0.5 + random.random()) * np.outer(motion, SHAPES[k])
    return data + noise * data.std(axis=0) * random.standard_normal(data.shape)


def vibrating(frequencies, seconds, rate, seed, zeta=0.002):
    """One channel of oscillators under white noise, each of unit RMS."""
    random = np.random.default_rng(seed)
    data = np.zeros(int(seconds * rate))
    for f in frequencies:
        pole, state, part = np.exp((-zeta + 1j) * 2 * math.pi * f / rate), 0j, np.empty(len(data))
        for k, force in enumerate(random.standard_normal(len(data))):
            state = pole * state + force
            part[k] = state.imag
        data += part / part.std()
    return data[:, None] + 0.02 * random.standard_normal((len(data), 1))


class Minimal(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.data = chain(60000, 5)

    def identified(self, name, records, *arguments, references=("c01", "c03")):
        write(self.folder / name, records, references)
        done = run(self.folder / name, self.folder / f"{name}_out", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr, rows(self.folder / f"{name}_out" / "modes.csv")

    def assert_modes(self, modes, expected, relative=0.01):
        found = [float(m["frequency_Hz"]) for m in modes]
        for f in expected:
            self.assertTrue(any(abs(g / f - 1) < relative for g in found), (f, found))

    def test_one_channel_two_channels_and_one_reference(self):
        all_modes = [frequency(r) for r in range(1, N + 1)]
        for name, channels, references in (("one", [0], ("c01",)), ("two", [0, 1], ("c01", "c02")), ("reference", [0, 1, 2, 3], ("c02",))):
            with self.subTest(name):
                names = [f"c0{c + 1}" for c in channels]
                said, modes = self.identified(name, [("A", "ambient", "still", names, self.data[:, channels], RATE)], references=references)
                self.assert_modes(modes, all_modes[:3])
                self.assertNotIn("command line", said)
        told = json.loads((self.folder / "one_out" / "manifest.json").read_text())["warnings"]
        self.assertTrue(any("maximum_order 60 -> " in w for w in told), told)

    def test_one_minute_and_one_mode(self):
        _, modes = self.identified("minute", [("A", "ambient", "still", ["c01", "c02", "c03", "c04"], self.data[:6000], RATE)])
        self.assert_modes(modes, [frequency(2)], 0.02)
        _, modes = self.identified("mode", [("A", "ambient", "still", ["c01"], vibrating([2.5], 600, 50.0, 3, 0.01), 50.0)], references=("c01",))
        self.assert_modes(modes, [2.5])

    def test_a_mode_near_the_nyquist_frequency_is_found_and_told(self):
        """Records at 25 Hz, in which 11.3 Hz lies above the passband of a filter that none has gone through."""
        data = vibrating([2.0, 5.5, 11.3], 360, 25.0, 7, 0.01)
        said, modes = self.identified("near", [("A", "ambient", "still", ["c01"], data, 25.0)], references=("c01",))
        self.assert_modes(modes, [2.0, 5.5, 11.3], 0.02)
        self.assertIn("up to 12.5 Hz, the Nyquist frequency, because the spectrum has a peak at 11.", said)
        # With modes below that alone the record is decimated no further than these ask for, and the band ends as it did.
        said, modes = self.identified("below", [("A", "ambient", "still", ["c01"], vibrating([2.0, 5.5], 360, 25.0, 7, 0.01), 25.0)], references=("c01",))
        self.assert_modes(modes, [2.0, 5.5], 0.02)
        self.assertIn("0.8 of the Nyquist frequency", said)

    def test_a_pure_sine_is_a_line_and_no_mode(self):
        t = np.arange(6000) / 100.0
        for noise in (0.0, 1e-4):
            data = np.outer(np.sin(2 * np.pi * 3.1 * t + 0.3), [1.0, -0.6]) + noise * np.random.default_rng(2).standard_normal((len(t), 2))
            write(self.folder / f"sine_{noise}", [("A", "ambient", "still", ["c01", "c02"], data, 100.0)], ("c01", "c02"))
            done = run(self.folder / f"sine_{noise}", self.folder / f"sine_{noise}_out")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("no mode is stable over the model orders beside the lines of periodic forces", done.stderr)
            lines = [line for line in done.stderr.splitlines() if "steady line" in line]
            self.assertEqual(len(lines), 1, done.stderr)
            self.assertIn("3.1000 Hz is a steady line", lines[0])

    def test_an_order_that_is_asked_for_is_not_lowered(self):
        write(self.folder / "asked", [("A", "ambient", "still", ["c01"], self.data[:, :1], RATE)])
        done = run(self.folder / "asked", self.folder / "asked_out", "--set", "block_rows=20", "--set", "maximum_order=60")
        self.assertEqual(done.returncode, 2)
        self.assertIn("maximum_order", done.stderr)

    def test_records_at_1000_Hz_show_modes_below_5_Hz(self):
        fine = np.repeat(self.data[:30000], 10, axis=0)[:, :2]  # the chain's modes lie between 1.1 and 3.7 Hz
        fine = fine + 0.01 * np.random.default_rng(1).standard_normal(fine.shape)
        said, modes = self.identified("fine", [("A", "ambient", "still", ["c01", "c02"], fine, 1000.0)], references=("c01", "c02"))
        self.assert_modes(modes, [frequency(r) for r in range(1, N + 1)])
        self.assertIn("decimation", said)

    def test_setups_of_two_rates_are_merged(self):
        other = chain(120000, 6)[:, [0, 2, 3]]
        said, modes = self.identified("rates", [("A", "ambient", "still", ["c01", "c02", "c03"], self.data[:, [0, 1, 2]], RATE),
                                                ("B", "ambient", "still", ["c01", "c03", "c04"], other[::2], RATE / 2)])
        self.assert_modes(modes, [frequency(r) for r in range(1, N + 1)])
        self.assertTrue(all(m["setups"] == "2" for m in modes[:3]), modes)
        done = run(self.folder / "rates", self.folder / "rates_preger", "--set", "merge=preger")
        self.assertEqual(done.returncode, 2)
        self.assertIn("merge=poser", done.stderr)

    def test_a_person_has_the_last_word(self):
        records = [("A", "ambient", "still", ["c01", "c02", "c03", "c04"], self.data, RATE)]
        _, before = self.identified("kept", records)
        poles = [p for p in rows(self.folder / "kept_out" / "poles.csv") if p["mode"] == "2"]
        kept = self.folder / "modes_kept.csv"
        line = "{setup},{order},{frequency_Hz},{damping_ratio_pct}"
        kept.write_text("setup,order,frequency_Hz,damping_ratio_pct,action\n" + line.format(**poles[-1]) + ",delete\n")
        done = run(self.folder / "kept", self.folder / "deleted", "--set", f"keep={kept}")
        self.assertEqual(done.returncode, 0, done.stderr)
        after = rows(self.folder / "deleted" / "modes.csv")
        self.assertEqual([m["frequency_Hz"] for m in after], [m["frequency_Hz"] for m in before if m["mode"] != "2"])
        # Kept again under a selection that has none of them, it comes back.
        kept.write_text("setup,order,frequency_Hz,damping_ratio_pct,action\n" + line.format(**poles[-1]) + ",keep\n")
        done = run(self.folder / "kept", self.folder / "picked", "--set", f"keep={kept}", "--set", "automatic.law_ratio=1e-6")
        self.assertEqual(done.returncode, 0, done.stderr)
        picked = rows(self.folder / "picked" / "modes.csv")
        self.assertEqual(len(picked), 1)
        self.assertAlmostEqual(float(picked[0]["frequency_Hz"]) / frequency(2), 1.0, delta=0.01)
        self.assertTrue(all(float(r["std"]) > 0 for r in rows(self.folder / "picked" / "features" / "rows.csv")))


class Decays(unittest.TestCase):
    """Free decays alone. Damping within two per cent: noise of 0.2 % and 60 s leave a tenth of that."""

    def test_decays_alone_give_modes_and_features(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        write(folder / "campaign", [("S1", "free_decay", "still", ["c01", "c02", "c03"], released(11), 200.0)])
        for sets in ([], ["--set", "kind=free_decay"]):
            done = run(folder / "campaign", folder / "out", *sets)
            self.assertEqual(done.returncode, 0, done.stderr)
            modes = rows(folder / "out" / "modes.csv")
            self.assertEqual(len(modes), 3, modes)
            for mode, (f, zeta) in zip(modes, MODES):
                self.assertAlmostEqual(float(mode["frequency_Hz"]) / f, 1.0, delta=0.002)
                self.assertAlmostEqual(float(mode["damping_ratio_pct"]) / (100 * zeta), 1.0, delta=0.02)
                self.assertEqual(mode["efdd_frequency_Hz"], "")
            self.assertEqual(len(rows(folder / "out" / "shapes.csv")), 9)
            table = rows(folder / "out" / "features" / "rows.csv")
            self.assertEqual(len([r for r in table if r["type"] == "damping_ratio_pct"]), 3)
            self.assertTrue(all(r["source"] == "free_decay" for r in rows(folder / "out" / "amplitude.csv")))


class Hangers(unittest.TestCase):
    """T/m = 41,667 m²/s² and 80 m, xi = 30: the interval of 95 % holds it, with either end and at 50 Hz too."""

    def test_hinged_and_clamped(self):
        folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        (folder / "study").mkdir()
        (folder / "study" / "study.toml").write_text('title = "stay"\nsteps = ["s3_identification"]\n')
        (folder / "study" / "s3_identification.toml").write_text('[[stay_length]]\nname = "s1"\nlength = "80 m"\n')
        for name, f in (("hinged", [1.2828, 2.6069, 4.0118, 5.5327, 7.2004, 9.0402]), ("clamped", [1.3745, 2.7936, 4.2991, 5.9277, 7.7101, 9.6710])):
            with self.subTest(name):
                write(folder / name, [("C1", "stay", "still", ["s1"], vibrating(f, 420, 50.0, 4), 50.0)])
                done = run(folder / name, folder / f"{name}_out", "--study", folder / "study")
                self.assertEqual(done.returncode, 0, done.stderr)
                stay = rows(folder / f"{name}_out" / "stay_tensions.csv")[0]
                self.assertEqual(stay["harmonics"], "6")
                self.assertLess(float(stay["tension_per_mass_low_m2_s2"]), 41667)
                self.assertGreater(float(stay["tension_per_mass_high_m2_s2"]), 41667)


if __name__ == "__main__":
    unittest.main()
