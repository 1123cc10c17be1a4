"""s3_identification on a campaign of several kinds: two setups that share references, two conditions, free decays, a stay, measured inputs.

Oracle: the closed-form modes of the chain (test_identification), the harmonics that the stay's record was made of, the words of each
refusal.
"""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from test_identification import CHANNELS, N, RATE, ROOT, STEP, ZETA, chain, frequency, rows, shape  # noqa: E402


def decay(seconds, seed):
    random = np.random.default_rng(seed)
    t = np.arange(int(seconds * RATE)) / RATE
    data = sum(np.outer(np.exp(-ZETA * 2 * math.pi * frequency(r) * t) * np.cos(2 * math.pi * frequency(r) * t), shape(r)) for r in range(1, N + 1))
    quiet = 0.001 * random.standard_normal((int(5 * RATE), N))
    return np.vstack([quiet, data + 0.001 * random.standard_normal(data.shape)])


def string(seconds, seed, c=1.5, first=1.08):
    """Harmonics of a string of 1.5 Hz, the first raised by sag."""
    random = np.random.default_rng(seed)
    total = np.zeros(int(seconds * RATE))
    for n in range(1, 6):
        f = c * n * (first if n == 1 else 1.0)
        pole = np.exp((-0.003 + 1j) * 2 * math.pi * f / RATE)
        state, force = 0j, random.standard_normal(len(total))
        part = np.empty(len(total))
        for k in range(len(total)):
            state = pole * state + force[k]
            part[k] = state.imag
        total += part / part.std()
    return total[:, None] + 0.02 * random.standard_normal((len(total), 1))


def write(folder, records, references=("c01", "c03")):
    """records: (setup, kind, condition, channels, data, rate)."""
    folder.mkdir(parents=True)
    names = sorted({c for r in records for c in r[3]})
    (folder / "channels.csv").write_text("channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role\n" + "".join(
        f"{c},{c.upper()},0,0,0,0,0,1,acceleration,m/s^2,1,{int(c in references)},{'input' if c.startswith('u') else 'response'}\n" for c in names))
    toml = ""
    for i, (setup, kind, condition, channels, data, rate) in enumerate(records):
        np.save(folder / f"{i}.npy", data)
        toml += (f'[[record]]\nsetup = "{setup}"\nkind = "{kind}"\nfile = "{i}.npy"\nsampling_rate_Hz = {rate}\n'
                 f"channels = {channels}\ncondition = \"{condition}\"\n").replace("'", '"')
    (folder / "campaign.toml").write_text(toml)


def run(campaign, out, *sets):
    arguments = [a for s in ("decimation=10", "block_rows=20", "maximum_order=40", "welch_segment=512", "decay.block_rows=40", "decay.band=0.2", *sets)
                 for a in ("--set", s)]
    return subprocess.run([STEP, "--campaign", campaign, "--out", out, "--threads", "1", *arguments], cwd=ROOT, capture_output=True, text=True,
                          timeout=300)


class Kinds(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.first, cls.second = chain(90000, 5), 3.0 * chain(90000, 6)
        cls.records = [("A", "ambient", "off", ["c01", "c02", "c03"], cls.first[:, [0, 1, 2]], RATE),
                       ("B", "ambient", "off", ["c01", "c03", "c04"], cls.second[:, [0, 2, 3]], RATE),
                       ("A", "ambient", "on", ["c01", "c02", "c03"], chain(60000, 7)[:, :3], RATE),
                       ("A", "free_decay", "off", CHANNELS, decay(40, 1), RATE), ("A", "free_decay", "off", CHANNELS, decay(40, 2), RATE),
                       ("S1", "stay", "off", ["s1"], string(600, 3), RATE)]
        write(cls.folder / "campaign", cls.records)
        (cls.folder / "study").mkdir()
        (cls.folder / "study" / "s3_identification.toml").write_text('[[stay_length]]\nname = "S1"\nlength = "40 m"\n')
        cls.out = cls.folder / "out"
        arguments = [a for s in ("decimation=10", "block_rows=20", "maximum_order=40", "welch_segment=512", "decay.block_rows=40", "decay.band=0.2")
                     for a in ("--set", s)]
        done = subprocess.run([STEP, "--study", cls.folder / "study", "--campaign", cls.folder / "campaign", "--out", cls.out, *arguments], cwd=ROOT,
                              capture_output=True, text=True, timeout=300)
        if done.returncode:
            raise AssertionError(done.stderr)

    def test_setups_are_merged_over_their_references(self):
        modes = rows(self.out / "modes.csv")
        self.assertEqual([m["setups"] for m in modes], ["2"] * N)
        self.assertEqual([m["partial"] for m in modes], ["0"] * N)
        for r, mode in enumerate(modes, 1):
            self.assertAlmostEqual(float(mode["frequency_Hz"]) / frequency(r), 1.0, delta=0.005)
        found = {}
        for row in rows(self.out / "shapes.csv"):
            found.setdefault(row["mode"], {})[row["direction"]] = complex(float(row["value"]), float(row["value_imag"]))
        for mode, components in found.items():
            v, truth = np.array([components[c] for c in CHANNELS]), shape(int(mode))
            self.assertGreater(abs(np.vdot(truth, v))**2 / (np.vdot(v, v).real * np.vdot(truth, truth).real), 0.99)
        for check in rows(self.out / "merging.csv"):
            self.assertGreater(float(check["mac"]), 0.98)

    def test_the_second_condition_has_a_folder_and_rows_of_its_own(self):
        self.assertEqual(len(rows(self.out / "conditions" / "on" / "modes.csv")), N)
        table = rows(self.out / "features" / "rows.csv")
        self.assertEqual({r["condition"] for r in table}, {"off", "on"})
        self.assertTrue(all(float(r["std"]) > 0 for r in table))
        self.assertEqual((self.out / "features" / "conditions.toml").read_text(), "[off]\n[on]\n")

    def test_free_decays_agree_with_the_ambient_records(self):
        decays = rows(self.out / "decays.csv")
        self.assertEqual(len(decays), N)
        for r, mode in enumerate(decays, 1):
            self.assertEqual(mode["ambient_mode"], str(r))
            sigma = math.hypot(float(mode["frequency_std_Hz"]), float(mode["ambient_frequency_std_Hz"]))
            self.assertLess(abs(float(mode["frequency_Hz"]) - float(mode["ambient_frequency_Hz"])), 4 * sigma)
            self.assertLess(abs(float(mode["frequency_Hz"]) - frequency(r)), max(4 * float(mode["frequency_std_Hz"]), 2e-3))
        levels = rows(self.out / "amplitude.csv")
        self.assertEqual({row["source"] for row in levels}, {"free_decay", "ambient"})
        for row in (row for row in levels if row["source"] == "free_decay" and row["mode"]):
            self.assertAlmostEqual(float(row["frequency_Hz"]) / frequency(int(row["mode"])), 1.0, delta=0.005)

    def test_the_stay_is_a_string_with_sag(self):
        found = rows(self.out / "stays.csv")
        self.assertEqual([m["harmonic"] for m in found], ["1", "2", "3", "4", "5"])
        for m in found:
            n = int(m["harmonic"])
            self.assertAlmostEqual(float(m["frequency_Hz"]) / (1.5 * n * (1.08 if n == 1 else 1)), 1.0, delta=0.005)
        tension = rows(self.out / "stay_tensions.csv")[0]
        value, low, high = (float(tension[f"tension_per_mass{part}_m2_s2"]) for part in ("", "_low", "_high"))
        self.assertLess(abs(value - (2 * 40 * 1.5)**2), high - low)
        half = 0.5 * math.pi * 1.08
        truth = 4 * half**3 / (half - math.tan(half))
        # Half the interval of 95 % is two standard deviations: four of them.
        value, low, high = (float(tension[f"lambda_squared{part}"]) for part in ("", "_low", "_high"))
        self.assertLess(value - 2 * (value - low), truth)
        self.assertGreater(value + 2 * (high - value), truth)
        rows_of_stay = [r for r in rows(self.out / "features" / "rows.csv") if r["type"] == "stay_frequency_Hz"]
        self.assertEqual([(r["channel"], r["mode"]) for r in rows_of_stay], [("S1", str(n)) for n in range(1, 6)])

    def test_a_campaign_of_stays_alone_is_read(self):
        stay = ("NE5", "stay", "spring", ["s1"], string(600, 9), RATE)
        bridge = ("A", "ambient", "summer", CHANNELS, chain(30000, 4), RATE)
        write(self.folder / "stays", [stay])
        write(self.folder / "bridge_and_stays", [bridge, stay])
        for name, sets in (("stays", []), ("stays", ["kind=stay"]), ("bridge_and_stays", ["kind=stay"])):
            with self.subTest(name, sets=sets):
                out = self.folder / f"{name}_out"
                done = run(self.folder / name, out, *sets)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(rows(out / "modes.csv"), [])
                found = [float(h["frequency_Hz"]) for h in rows(out / "stays.csv")]
                np.testing.assert_allclose(found, [1.62, 3.0, 4.5, 6.0, 7.5], rtol=0.01)
                features = rows(out / "features" / "rows.csv")
                self.assertEqual({(f["type"], f["channel"], f["condition"]) for f in features}, {("stay_frequency_Hz", "NE5", "spring")})
                self.assertEqual((out / "features" / "conditions.toml").read_text(), "[spring]\n")
        write(self.folder / "no_stays", [bridge])
        done = run(self.folder / "no_stays", self.folder / "no_stays_out", "kind=stay")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("kind 'stay'; there are A/summer/ambient", done.stderr)

    def test_measured_inputs_are_used(self):
        random = np.random.default_rng(9)
        n = 12000
        ring, u = 0j, np.empty(n)
        for t in range(n):
            ring = np.exp((-0.02 + 1j) * 2 * math.pi * 3.0 / 25) * ring + random.standard_normal()
            u[t] = ring.imag + 0.3 * random.standard_normal()
        states, y = np.zeros(2, complex), np.empty((n, 2))
        poles = np.exp((-0.015 + 1j) * 2 * math.pi * np.array([1.7, 4.1]) / 25)
        for t in range(n):
            y[t] = [states[0].imag + states[1].imag, 0.6 * states[0].imag - 1.3 * states[1].imag]
            states = poles * states + u[t]
        write(self.folder / "shaken", [("E1", "earthquake", "strong", ["u1", "c01", "c02"], np.column_stack([u, y + 0.1 * random.standard_normal(y.shape)]), 25.0)])
        done = run(self.folder / "shaken", self.folder / "shaken_out", "kind=earthquake", "decimation=1", "maximum_order=20")
        self.assertEqual(done.returncode, 0, done.stderr)
        np.testing.assert_allclose([float(m["frequency_Hz"]) for m in rows(self.folder / "shaken_out" / "modes.csv")], [1.7, 4.1], rtol=0.005)

    def test_campaigns_that_cannot_be_merged_are_refused_in_one_line(self):
        a, b = self.records[0], self.records[1]
        other = ("B", "ambient", "off", ["c04", "c05", "c06"], b[4], RATE)
        truncated = self.folder / "cut"
        write(truncated, [a])
        text = (truncated / "campaign.toml").read_text()
        (truncated / "campaign.toml").write_text(text.replace("0.npy", "cut.uff"))
        (truncated / "cut.uff").write_text("    -1\n    58\n" + "NONE\n" * 5 + "    1         1    0         0 NONE               1   3 NONE               0   0\n"
                                           "         2      1000         1  0.00000E+00  1.00000E-02  0.00000E+00\n" + "        17    0    0    0 NONE\n" * 4
                                           + "  1.00000E+00  2.00000E+00\n")
        cases = [("reference", [a, other], "no reference channel is in each of the 2 setups"),
                 ("cut", None, "states 1000 values, expected a whole number from 1 to what 341 bytes can hold")]
        for name, records, expected in cases:
            with self.subTest(name):
                if records:
                    write(self.folder / name, records)
                done = run(self.folder / name, self.folder / (name + "_out"))
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertIn(expected, done.stderr)
                self.assertFalse((self.folder / (name + "_out")).exists())


if __name__ == "__main__":
    unittest.main()
