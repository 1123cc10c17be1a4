"""Step 8 on a user's own straight deck of beams.

Oracles: the frequency domain's RMS within the seeds' interval; sines of known RMS as measured records; the critical speed of step 7; the same bytes whatever the threads; RMS in proportion to the turbulence;
the whole model and the half time step under the same forces; files and words that are not as they should be are refused by their names.
"""
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from test_aerodynamics import BIN, CHORD, EXCEPTIONS, PANELS, ROOT, write_flutter, write_model  # noqa: E402

MIDDLE = 2 * (PANELS // 2) + 1
SETS = "set,roughness_m,minimum_height_m,kappa,sigma_u_over_v,sigma_w_over_v,scale_u_over_v,scale_w_over_v,"
SETS += ",".join(f"decay_{c}_{a}" for c in "vuw" for a in ("along", "across", "vertical")) + "\n"
# 1/ln(z/z0) at 10 m is 0.1 for the one, 0.2 for the other; all else equal
SETS += "calm,0.000453999297625,0.001,0.4,0.75,0.5,0.25,0.1,3,10,10,6,6.5,6.5,3,6.5,3\n"
SETS += "rough,0.0673794699909,0.1,0.4,0.75,0.5,0.25,0.1,3,10,10,6,6.5,6.5,3,6.5,3\n"


class Validation(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        write_model(self.folder / "model")
        (self.folder / "model/points.csv").write_text(f"point,node\nM1,{MIDDLE}\nM2,{MIDDLE // 2 // 2 * 2 + 1}\n")
        write_flutter(self.folder / "flutter.csv")
        (self.folder / "polar.csv").write_text("alpha_deg,C_D,C_L,C_M\n-10,0.1,0.54105,0\n0,0.1,0,0\n10,0.1,-0.54105,0\n")
        (self.folder / "sets.csv").write_text(SETS)
        study = self.folder / "study"
        study.mkdir()
        (study / "s7_aerodynamics.toml").write_text(
            'direction_deg = 90.0\nnodes_per_deck = 20\nmodels = ["A", "C"]\nsets = ["standin"]\nstructural_damping = 0.02\nn_modes = 6\n'
            'followed_modes = 1\nmax_speed = 20.0\nspeed_step = 5.0\n'
            f'[[deck]]\nname = "deck"\ncross_group = "deck_floor"\nchord = {CHORD}\nexceptions = {EXCEPTIONS}\n'
            f'polar = "{self.folder}/polar.csv"\nflutter = "{self.folder}/flutter.csv"\n')
        (study / "s8_validation.toml").write_text(
            f'turbulence_file = "{self.folder}/sets.csv"\nturbulence_set = "calm"\nheight = 10.0\nseeds = 6\nduration = 120.0\nlead_in = 20.0\n'
            'step = 0.0078125\nn_modes = 8\nfull_model_check = 10.0\n[[event]]\nname = "breeze"\nspeed = 8.0\n'
            '[[run]]\nname = "normal"\nmodel = "A"\n[[run]]\nname = "cosine"\nmodel = "C"\n')
        self.step("s7_aerodynamics")

    def step(self, token, *options, out=None, status=0):
        results = self.folder / "results"
        done = subprocess.run([BIN / token, "--study", self.folder / "study", "--model", self.folder / "model", "--results", results, "--out",
                               results / (out or token), "--quiet", *options], capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stderr

    def read(self, name, out="s8_validation"):
        with open(self.folder / "results" / out / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_time_histories_scatter_around_the_frequency_domain(self):
        self.step("s8_validation")
        rows = [r for r in self.read("rms.csv") if r["direction"] == "z"]
        self.assertEqual({(r["run"], r["channel"]) for r in rows}, {(run, m) for run in ("normal", "cosine") for m in ("M1", "M2")})
        for row in rows:
            # no more than twice the 95 % interval away: five standard deviations of the mean of six seeds
            half = float(row["rms_high_m_s2"]) - float(row["rms_m_s2"])
            self.assertLess(abs(float(row["rms_m_s2"]) - float(row["spectral_rms_m_s2"])), 2 * half + 0.01 * float(row["rms_m_s2"]), row)
            self.assertEqual(row["measured_rms_m_s2"], "")
        for a, b in zip(rows[:2], rows[2:]):  # wind across the deck: no yaw, so that the cosine rule changes nothing
            self.assertAlmostEqual(float(a["rms_m_s2"]) / float(b["rms_m_s2"]), 1.0, delta=1e-9)
        for row in self.read("checks.csv"):
            self.assertEqual(row["verdict"], "met", row)
        self.assertEqual({r["check"] for r in self.read("checks.csv")}, {"half_step", "full_model"})
        for row in self.read("wind_check.csv"):
            self.assertEqual(row["verdict"], "met", row)

    def test_threads_do_not_matter_and_rms_grows_with_the_turbulence(self):
        few = ("--set", "seeds=2", "--set", "duration=30.0", "--set", "full_model_check=0")
        self.step("s8_validation", *few, "--threads", "1", out="one")
        self.step("s8_validation", *few, "--threads", "2", out="two")
        for name in ("rms.csv", "comfort.csv", "wind_check.csv", "checks.csv"):
            self.assertEqual((self.folder / "results/one" / name).read_bytes(), (self.folder / "results/two" / name).read_bytes(), name)
        self.step("s8_validation", *few, "--set", "turbulence_set=rough", out="rough")
        for calm, rough in zip(self.read("rms.csv", "one"), self.read("rms.csv", "rough")):
            if calm["direction"] == "z":
                self.assertAlmostEqual(float(rough["rms_m_s2"]) / float(calm["rms_m_s2"]), 2.0, delta=1e-6)

    def campaign(self, m1=None):
        """A condition of two records: ten seconds of M1 with an RMS of 0.01, forty of M2 with 0.03. @param m1 cells of M1's row that differ"""
        folder = self.folder / "campaign"
        (folder / "records").mkdir(parents=True, exist_ok=True)
        points = dict(line.split(",") for line in (self.folder / "model/points.csv").read_text().split()[1:])
        nodes = dict(line.split(",", 1) for line in (self.folder / "model/nodes.csv").read_text().split()[1:])
        rows, entries = [], []
        for channel, seconds, rms in (("M1", 10, 0.01), ("M2", 40, 0.03)):
            x, y, z = nodes[points[channel]].split(",")
            cells = dict(x_m=x, y_m=y, z_m=z, dx=0, dy=0, dz=-1, quantity="acceleration", unit="m/s^2", role="response")
            cells.update(m1 or {} if channel == "M1" else {})
            rows.append(",".join(map(str, (channel, channel, *(cells[k] for k in ("x_m", "y_m", "z_m", "dx", "dy", "dz", "quantity", "unit", "role"))))))
            samples = [rms * math.sqrt(2) * math.sin(2 * math.pi * 2.0 * i / 50) for i in range(50 * seconds)]  # whole waves
            (folder / f"records/{channel}.csv").write_text(f"{channel}\n" + "".join(f"{v:.9g}\n" for v in samples))
            entries.append(f'[[record]]\nsetup = "{channel}"\nkind = "wind"\nfile = "records/{channel}.csv"\nsampling_rate_Hz = 50.0\n'
                           f'channels = ["{channel}"]\ncondition = "windy"\n')
        (folder / "channels.csv").write_text("channel,point,x_m,y_m,z_m,dx,dy,dz,quantity,unit,role\n" + "\n".join(rows) + "\n")
        (folder / "campaign.toml").write_text("".join(entries))
        (folder / "conditions.toml").write_text('[windy]\ndampers = "on"\n')
        return folder

    def measured(self, m1=None):
        """Measured RMS of each channel, and the step's warnings."""
        few = ("--set", "seeds=2", "--set", "duration=8.0", "--set", "lead_in=2.0", "--set", "full_model_check=0")
        toml = self.folder / "study/s8_validation.toml"
        toml.write_text(toml.read_text().replace("speed = 8.0\n[[run]]", 'speed = 8.0\ncondition = "windy"\n[[run]]', 1))
        self.step("s8_validation", *few, "--campaign", self.campaign(m1))
        rows = {(r["channel"], r["direction"]): r["measured_rms_m_s2"] for r in self.read("rms.csv") if r["run"] == "normal"}
        warnings = json.loads((self.folder / "results/s8_validation/manifest.json").read_text())["warnings"]
        self.assertEqual({v for (_, d), v in rows.items() if d != "z"}, {""})
        return rows["M1", "z"], rows["M2", "z"], warnings

    def test_each_channel_has_the_rms_of_its_own_records(self):
        one, two, warnings = self.measured()
        self.assertAlmostEqual(float(one), 0.01, delta=1e-5)  # the trend of a sine over whole waves is nearly none
        self.assertAlmostEqual(float(two), 0.03, delta=3e-5)
        self.assertEqual(warnings, [])

    def test_a_channel_that_is_no_vertical_acceleration_of_its_point_is_left_out(self):
        for m1, told in (({"dy": 1, "dz": 0}, "its direction is (0, 1, 0)"), ({"dy": 0.6, "dz": 0.8}, "its direction is (0, 0.6, 0.8)"),
                         ({"quantity": "velocity", "unit": "m/s"}, "it is a velocity"), ({"role": "input"}, "its role is input"),
                         ({"x_m": 210}, "180 m from the point"), ({"dx": "", "dy": "", "dz": ""}, "dx, dy, dz is not given")):
            one, two, warnings = self.measured(m1)
            self.assertEqual(one, "", m1)
            self.assertAlmostEqual(float(two), 0.03, delta=3e-5)
            self.assertEqual(len(warnings), 1, warnings)
            self.assertIn("channel M1 is not the vertical acceleration", warnings[0])
            self.assertIn(told, warnings[0])
        one, _, warnings = self.measured({"x_m": "", "y_m": "", "z_m": ""})  # no position, no contradiction
        self.assertAlmostEqual(float(one), 0.01, delta=1e-5)

    def test_an_unstable_bridge_has_no_rms(self):
        self.step("s7_aerodynamics", "--set", "max_speed=150.0")
        with open(self.folder / "results/s7_aerodynamics/critical.csv", newline="", encoding="utf-8") as file:
            row = next(r for r in csv.DictReader(file) if r["model"] == "A" and r["structural_damping_pct"] == "2")
        critical = float(row["V_cr_m_s"])
        toml = self.folder / "study/s8_validation.toml"
        text = toml.read_text().replace("seeds = 6\nduration = 120.0", "seeds = 2\nduration = 20.0")
        toml.write_text(text + f'[[event]]\nname = "storm"\nspeed = {1.01 * critical}\n')
        self.step("s8_validation")
        rows = self.read("rms.csv")
        self.assertEqual({(r["event"], r["rms_m_s2"] == "", r["spectral_rms_m_s2"] == "", r["peak_m_s2"] == "") for r in rows},
                         {("breeze", False, False, False), ("storm", True, True, True)})
        self.assertEqual({(r["event"], r["verdict"] == "unstable") for r in self.read("comfort.csv")}, {("breeze", False), ("storm", True)})
        warnings = json.loads((self.folder / "results/s8_validation/manifest.json").read_text())["warnings"]
        self.assertEqual(len(warnings), 2)
        for part in ("event storm at", "run normal (model A)", "mode 1 grows at"):
            self.assertIn(part, warnings[0])
        toml.write_text(text.replace("speed = 8.0", f"speed = {1.01 * critical}"))
        self.assertIn("event breeze at", self.step("s8_validation", out="none", status=1))
        self.step("s8_validation", "--accept-unconverged")  # its tables say that nothing is known
        self.assertEqual({(r["event"], r["rms_m_s2"]) for r in self.read("rms.csv")}, {("breeze", "")})
        self.assertEqual(self.read("checks.csv"), [])
        toml.write_text(text.replace("speed = 8.0", f"speed = {0.99 * critical}"))
        self.step("s8_validation")

    def test_a_model_without_monitoring_points_is_told(self):
        (self.folder / "model/points.csv").write_text("point,node\nP1,3\n")
        self.step("s8_validation", "--set", "seeds=2", "--set", "duration=8.0", "--set", "full_model_check=0")
        warnings = json.loads((self.folder / "results/s8_validation/manifest.json").read_text())["warnings"]
        self.assertIn("no monitoring point", warnings[0])
        self.assertEqual(self.read("rms.csv"), [])

    def test_what_is_not_as_it_should_be_is_refused(self):
        message = self.step("s8_validation", "--set", "turbulence_set=calmer", status=2)
        self.assertIn("did you mean 'calm'", message)
        self.assertIn("calm, rough", message)
        self.assertIn("step", self.step("s8_validation", "--set", "step=0.02", status=2))
        self.assertIn("no set 'standing'", self.step("s8_validation", "--set", "set=standing", status=2))
        self.assertIn("at least two", self.step("s8_validation", "--set", "cutoff=200.0", status=2))


if __name__ == "__main__":
    unittest.main()
