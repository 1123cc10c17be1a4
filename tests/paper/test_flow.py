"""Which step has read which, and whose file is read. Oracle: manifests and folders made here."""
import json
import os
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "paper"))

from twindeck_report.errors import InputError  # noqa: E402
from twindeck_report.figures import fig_01  # noqa: E402
from twindeck_report.figures.flow import flow  # noqa: E402
from twindeck_report.figures.style import plt  # noqa: E402
from twindeck_report.study import Study  # noqa: E402


class WithACampaign(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.make("mine", ["s1_model", "s8_validation"])
        self.make("mine_virtual", ["s0_campaign", "s1_model", "s3_identification", "s8_validation"])
        self.ran("mine", "s1_model")
        self.ran("mine", "s8_validation", "data/a.csv", "results/mine/s1_model/model/nodes.csv", "results/mine_virtual/s0_campaign/records/x.npy")
        self.ran("mine_virtual", "s3_identification", "results/mine_virtual/s0_campaign/campaign.toml")
        self.study = Study("mine", Path("results/mine"), Path("data/mine"), Path("workflows/mine"))

    def make(self, name, steps):
        Path("workflows", name).mkdir(parents=True)
        Path("workflows", name, "study.toml").write_text(f"steps = {json.dumps(steps)}\n", encoding="utf-8")

    def ran(self, name, step, *inputs):
        folder = Path("results", name, step)
        folder.mkdir(parents=True)
        (folder / "table.csv").write_text(f"value\n{name}\n", encoding="utf-8")
        (folder / "manifest.json").write_text(json.dumps({"status": "converged", "seconds": 1.0, "inputs": dict.fromkeys(inputs, ""), "outputs": {}}))

    def test_arrows_are_what_manifests_list(self):
        found = {step.token: step for step in flow(self.study)}
        self.assertEqual((found["s8_validation"].reads, found["s8_validation"].elsewhere), (("s1_model",), (("mine_virtual", "s0_campaign"),)))
        self.assertEqual((found["s1_model"].reads, found["s1_model"].paper_step), ((), "1"))
        virtual = {step.token: step for step in flow(self.study.virtual())}
        self.assertEqual(virtual["s3_identification"].reads, ("s0_campaign",))
        self.assertEqual((virtual["s8_validation"].status, virtual["s8_validation"].reads), ("not run", ()))

    def test_the_figure_has_both_studies(self):
        figure, data = fig_01.draw(self.study)
        plt.close(figure)
        self.assertEqual(list(data["study"]), ["mine_virtual"] * 4 + ["mine"] * 2)
        self.assertEqual(list(data["reads_elsewhere"])[-1], "mine_virtual/s0_campaign")

    def test_a_step_that_only_the_campaign_has_is_read_there(self):
        self.assertEqual(self.study.step_csv("s3_identification/table.csv")["value"][0], "mine_virtual")
        self.assertEqual(self.study.step_csv("s8_validation/table.csv")["value"][0], "mine", "both have it: a study's own comes first")
        self.assertTrue(self.study.has("s3_identification"))
        self.assertFalse(self.study.has("s9_diagnosis"))
        self.assertIn(Path("results/mine_virtual/s3_identification/table.csv"), self.study.used, "it is an input of what is made")
        with self.assertRaisesRegex(InputError, r"results/mine_virtual/s0_campaign/gone.csv: missing; run `make s0 STUDY=mine_virtual` first"):
            self.study.step_csv("s0_campaign/gone.csv")

    def test_a_study_without_one_is_its_own_campaign(self):
        virtual = self.study.virtual()
        self.assertIs(virtual.campaign(), virtual)


if __name__ == "__main__":
    unittest.main()
