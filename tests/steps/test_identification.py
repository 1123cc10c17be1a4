"""s3_identification on a campaign made up here: a chain of four masses between walls under white noise, recorded by four channels.

Oracle: closed-form modes of the chain, omega_r = 2 omega_0 sin(r pi/10), phi_r(j) = sin(r j pi/5); the file contract of DESIGN
section 3; the words of each refusal.
"""
import csv
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
STEP = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve() / "s3_identification"
RATE, OMEGA_0, ZETA, N = 100.0, 12.0, 0.01, 4
CHANNELS = ["c01", "c02", "c03", "c04"]


def frequency(r):
    return 2 * OMEGA_0 * math.sin(r * math.pi / (2 * (N + 1))) / (2 * math.pi)


def shape(r):
    return np.sin(r * np.arange(1, N + 1) * np.pi / (N + 1))


def chain(samples, seed):
    """Accelerations: each mode an exact discrete oscillator under white noise held over a sample, with 2 % sensor noise."""
    random = np.random.default_rng(seed)
    data = np.zeros((samples, N))
    for r in range(1, N + 1):
        omega = 2 * math.pi * frequency(r)
        pole = np.exp((-ZETA + 1j * math.sqrt(1 - ZETA**2)) * omega / RATE)
        force = random.standard_normal(samples)
        state, q = 0j, np.empty(samples)
        for t in range(samples):
            state = pole * state + force[t]
            q[t] = state.imag
        data += np.outer(q / q.std(), shape(r))
    return data + 0.02 * random.standard_normal(data.shape)


def rows(file):
    with open(file, newline="") as f:
        return list(csv.DictReader(f))


def write_campaign(folder, data, channels="", toml="", conditions='[low_no_dampers]\ndampers = "off"\n'):
    (folder / "records" / "ST1").mkdir(parents=True)
    np.save(folder / "records" / "ST1" / "record.npy", data)
    (folder / "channels.csv").write_text("channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role\n" + (channels or "".join(
        f"{c},P{i},{i},0,0,0,0,1,acceleration,m/s^2,1,,response\n" for i, c in enumerate(CHANNELS, 1))))
    (folder / "campaign.toml").write_text(toml or f"""[[record]]
setup = "ST1"
kind = "ambient"
file = "records/ST1/record.npy"
sampling_rate_Hz = {RATE}
channels = {CHANNELS}
condition = "low_no_dampers"
""".replace("'", '"'))
    if conditions:
        (folder / "conditions.toml").write_text(conditions)


def identify(campaign, out, *sets):
    arguments = [a for s in ("decimation=10", "block_rows=20", "maximum_order=40", *sets) for a in ("--set", s)]
    return subprocess.run([STEP, "--campaign", campaign, "--out", out, "--threads", "1", *arguments], cwd=ROOT, capture_output=True, text=True,
                          timeout=300)


class Identification(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.data = chain(150000, 1)
        write_campaign(cls.folder / "campaign", cls.data)
        cls.out = cls.folder / "out"
        done = identify(cls.folder / "campaign", cls.out)
        if done.returncode:
            raise AssertionError(done.stderr)

    def test_modes_are_those_of_the_chain(self):
        modes = rows(self.out / "modes.csv")
        self.assertEqual(len(modes), N)
        for r, mode in enumerate(modes, 1):
            self.assertEqual(mode["mode"], str(r))
            self.assertAlmostEqual(float(mode["frequency_Hz"]) / frequency(r), 1.0, delta=0.005)
            self.assertAlmostEqual(float(mode["damping_ratio_pct"]) / (100 * ZETA), 1.0, delta=0.25)
            self.assertLess(abs(float(mode["frequency_Hz"]) - frequency(r)), 4 * float(mode["frequency_std_Hz"]))
            self.assertGreater(float(mode["damping_ratio_std_pct"]), 0.0)

    def shapes(self, file):
        found = {}
        for row in rows(file):
            found.setdefault(row["mode"], {})[row["direction"]] = complex(float(row["value"]), float(row.get("value_imag") or 0))
        return found

    def test_shapes_are_those_of_the_chain_with_largest_component_one(self):
        for mode, components in self.shapes(self.out / "shapes.csv").items():
            v, truth = np.array([components[c] for c in CHANNELS]), shape(int(mode))
            self.assertGreater(abs(np.vdot(truth, v))**2 / (np.vdot(v, v).real * np.vdot(truth, truth).real), 0.99)
            self.assertAlmostEqual(max(abs(v)), 1.0, places=9)

    def test_features_folder_keeps_the_contract(self):
        features = self.out / "features"
        self.assertEqual((features / "channels.csv").read_bytes(), (self.folder / "campaign" / "channels.csv").read_bytes())
        self.assertEqual((features / "conditions.toml").read_bytes(), (self.folder / "campaign" / "conditions.toml").read_bytes())
        table = rows(features / "rows.csv")
        self.assertEqual({r["type"] for r in table}, {"frequency_Hz", "damping_ratio_pct", "shape", "shape_imag"})
        self.assertEqual({r["condition"] for r in table}, {"low_no_dampers"})
        self.assertEqual(len(table), N * (2 + 2 * N))
        self.assertTrue(all(float(r["std"]) > 0 for r in table))
        for mode in rows(self.out / "modes.csv"):
            same = [r for r in table if r["type"] == "frequency_Hz" and r["mode"] == mode["mode"]]
            self.assertEqual([r["value"] for r in same], [mode["frequency_Hz"]])
        quality = rows(features / "quality.csv")
        self.assertEqual([q["channel"] for q in quality], CHANNELS)
        for q, column in zip(quality, self.data.T):
            self.assertAlmostEqual(float(q["rms"]), column.std(), places=6)
            self.assertEqual((q["missing"], q["clipped"], q["dead"]), ("0", "0", "0"))

    def test_poles_and_spectra(self):
        poles = rows(self.out / "poles.csv")
        self.assertEqual(list(poles[0]), ["setup", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping",
                                          "stable_shape", "mode"])
        self.assertEqual({p["mode"] for p in poles} - {""}, {"1", "2", "3", "4"})
        self.assertTrue(all(p["stable_frequency"] + p["stable_damping"] + p["stable_shape"] == "111" for p in poles if p["mode"]))
        spectra = rows(self.out / "psd.csv")
        self.assertEqual({s["channel"] for s in spectra}, set(CHANNELS))
        one = [(float(s["frequency_Hz"]), float(s["psd_m2_s3"])) for s in spectra if s["channel"] == "c01"]
        # Parseval: nearly all of the signal lies below the new Nyquist frequency (the noise above it is 0.04 % of it).
        self.assertAlmostEqual(sum(p for _, p in one) * one[1][0] / self.data[:, 0].var(), 1.0, delta=0.03)

    def test_gain_and_polarity_of_a_channel_are_undone(self):
        folder = self.folder / "gain"
        data = self.data.copy()
        data[:, 1] *= -3.0
        write_campaign(folder, data, "".join(f"{c},P{i},{i},0,0,0,0,1,acceleration,m/s^2,{-1 / 3 if c == 'c02' else 1},,response\n"
                                             for i, c in enumerate(CHANNELS, 1)))
        done = identify(folder, self.folder / "gain_out")
        self.assertEqual(done.returncode, 0, done.stderr)
        for a, b in zip(rows(self.out / "shapes.csv"), rows(self.folder / "gain_out" / "shapes.csv")):
            self.assertAlmostEqual(float(a["value"]), float(b["value"]), places=6)

    def test_bad_input_is_refused_in_one_line(self):
        nan, dead = self.data[:20000].copy(), self.data[:20000].copy()
        nan[700:720, 2] = np.nan
        dead[:, 3] = 1.5
        cases = [("nan", nan, {}, [], "c03: has a gap of 20 samples from sample 700 on"),
                 ("dead", dead, {}, [], "c04: is constant (1.5)"),
                 ("setup", self.data[:20000], {}, ["setup=ST9"], "no record has setup 'ST9'"),
                 ("reference", self.data[:20000], {}, ['references=["c99"]'], "'c99' is no channel of the record"),
                 ("short", self.data[:3000], {}, ["welch_segment=256"], "cut the record of 300 samples into 20 blocks of 15"),
                 ("order", self.data[:20000], {}, ["maximum_order=90"], "is 90, but 20 block rows of 4 channels with 4 references carry at most 76"),
                 ("columns", self.data[:20000, :3], {}, [], "has 3 columns, but campaign.toml names 4 channels"),
                 ("condition", self.data[:20000], {"conditions": "[low_no_damper]\n"}, [], "did you mean 'low_no_damper'?")]
        for name, data, options, sets, expected in cases:
            with self.subTest(name):
                write_campaign(self.folder / name, data, **options)
                out = self.folder / (name + "_out")
                done = identify(self.folder / name, out, *(["welch_segment=1024"] + sets))
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(expected, done.stderr)
                self.assertFalse(out.exists())

    def test_a_gap_is_bridged_and_a_dead_channel_left_out_when_asked(self):
        data = self.data.copy()
        data[700:705, 2] = np.nan
        data[:, 3] = 0.0
        write_campaign(self.folder / "repair", data)
        done = identify(self.folder / "repair", self.folder / "repair_out", "longest_gap=5", 'exclude=["c04"]')
        self.assertEqual(done.returncode, 0, done.stderr)
        found = [float(m["frequency_Hz"]) for m in rows(self.folder / "repair_out" / "modes.csv")]
        np.testing.assert_allclose(found, [frequency(r) for r in range(1, N + 1)], rtol=0.005)
        quality = {q["channel"]: q for q in rows(self.folder / "repair_out" / "features" / "quality.csv")}
        self.assertEqual((quality["c03"]["missing"], quality["c03"]["longest_gap"], quality["c04"]["dead"]), ("5", "5", "1"))


if __name__ == "__main__":
    unittest.main()
