"""Step 10 on a user's own straight deck of beams.

Oracles: without scatter it gives step 7's critical speed and step 8's RMS in the frequency domain; the slope of the critical speed on the
damping is what step 7 finds with the damping changed; shares of variance sum to one; probabilities rise with the wind; bad inputs are refused by name.
"""
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
        responses = {(row["channel"], row["direction"]): float(row["deviation_m_s2"]) for row in self.read("responses.csv", "s10_reliability") if float(row["speed_m_s"]) == 8.0}
        compared = 0
        for row in self.read("rms.csv"):
            if row["run"] == "normal" and float(row["spectral_rms_m_s2"]) > 1e-9:
                self.assertAlmostEqual(responses[row["channel"], row["direction"]] / float(row["spectral_rms_m_s2"]), 1.0, delta=1e-6)
                compared += 1
        self.assertGreaterEqual(compared, 2)

    def test_the_slope_on_the_damping_is_that_of_step_7(self):
        self.step("s10_reliability", *SMALL, "--set", "level_variation=0", "--set", "damper_variation=0", "--set", "turbulence_variation=0")
        spread = math.sqrt(math.log1p(0.2 ** 2))
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
            self.assertGreater(float(row["deviation_m_s2"]), 0.0)

    def test_bad_inputs_are_refused_by_name(self):
        config = self.folder / "study/s10_reliability.toml"
        for table, word in (('name = "parametre:E"\nmean = 1.0\ndeviation = 0.1', "parametre:E"),
                            ('name = "aerodynamic_level"\nmean = 1.0\ndeviation = -0.1', "aerodynamic_level"),
                            ('name = "aerodynamic_level"\nmean = 1.0\ndeviation = 0.1\nbounded = true\nlow = 3.0\nhigh = 2.0', "low < high")):
            config.write_text(f"[[random]]\n{table}\n")
            self.assertIn(word, self.step("s10_reliability", *SMALL, status=2))
        config.unlink()
        self.assertIn("model", self.step("s10_reliability", "--set", 'models=["Z"]', status=2))


if __name__ == "__main__":
    unittest.main()
