"""Studies of real structures, from the records to the report; each is skipped where its records are not at hand.

Oracles. weimar_frame: the eleven frequencies that the authors publish (test_weimar_frame.py judges them; here the report must show them).
Of the model as written: sway of clamped rods M8 by hand, 4 rods of 12 EI/L^3 a storey under floors of 5 kg, at least 1.5 times too fast,
so that bounds of belief are reached. Of the fixed accelerometers: their motion against the laser's at the same floor, from the spectra of
the raw records at the first sway in x and in y, where the floor moves as one; no model in it. (Whole chain: TWINDECK_SLOW=1, half a minute.)
meloland_overpass: frequencies of the transverse mode read off the transfer functions from footing to deck, Welch segments of 8 s, which
part 0.125 Hz: within 0.15 Hz of ours in the four weak earthquakes; and the published finding that stiffness falls as shaking grows
(Gates, ASCE, Meloland Road Overcrossing), ascribed to the soil at abutments and footing. gt_pedestrian_bridge (TWINDECK_SLOW=1: half a minute): its report shows the authors' updated
frequencies and a verdict.
"""
import csv
import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
DATA = pathlib.Path(os.environ.get("TWINDECK_DATA", ROOT.parent / "shared" / "data"))
TRANSFER_PEAK_HZ = {"nov2008_017": 3.296, "jun2016_030": 3.198, "aftershock2009_038": 3.137, "jul2010_053": 3.345}
STRONG = ("oct1979_484", "dec2009_498")


def at_hand(folder):
    return unittest.skipUnless(
        (DATA / folder).is_dir(), f"the records are not at hand ({DATA / folder}); name their parent folder by TWINDECK_DATA"
    )


class RealStudies(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        for part in ("workflows", "paper", "data/template"):
            shutil.copytree(ROOT / part, cls.root / part, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy(ROOT / "Makefile", cls.root / "Makefile")

    def make(self, *arguments):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
        return subprocess.run(
            ["make", "NO_BUILD=1", f"BIN={BIN}", "THREADS=1", *arguments],
            cwd=self.root,
            env=environment,
            capture_output=True,
            text=True,
            timeout=600,
        )

    def report(self, study, folder):
        done = self.make("all", f"STUDY={study}", f"DATA={DATA / folder}")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (self.root / "results" / study / "report" / "report.html").read_text(encoding="utf-8")
        for part in ("Where the data come from", "Licence:", "github.com/"):
            self.assertIn(part, page)
        return page

    def table(self, file):
        with open(self.root / "results" / file, newline="") as stream:
            return list(csv.DictReader(stream))

    @at_hand("weimar_steel_frame_15setups")
    def test_weimar_frame_as_written(self):
        done = self.make("s6", "STUDY=weimar_frame", f"DATA={DATA / 'weimar_steel_frame_15setups'}")
        self.assertEqual(done.returncode, 0, done.stderr)
        drawn = self.table("weimar_frame/s4_refinement/comparison.csv")
        error = [float(r["error_pct"]) for r in drawn if r["stage"] == "refined"]
        self.assertEqual(len(error), 10)
        self.assertGreater(min(error), 50.0)
        parameters = self.table("weimar_frame/s6_updating/parameters.csv")
        bounded = {r["parameter"] for r in parameters if r["bound"] in ("lower", "upper")}
        self.assertIn("EI_rod", bounded)
        self.assertGreaterEqual(len(bounded), 4)
        print(f"as written {min(error):.0f} to {max(error):.0f} % too fast; {len(bounded)} of {len(parameters)} parameters on a bound")

    def accelerometer_factor(self, channel, frequency_Hz, direction):
        """What accelerometer `channel` reads, times the laser's acceleration of the same floor along the accelerometer (setup 13, point 21)."""
        folder = DATA / "weimar_steel_frame_15setups"
        record = np.load(folder / "setup_13.npy").astype(float)
        beams = [line.split("\t") for line in (folder / "setup_13_channel_dofs.txt").read_text(encoding="latin-1").splitlines()[1:4]]
        cosines = [
            (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))
            for a, e in ((math.radians(float(b[2])), math.radians(float(b[3]))) for b in beams)
        ]
        length, spectrum = 8192, 0.0
        for start in range(0, len(record) - length + 1, length // 2):
            lines = np.fft.rfft(record[start : start + length] * np.hanning(length)[:, None], axis=0)
            spectrum = spectrum + np.conj(lines[:, [channel]]) * lines
        at = int(round(frequency_Hz * length / 256.0))
        velocity = np.linalg.solve(np.array(cosines), spectrum[at, :3] / spectrum[at, channel].real)
        return 1.0 / (2j * math.pi * frequency_Hz * velocity @ np.array(direction)).real

    @at_hand("weimar_steel_frame_15setups")
    @unittest.skipUnless(os.environ.get("TWINDECK_SLOW"), "half a minute: set TWINDECK_SLOW=1")
    def test_weimar_frame(self):
        page = self.report("weimar_frame", "weimar_steel_frame_15setups")
        for part in ("1.2283 ± 0.0012", "13.854 ± 0.011", 'id="mode-shapes"', 'id="poles"', "verdict of the diagnosis"):
            self.assertIn(part, page)
        told = json.loads((self.root / "results/weimar_frame/s9_diagnosis/diagnosis.json").read_text())
        effects = {e["location"]: e["parameters"][0] for e in told["effects"] if e["cause"] == "calibration"}
        self.assertEqual(set(effects), {"channel:ref_x", "channel:ref_y"})
        # ref_x is written down along -x, ref_y along -y. What is claimed is the interval: the model is 8 % off, and factors have been 3 to 12 % off.
        for name, channel, hertz, direction in (("ref_x", 3, 1.2284, (-1, 0, 0)), ("ref_y", 4, 1.4357, (0, -1, 0))):
            measured = self.accelerometer_factor(channel, hertz, direction)
            told_of = effects["channel:" + name]
            print(f"{name}: {measured:.3f} in the records, -{told_of['value']:.3f} diagnosed, {told_of['low']:.3f} to {told_of['high']:.3f}")
            self.assertTrue(told_of["low"] <= -measured <= told_of["high"])
        pairs = self.table("weimar_frame/s9_diagnosis/pairs.csv")
        self.assertEqual(len(pairs), 10)
        for pair in pairs:
            mixed = pair["mode"] in ("7", "8")  # sway in x and y together, which a bracing in y alone does not explain
            self.assertGreater(float(pair["mac_after"]), 0.8 if mixed else 0.9, pair)
            self.assertGreater(float(pair["mac_after"]), float(pair["mac_before"]), pair)
        self.assertGreater(told["gain"]["interval_pct"][0], 20.0)
        full = told["full_model"]["largest_deviation_pct"]
        self.assertLess(full, 2.0, "the second pass works in a basis that knows the softened frame")
        print(f"{told['verdict']}; gain {told['gain']['reduction_pct']:.0f} %, basis within {full:.2f} % of the full model")

    @at_hand("meloland_overpass")
    def test_meloland_overpass(self):
        page = self.report("meloland_overpass", "meloland_overpass")
        self.assertIn("Modes identified, condition by condition", page)
        with open(self.root / "results/meloland_overpass/tables/identified_by_condition.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        weak = {}
        for condition, peak in TRANSFER_PEAK_HZ.items():
            found = [float(r["frequency_Hz"]) for r in rows if r["condition"] == condition]
            weak[condition] = min(found, key=lambda f: abs(f - peak))
            self.assertLess(abs(weak[condition] - peak), 0.15, condition)
        fallen = []
        for condition in STRONG:  # of the modes known to a tenth of a hertz or, in twenty seconds of strong motion, a third of one
            found = [
                r
                for r in rows
                if r["condition"] == condition and 2.0 < float(r["frequency_Hz"]) < 3.5 and float(r["frequency_std_Hz"]) < 0.35
            ]
            lowest = min(float(r["frequency_Hz"]) for r in found)
            self.assertLess(lowest, 0.97 * min(weak.values()), f"{condition}: softer than in every weak shaking")
            fallen.append(lowest / min(weak.values()))
            print(f"{condition}: {lowest:.2f} Hz, weak shaking {min(weak.values()):.2f} to {max(weak.values()):.2f} Hz")
        self.assertLess(min(fallen), 0.85, "less than 72 % of the stiffness is left in the strongest shaking")
        self.assertIn("verdict of the diagnosis", page)
        self.softening_is_diagnosed(self.root / "results/meloland_overpass")

    def softening_is_diagnosed(self, folder):
        # The frequencies of the four weak earthquakes are met by one linear model, which is too stiff for each of the three that it did not see.
        with open(folder / "weak_fit/residuals.csv", newline="") as stream:
            frequencies = [r for r in csv.DictReader(stream) if r["type"] == "frequency_Hz"]
        weak, strong = ([float(r["residual_before"]) for r in frequencies if r["held_out"] == held] for held in "01")
        self.assertEqual((len(weak), len(strong)), (4, 3))
        self.assertLess(max(map(abs, weak)), 3.7)
        self.assertLess(max(strong), -2.0)
        # Shapes change between earthquakes by more than their deviations: nothing is named. The published finding is among what comes nearest
        # and predicts the earthquakes that are left out. Whole records and the strong ones in two parts agree.
        done = self.make("windows", "STUDY=meloland_overpass", f"DATA={DATA / 'meloland_overpass'}")
        self.assertEqual(done.returncode, 0, done.stderr)
        for part in ("s9_diagnosis", "windows/s9_diagnosis"):
            told = json.loads((folder / part / "diagnosis.json").read_text())
            self.assertIn(told["verdict"], ("unknown", "ambiguous"))
            with open(folder / part / "hypotheses.csv", newline="") as stream:
                ranking = [r for r in csv.DictReader(stream) if r["log_odds"]]
            near = [(r["cause"], r["location"]) for r in ranking if float(r["log_odds"]) > float(ranking[0]["log_odds"]) - math.log(20.0)]
            self.assertIn(("soften", "group:abutments"), near, "not told apart from what comes nearest, at odds of 20 to 1")
            self.assertGreater(told["gain"]["log_gain_interval"][0], 10.0, "nats")
            print(f"Meloland, {part}: {told['message']}")

    @at_hand("gt_pedestrian_bridge")
    def test_gt_pairs_and_updating(self):
        # Oracle: what the authors publish. Measured modes 1 and 2 are the model's 2 and 1; updating stiffness alone puts 13 of 17 parameters
        # on a bound and lowers every MAC, to 0.934, 0.980, 0.940, 0.917, 0.884. Ours weighs frequencies only, theirs the MAC too: 0.02.
        done = self.make("s6", "STUDY=gt_pedestrian_bridge", f"DATA={DATA / 'gt_pedestrian_bridge'}")
        self.assertEqual(done.returncode, 0, done.stderr)
        folder = self.root / "results/gt_pedestrian_bridge"
        with open(folder / "s4_refinement/pairs.csv", newline="") as stream:
            pairs = [(r["experimental_mode"], r["numerical_mode"]) for r in csv.DictReader(stream)]
        self.assertEqual(pairs, [("1X", "2N"), ("2X", "1N"), ("3X", "3N"), ("4X", "4N"), ("5X", "5N")])
        with open(folder / "s6_updating/comparison.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        mac = {stage: [float(r["mac"]) for r in rows if r["stage"] == stage] for stage in ("before", "after")}
        for before, after, published in zip(mac["before"], mac["after"], (0.934, 0.980, 0.940, 0.917, 0.884)):
            self.assertLess(after, before)
            self.assertAlmostEqual(after, published, delta=0.02)
        with open(folder / "s6_updating/parameters.csv", newline="") as stream:
            bounded = [r for r in csv.DictReader(stream) if any(value in ("lower", "upper") for value in r.values())]
        print(f"{len(bounded)} of 17 parameters on a bound, MAC {' '.join(f'{m:.3f}' for m in mac['after'])}")
        self.assertGreaterEqual(len(bounded), 12)

    @at_hand("gt_pedestrian_bridge")
    @unittest.skipUnless(os.environ.get("TWINDECK_SLOW"), "half a minute: set TWINDECK_SLOW=1")
    def test_gt_pedestrian_bridge(self):
        page = self.report("gt_pedestrian_bridge", "gt_pedestrian_bridge")
        for part in ("verdict of the diagnosis", "11.43", "Residuals in standard deviations"):
            self.assertIn(part, page)
        # What stiffness alone makes worse, the diagnosis must not: shapes at least as like as drawn in the mean, fewer bounds than half of 13.
        folder = self.root / "results/gt_pedestrian_bridge"
        with open(folder / "s4_refinement/pairs.csv", newline="") as stream:
            drawn = sum(float(r["mac"]) for r in csv.DictReader(stream)) / 5.0
        with open(folder / "s9_diagnosis/pairs.csv", newline="") as stream:
            extended = sum(float(r["mac_after"]) for r in csv.DictReader(stream)) / 5.0
        self.assertGreater(extended, drawn)
        told = json.loads((folder / "s9_diagnosis/diagnosis.json").read_text())
        self.assertLessEqual(len(told["parameters_on_bounds"]), 6)
        print(f"MAC in the mean {drawn:.3f} as drawn, {extended:.3f} extended; {told['verdict']}")

    def test_records_that_nobody_named(self):
        for study in ("weimar_frame", "meloland_overpass", "gt_pedestrian_bridge"):
            with self.subTest(study):
                shutil.rmtree(self.root / "results" / study, ignore_errors=True)
                done = self.make("steps", f"STUDY={study}")
                self.assertEqual(done.returncode, 2)
                self.assertIn("DATA", done.stderr)


if __name__ == "__main__":
    unittest.main()
