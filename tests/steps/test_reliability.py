"""Step 10 on a user's own straight deck of beams.

Oracles: without scatter it gives step 7's critical speed and step 8's RMS in the frequency domain; slopes of the critical speed and of a
response are what runs with the input changed give; shares of variance sum to one; probabilities rise with the wind; loss of section by the formula
of ISO 9224; hours per year by an integral of our own; bad inputs are refused by name.
"""
import csv
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import test_validation  # noqa: E402

NONE = ["--set", "damping_variation=0", "--set", "level_variation=0", "--set", "damper_variation=0", "--set", "turbulence_variation=0"]
SMALL = ["--set", 'speeds=["6 m/s","8 m/s"]', "--set", 'models=["A"]', "--set", "samples=500"]


class Reliability(unittest.TestCase):
    step, read = test_validation.Validation.step, test_validation.Validation.read

    def setUp(self):
        test_validation.Validation.setUp(self)
        config = self.folder / "study/s7_aerodynamics.toml"  # a deck that loses its damping below the highest speed
        config.write_text(config.read_text().replace("max_speed = 20.0", "max_speed = 150.0"))
        self.step("s7_aerodynamics")

    def critical(self, out, model="A"):
        return [row for row in self.read("critical.csv", out) if row["model"] == model][0]

    def test_without_scatter_it_gives_the_values_of_steps_7_and_8(self):
        self.step("s8_validation")
        self.step("s10_reliability", *NONE, *SMALL)
        step_7 = [row for row in self.read("critical.csv", "s7_aerodynamics") if row["model"] == "A" and float(row["structural_damping_pct"]) == 2.0][0]
        self.assertAlmostEqual(float(self.critical("s10_reliability")["speed_m_s"]) / float(step_7["V_cr_m_s"]), 1.0, delta=1e-6)
        self.compare("normal")

    def compare(self, run):
        """RMS values of step 8 in the frequency domain against step 10's deviations. @return  their sum"""
        responses = {(row["channel"], row["direction"]): float(row["deviation"]) for row in self.read("responses.csv", "s10_reliability") if float(row["speed_m_s"]) == 8.0}
        rms = {(row["channel"], row["direction"]): float(row["spectral_rms_m_s2"]) for row in self.read("rms.csv") if row["run"] == run}
        compared = {key: value for key, value in rms.items() if value > 1e-9}
        for key, value in compared.items():
            self.assertAlmostEqual(responses[key] / value, 1.0, delta=1e-6)
        self.assertGreaterEqual(len(compared), 2)
        return sum(compared.values())

    def test_the_gusts_laws_are_those_of_step_8(self):
        """A wind that is not normal to the deck, so that u' counts; spectra, coherence and u' of step 8's configuration."""
        config = self.folder / "study/s7_aerodynamics.toml"
        config.write_text(config.read_text().replace("direction_deg = 90.0", "direction_deg = 60.0"))
        self.step("s7_aerodynamics")
        own = self.folder / "coherence.csv"
        own.write_text("component,reduced_separation,coherence\n" +
                       "".join(f"{c},{0.1 * i:.1f},{math.exp(-0.1 * i):.9f}\n" for c in "vuw" for i in range(60)))
        validation = self.folder / "study/s8_validation.toml"
        plain, sums = validation.read_text(), []
        for laws in ("", f'spectrum = "kaimal"\ncoherence = "table"\ncoherence_file = "{own}"\n',
                     f'spectrum = "kaimal"\ncoherence = "table"\ncoherence_file = "{own}"\nacross = true\n'):
            validation.write_text(laws + plain)
            self.step("s8_validation")
            self.step("s10_reliability", *NONE, *SMALL, "--set", "response_model=C")
            sums.append(self.compare("cosine"))
        self.assertGreater(abs(sums[1] / sums[0] - 1.0), 0.01)
        self.assertGreater(sums[2], sums[1])

    def test_the_slope_on_the_damping_is_that_of_step_7(self):
        self.step("s10_reliability", *SMALL, *NONE, "--set", "damping_variation=0.01")
        spread = math.sqrt(math.log1p(0.01 ** 2))
        speeds = []
        config = self.folder / "study/s7_aerodynamics.toml"
        text = config.read_text()
        for sign in (1.0, -1.0):
            damping = 0.02 * math.exp(-0.5 * spread ** 2 + sign * spread)
            config.write_text(text.replace("structural_damping = 0.02", f"structural_damping = {damping!r}"))
            self.step("s7_aerodynamics", out="changed")
            speeds.append(min(float(row["V_cr_m_s"]) for row in self.read("critical.csv", "changed") if row["model"] == "A" and abs(float(row["structural_damping_pct"]) - 100.0 * damping) < 1e-6))
        importance = [row for row in self.read("importance.csv", "s10_reliability") if row["input"] == "structural_damping"][0]
        self.assertAlmostEqual(float(importance["slope_per_deviation_pct"]), 50.0 * math.log(speeds[0] / speeds[1]), delta=1e-4)
        self.assertAlmostEqual(float(importance["importance"]), 1.0, delta=1e-9)

    def test_bands_of_a_response_are_what_the_ends_of_an_input_give(self):
        # One input with a deviation of 2 %: its quantiles at 5 and 95 % put in as fixed values. 20,000 samples leave 1.5 % of a quantile's distance.
        # A limit of 4.5 deviations of the response has probabilities of some per cent, which move with it.
        config = self.folder / "study/s10_reliability.toml"
        fixed = [*NONE, "--set", 'speeds=["8 m/s"]', "--set", 'models=["A"]', "--set", "samples=20000"]
        self.step("s10_reliability", *fixed)
        deviation = max(float(row["deviation"]) for row in self.read("responses.csv", "s10_reliability") if row["direction"] == "vertical")
        limit = f'[[comfort]]\nname = "own"\nvertical = {4.5 * deviation!r}\n'
        for name, mean in (("structural_damping", 0.02), ("aerodynamic_level", 1.0), ("turbulence_intensity", 1.0)):
            config.write_text(f'{limit}[[random]]\nname = "{name}"\nlaw = "lognormal"\nmean = {mean}\ndeviation = {0.02 * mean}\n')
            self.step("s10_reliability", *fixed)
            band = [row for row in self.read("crossings.csv", "s10_reliability") if row["limit_state"] == "own vertical"][0]
            found = math.log(float(band["high"]) / float(band["low"]))
            ends = []
            for sign in (-1.0, 1.0):
                spread = math.sqrt(math.log1p(0.02 ** 2))
                value = mean * math.exp(-0.5 * spread ** 2 + sign * 1.6448536 * spread)
                config.write_text(f'{limit}[[random]]\nname = "{name}"\nmean = {value!r}\ndeviation = 0.0\n')
                self.step("s10_reliability", *fixed, out="fixed")
                ends.append(float([row for row in self.read("crossings.csv", "fixed") if row["limit_state"] == "own vertical"][0]["vanmarcke"]))
            self.assertAlmostEqual(found / abs(math.log(ends[1] / ends[0])), 1.0, delta=0.05, msg=name)

    def test_rare_excursions_by_three_ways(self):
        # The mean over samples, FORM (of first order) and subset simulation of one excursion, whose limit is 5 deviations.
        alone = ["--set", 'speeds=["8 m/s"]', "--set", 'models=["A"]', "--set", "samples=20000", "--set", "damping_variation=0.05", "--set",
                 "level_variation=0.02", "--set", "turbulence_variation=0.02"]
        self.step("s10_reliability", *alone)
        deviation = max(float(row["deviation"]) for row in self.read("responses.csv", "s10_reliability") if row["direction"] == "vertical")
        config = self.folder / "study/s10_reliability.toml"
        config.write_text(f'rare = ["own vertical"]\n[[comfort]]\nname = "own"\nvertical = {5 * deviation!r}\n')
        self.step("s10_reliability", *alone)
        mean = float([row for row in self.read("crossings.csv", "s10_reliability") if row["limit_state"] == "own vertical"][0]["vanmarcke"])
        found = {row["method"]: row for row in self.read("rare.csv", "s10_reliability")}
        subset = found["subset"]
        self.assertAlmostEqual(float(subset["probability"]) / mean, 1.0, delta=3.5 * float(subset["variation"]))
        self.assertAlmostEqual(float(found["form"]["probability"]) / mean, 1.0, delta=0.3)  # curvature of the limit state
        self.assertLess(float(subset["variation"]), 0.35)
        config.write_text(f'rare = ["own vertical"]\n[[comfort]]\nname = "own"\nvertical = {50 * deviation!r}\n')
        self.assertIn("always or never", self.step("s10_reliability", *alone, status=2))

    def section(self):
        with open(self.folder / "model/sections.csv", newline="", encoding="utf-8") as file:
            return next(csv.DictReader(file))["section"]

    def test_years_take_sections_and_the_rate_moves_what_they_moved(self):
        wall = f'[[wall]]\nsections = ["{self.section()}"]\nthickness = 0.02\nfirst_year = 1e-4\ncoating_life_years = 5\n'
        (self.folder / "study/s10_reliability.toml").write_text(wall)
        self.step("s10_reliability", *SMALL, *NONE, "--set", "years=[0,50]", "--set", "corrosion_variation=0.01")
        rows = self.read("years.csv", "s10_reliability")
        left = {float(row["years"]): float(row["value"]) for row in rows if row["quantity"] == "remaining_area"}
        loss = 1e-4 * (20 ** 0.523 + 25 * 0.523 * 20 ** -0.477)
        self.assertEqual(left[0.0], 1.0)
        self.assertAlmostEqual(left[50.0], 1.0 - loss / 0.02, delta=1e-11)
        speed = {float(row["years"]): row for row in rows if row["quantity"] == "critical_speed"}
        change = abs(math.log(float(speed[50.0]["value"]) / float(speed[0.0]["value"])))
        self.assertGreater(change, 1e-4)
        spread = math.log(float(speed[50.0]["high"]) / float(speed[50.0]["low"])) / (2 * 1.6448536)
        self.assertAlmostEqual(spread / (math.sqrt(math.log1p(1e-4)) * change), 1.0, delta=1e-6)
        self.assertAlmostEqual(float(speed[0.0]["high"]) / float(speed[0.0]["low"]), 1.0, delta=1e-12)

    def test_hours_per_year_are_the_integral_over_the_users_law(self):
        self.assertFalse((self.folder / "results/s10_reliability/annual.csv").exists())
        (self.folder / "study/s10_reliability.toml").write_text('[wind_law]\nkind = "weibull"\nscale = 3.0\nshape = 2.0\n')
        self.step("s10_reliability", *SMALL)
        points = [(0.0, 0.0)] + [(float(r["speed_m_s"]), float(r["probability"])) for r in self.read("fragility.csv", "s10_reliability") if r["limit_state"] == "comfort_lateral"]
        def probability(v):
            for (a, p), (b, q) in zip(points, points[1:]):
                if v <= b:
                    return p + (q - p) * (v - a) / (b - a)
            return 1.0
        step = 1e-3
        hours = 8766 * sum(probability((i + 0.5) * step) * (math.exp(-(i * step / 3.0) ** 2) - math.exp(-((i + 1) * step / 3.0) ** 2)) for i in range(30000))
        row = [r for r in self.read("annual.csv", "s10_reliability") if r["quantity"] == "comfort_lateral"][0]
        self.assertEqual(row["unit"], "hours per year")
        self.assertAlmostEqual(float(row["value"]) / hours, 1.0, delta=0.02)  # classes of 0.5 m/s

    def test_probabilities_rise_with_the_wind_and_lie_in_their_intervals(self):
        self.step("s10_reliability", *SMALL)
        shares = sum(float(row["importance"]) for row in self.read("importance.csv", "s10_reliability"))
        self.assertAlmostEqual(shares, 1.0, delta=1e-9)
        rows = self.read("fragility.csv", "s10_reliability")
        for state in ("stability", "comfort_vertical", "comfort_lateral"):
            slow, fast = (float(row["probability"]) for row in rows if row["limit_state"] == state)
            self.assertLessEqual(slow, fast, state)
        for row in self.read("crossings.csv", "s10_reliability"):
            self.assertLessEqual(float(row["low"]), float(row["high"]))
            self.assertGreater(float(row["deviation"]), 0.0)

    def test_bad_inputs_are_refused_by_name(self):
        config = self.folder / "study/s10_reliability.toml"
        for table, word in (('name = "parametre:E"\nmean = 1.0\ndeviation = 0.1', "parametre:E"),
                            ('name = "aerodynamic_level"\nmean = 1.0\ndeviation = -0.1', "aerodynamic_level"),
                            ('name = "aerodynamic_level"\nmean = 1.0\ndeviation = 0.1\nbounded = true\nlow = 3.0\nhigh = 2.0', "low < high")):
            config.write_text(f"[[random]]\n{table}\n")
            self.assertIn(word, self.step("s10_reliability", *SMALL, status=2))
        (self.folder / "law.csv").write_text("speed_m_s,direction_deg,probability\n4,90,0.5\n8,90,0.3\n")
        for text, word in ((f'[wind_law]\nkind = "table"\nfile = "{self.folder}/law.csv"\n', "sums to 0.8"),
                           ('[wind_law]\nkind = "weibull"\nscale = 0.0\n', "scale"),
                           (f'years = [0, 90]\n[[wall]]\nsections = ["{self.section()}"]\nthickness = 0.001\ncategory = "C5"\n', "nothing is left"),
                           ('[[wall]]\nsections = ["no_section"]\nthickness = 0.01\n', "no_section"),
                           ('[[fault]]\ndamper = "C9"\n', "C9"), ("years = [10, 50]\n", "begin with 0")):
            config.write_text(text)
            self.assertIn(word, self.step("s10_reliability", *SMALL, status=2))
        config.unlink()
        self.assertIn("model", self.step("s10_reliability", "--set", 'models=["Z"]', status=2))


if __name__ == "__main__":
    unittest.main()
