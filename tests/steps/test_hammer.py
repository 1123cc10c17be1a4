"""s3_identification on the frequency response functions of a hammer test, from universal files to tables.

Oracle: the modes of a model of five degrees of freedom in closed form, whose accelerances the test writes as set 58.
"""
import csv
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
FREQUENCY = np.array([6.0, 9.0, 9.4, 17.0, 26.0])  # Hz
DAMPING = np.array([0.008, 0.012, 0.010, 0.004, 0.02])
SHAPES = np.linalg.qr(np.random.default_rng(4).standard_normal((6, 5)))[0]  # of unit modal mass, at nodes 1 to 6
LINES = np.arange(4.0, 32.0, 0.0625)


def accelerance(response, reference):
    w, own = 2 * np.pi * LINES[:, None], 2 * np.pi * FREQUENCY
    return (-w**2 * SHAPES[response] * SHAPES[reference] / (own**2 - w**2 + 2j * DAMPING * own * w)).sum(axis=1)


def function(response, reference, noise=0.01, binary=False, kind=4, values=None):
    """A set 58 of nodes `response` and `reference`, direction +z, from 1 on."""
    h = accelerance(response - 1, reference - 1) if values is None else values
    random = np.random.default_rng(100 * response + reference)
    h = h + noise * np.sqrt(np.mean(abs(h)**2) / 2) * (random.standard_normal(len(h)) + 1j * random.standard_normal(len(h)))
    n, flat = len(h), np.column_stack([h.real, h.imag]).ravel()
    head = f"    58b     1     2          11{16 * n:12d}     0     0           0           0\n" if binary else "    58\n"
    text = "    -1\n" + head + 5 * f"{'NONE':<80}\n"
    text += f"{kind:5d}{0:10d}{0:5d}{0:10d} {'NONE':<10}{response:10d}{3:4d} {'NONE':<10}{reference:10d}{3:4d}\n"
    text += f"{6:10d}{n:10d}{1:10d}{LINES[0]:13.5E}{LINES[1] - LINES[0]:13.5E}{0.0:13.5E}\n"
    for code, label, unit in ((18, "Frequency", "Hz"), (12, "Acceleration", "m/s^2"), (13, "Force", "N"), (0, "NONE", "NONE")):
        text += f"{code:10d}{0:5d}{0:5d}{0:5d} {label:<20} {unit:<20}\n"
    if binary:
        return text.encode() + struct.pack(f"<{2 * n}d", *flat) + b"\n    -1\n"
    return (text + "\n".join("".join(f"{v:20.11E}" for v in flat[i:i + 4]) for i in range(0, 2 * n, 4)) + "\n    -1\n").encode()


GEOMETRY = ("    -1\n    15\n" + "".join(f"{n:10d}{0:10d}{0:10d}{11:10d}{float(n):13.5E}{0.0:13.5E}{0.5:13.5E}\n" for n in range(1, 7)) + "    -1\n").encode()


def rows(file):
    with open(file, newline="") as table:
        return list(csv.DictReader(table))


class Hammer(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def campaign(self, records, references=()):
        """records: (setup, name of the file, bytes, nodes of the shape)."""
        place = self.folder / "campaign"
        place.mkdir()
        nodes = sorted({n for r in records for n in r[3]})
        (place / "channels.csv").write_text("channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role\n" + "".join(
            f"{n}+z,N{n},{n},0,0.5,0,0,1,acceleration,m/s^2,1,{int(n in references)},response\n" for n in nodes))
        toml = ""
        for setup, name, data, points in records:
            (place / name).write_bytes(data)
            channels = ", ".join(f'"{n}+z"' for n in points)
            toml += f'[[record]]\nsetup = "{setup}"\nfile = "{name}"\nchannels = [{channels}]\n'
        (place / "campaign.toml").write_text(toml)
        return place

    def run_step(self, *arguments):
        return subprocess.run([BIN / "s3_identification", *arguments, "--threads", "1"], cwd=self.folder, capture_output=True, text=True, timeout=120)

    def identified(self, campaign, *sets):
        done = self.run_step("--campaign", campaign, "--out", "out", *[a for s in sets for a in ("--set", s)])
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout + done.stderr

    def expect_modes(self, nodes=range(1, 7)):
        """0.1 % of a frequency, 2 % of a damping ratio, MAC 0.999, errors within four standard deviations, that are some of 1e-3 at most."""
        modes, shapes = rows(self.folder / "out/modes.csv"), rows(self.folder / "out/shapes.csv")
        self.assertEqual(len(modes), len(FREQUENCY), modes)
        for k, mode in enumerate(modes):
            error = float(mode["frequency_Hz"]) - FREQUENCY[k]
            self.assertLess(abs(error), 1e-3 * FREQUENCY[k])
            self.assertLess(abs(error), 4 * float(mode["frequency_std_Hz"]))
            self.assertLess(float(mode["frequency_std_Hz"]), 1e-3 * FREQUENCY[k])
            error = float(mode["damping_ratio_pct"]) - 100 * DAMPING[k]
            self.assertLess(abs(error), 2 * DAMPING[k])
            self.assertLess(abs(error), 4 * float(mode["damping_ratio_std_pct"]))
            own = {s["direction"]: complex(float(s["value"]), float(s["value_imag"])) for s in shapes if s["mode"] == mode["mode"]}
            self.assertEqual(set(own), {f"{n}+z" for n in nodes})
            measured, true = np.array([own[f"{n}+z"] for n in nodes]), SHAPES[[n - 1 for n in nodes], k]
            self.assertGreater(abs(true @ measured)**2 / (true @ true) / np.vdot(measured, measured).real, 0.999)

    def test_a_roving_hammer_in_one_file(self):
        data = b"".join(function(6, n) for n in range(1, 7))
        said = self.identified(self.campaign([("ST1", "h.unv", data, range(1, 7))]))
        self.assertIn("pLSCF", said)
        self.assertIn("the hammer roved over 6 points", said)
        self.expect_modes()
        poles = rows(self.folder / "out/poles.csv")
        self.assertGreater(len({p["order"] for p in poles if p["mode"] == "1"}), 10)
        kinds = {r["type"] for r in rows(self.folder / "out/features/rows.csv")}
        self.assertEqual(kinds, {"frequency_Hz", "damping_ratio_pct", "shape", "shape_imag"})
        self.assertTrue(all(float(r["std"]) > 0 for r in rows(self.folder / "out/features/rows.csv")))
        singular = rows(self.folder / "out/singular_values.csv")
        self.assertEqual(len(singular), len(LINES))
        for name in ("channels.csv", "psd.csv", "modes.unv", "modes.vtu", "manifest.json", "features/conditions.toml"):
            self.assertTrue((self.folder / "out" / name).exists(), name)

    def test_a_binary_file_for_each_point_and_two_references(self):
        records = [("ST1", f"p{n}.uff", function(n, 1, binary=True) + function(n, 6, binary=True), [n]) for n in (3, 1, 2, 6, 5, 4)]
        self.identified(self.campaign(records))
        self.expect_modes()

    def test_two_setups_are_merged_over_their_references(self):
        sets = [("ST1", "a.unv", [1, 4, 2, 3]), ("ST2", "b.unv", [1, 4, 5, 6])]
        self.identified(self.campaign([(s, f, b"".join(function(n, 6) for n in nodes), nodes) for s, f, nodes in sets], references=(1, 4)))
        self.expect_modes()
        self.assertEqual({m["setups"] for m in rows(self.folder / "out/modes.csv")}, {"2"})

    def test_a_mode_can_be_deleted_and_the_band_cut(self):
        data = b"".join(function(6, n) for n in range(1, 7))
        place = self.campaign([("ST1", "h.unv", data, range(1, 7))])
        self.identified(place, "band.lowest=12", "band.highest=30")
        found = [float(m["frequency_Hz"]) for m in rows(self.folder / "out/modes.csv")]
        self.assertEqual([round(f) for f in found], [17, 26])
        pole = next(p for p in rows(self.folder / "out/poles.csv") if p["mode"] == "1")
        (self.folder / "kept.csv").write_text("setup,order,frequency_Hz,damping_ratio_pct,action\n" + ",".join(
            pole[c] for c in ("setup", "order", "frequency_Hz", "damping_ratio_pct")) + ",delete\n")
        self.identified(place, "band.lowest=12", "band.highest=30", f"keep={self.folder / 'kept.csv'}")
        self.assertEqual([round(float(m["frequency_Hz"])) for m in rows(self.folder / "out/modes.csv")], [26])

    def test_a_coherence_is_left_out_with_a_note(self):
        data = b"".join(function(6, n) for n in range(1, 7)) + function(6, 1, kind=6)
        said = self.identified(self.campaign([("ST1", "h.unv", data, range(1, 7))]))
        self.assertIn("1 coherences are left out", said)
        self.expect_modes()

    def test_inspection_and_a_study_out_of_the_file(self):
        file = self.folder / "test.unv"
        file.write_bytes(GEOMETRY + b"".join(function(6, n) for n in range(1, 7)))
        done = self.run_step("--inspect", file)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"6 frequency response functions, 6 points, 1 responses (the hammer roved), {len(LINES)} lines, 4 to 31.9375 Hz", done.stdout)
        new = subprocess.run([ROOT / "workflows/new.sh", "hammered", "--from", file], cwd=self.folder, capture_output=True, text=True,
                             timeout=120, env=os.environ | {"TWINDECK_BIN": str(BIN)})
        self.assertEqual(new.returncode, 0, new.stderr)
        channels = rows(self.folder / "data/hammered/campaign/channels.csv")
        self.assertEqual([(c["channel"], float(c["x_m"]), c["dz"]) for c in channels], [(f"{n}_z", float(n), "1") for n in range(1, 7)])
        done = self.run_step("--campaign", "data/hammered/campaign", "--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(rows(self.folder / "out/modes.csv")), len(FREQUENCY))

    def test_an_ambient_campaign_says_that_its_functions_are_not_used(self):
        place = self.campaign([("ST1", "h.unv", b"".join(function(6, n) for n in range(1, 7)), range(1, 7))])
        np.save(place / "a.npy", np.random.default_rng(1).standard_normal((4000, 6)))
        with open(place / "campaign.toml", "a") as toml:
            toml.write('[[record]]\nsetup = "ST2"\nkind = "ambient"\nfile = "a.npy"\nsampling_rate_Hz = 100.0\nchannels = ["1+z", "2+z", "3+z", "4+z", "5+z", "6+z"]\n')
        said = self.run_step("--campaign", place, "--out", "ambient").stderr
        self.assertIn("--set kind=frf", said)
        self.identified(place, "kind=frf")
        self.expect_modes()


if __name__ == "__main__":
    unittest.main()
