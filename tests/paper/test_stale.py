"""What no longer belongs together. Oracle: a made-up study in which one file is changed after what was made from it."""
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

import made_up_study  # noqa: E402
from made_up_case import CheckCase  # noqa: E402


class StaleSteps(CheckCase):
    def test_a_step_is_named_whose_input_changed_since_it_ran(self):
        """s8 reads s7's levels, s7 the updated model; s6 is made anew with another model, s8 is not."""
        parameters, speeds = self.results / "s6_updating/parameters.csv", self.results / "s7_aerodynamics/critical.csv"
        made_up_study.write_manifest(self.results / "s7_aerodynamics", [parameters])
        made_up_study.write_manifest(self.results / "s8_validation", [speeds])
        self.run_command("tables")
        self.assertEqual(self.run_command("verify")[::2], (0, ""))
        self.edit(speeds, "off,1.1,1,44.0", "off,1.1,1,44.1")
        made_up_study.write_manifest(self.results / "s7_aerodynamics", [parameters])
        self.run_command("tables")
        code, _, err = self.run_command("verify")
        self.assertEqual(code, 1)
        self.assertIn("s8_validation: stale: ", err)
        self.assertIn("critical.csv changed since s8_validation was made; run `make s8`", err)
        self.assertNotIn("s7_aerodynamics: stale", err)
        self.edit(parameters, "none", "None")
        made_up_study.write_manifest(self.results / "s6_updating")
        err = self.run_command("verify")[2]
        self.assertIn("parameters.csv changed since s7_aerodynamics was made; run `make s7`", err)
        self.assertIn("s8_validation: stale: ", err, "and what comes after it")

    def test_what_was_made_from_a_stale_step_is_stale_too(self):
        bridge = self.data / "bridge.toml"
        bridge.write_text("gravity = 9.81\n")
        made_up_study.write_manifest(self.results / "s1_model", [bridge])
        made_up_study.write_manifest(self.results / "s4_refinement", [self.results / "s1_model/modes.csv"])
        made_up_study.write_manifest(self.results / "s6_updating", [self.results / "s4_refinement/modes.csv"])
        self.run_command("tables")
        bridge.write_text("gravity = 8.5\n")
        err = self.run_command("verify")[2]
        self.assertIn("bridge.toml changed since s1_model was made; run `make s1`", err)
        self.assertIn("s4_refinement: stale: made from s1_model, which is stale; run `make s4`", err)
        self.assertIn("s6_updating: stale: made from s4_refinement, which is stale; run `make s6`", err)
        self.assertNotIn("s3_identification", err)

    def test_an_input_that_is_gone_is_named_too(self):
        """Oracle: a file that the manifest lists and that is deleted afterwards; put back as it was, nothing is stale."""
        masses = self.data / "masses.csv"
        masses.write_text("name,node\n")
        made_up_study.write_manifest(self.results / "s1_model", [masses])
        self.run_command("tables")
        self.assertEqual(self.run_command("verify")[::2], (0, ""))
        masses.unlink()
        code, _, err = self.run_command("verify")
        self.assertEqual(code, 1)
        self.assertIn("masses.csv removed since s1_model was made; run `make s1`", err)
        masses.write_text("name,node\n")
        self.assertEqual(self.run_command("verify")[::2], (0, ""))

    def test_folders_of_unfinished_runs_are_no_steps(self):
        (self.results / "s6_updating.partial-1").mkdir()
        (self.results / "s6_updating.unconverged").mkdir()
        self.assertEqual(self.run_command("verify")[::2], (0, ""))


class Checksums(CheckCase):
    def test_an_input_that_changed_is_named_until_it_is_listed_anew(self):
        self.assertEqual(self.run_command("checksums")[0], 0)
        self.assertEqual(self.run_command("verify")[::2], (0, ""))
        self.edit(self.data / "features/rows.csv", "no_dampers", "with_dampers")
        code, _, err = self.run_command("verify")
        self.assertEqual(code, 1)
        self.assertIn("features/rows.csv: changed: run `make checksums` if it is meant to be another", err)
        (self.data / "aero").mkdir()
        (self.data / "aero/foot_polar.csv").write_text("alpha_deg\n")
        self.assertIn("aero/foot_polar.csv: new:", self.run_command("verify")[2])
        self.run_command("checksums")
        self.assertEqual(self.run_command("verify")[0], 0)
        (self.data / "aero/foot_polar.csv").unlink()
        self.assertIn("aero/foot_polar.csv: missing, but SHA256SUMS lists it", self.run_command("verify")[2])

    def test_rules_are_no_inputs(self):
        self.run_command("checksums")
        text = (self.data.parent / "SHA256SUMS").read_text(encoding="utf-8")
        self.assertIn("  data/paper/table_02.csv\n", text)
        self.assertNotIn("tolerances.toml", text)


if __name__ == "__main__":
    unittest.main()
