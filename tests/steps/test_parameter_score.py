"""Parameters of an updated model against the bridge of simulated records.

Oracle: a bridge of two beams and a slab whose volumes are written down here, so that means are worked out by hand.
"""
import csv
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import parameter_score  # noqa: E402

NODES = "node,x_m,y_m,z_m\n1,0,0,0\n2,3,0,0\n3,3,4,0\n4,0,4,0\n"
ELEMENTS = ("element,material,section,node1,node2,node3,node4,node5\n1,steel_a,rod,1,2,,,\n2,steel_b,rod,2,3,,,\n3,concrete,slab,1,2,3,4,\n"
            "4,rope_steel_9,rod,1,3,,,\n")
SECTIONS = "section,area_m2,thickness_m\nrod,0.5,0\nslab,0,0.25\n"
MATERIALS = "material,youngs_modulus_Pa,density_kg_m3\nsteel,1,1\nsteel_a,100,7000\nsteel_b,240,7000\nconcrete,30,2400\nrope_steel_9,999,1\n"
MODEL = "".join(f'[[parameter]]\nname = "{n}"\ntarget = "{t}"\nof = ["{of}"]\ninitial = {value}\n' for n, t, of, value in (
    ("E_s", "youngs_modulus", "steel", 200.0), ("rho", "density", "concrete", 2500.0), ("k", "spring_stiffness", "ends", 1.0), ("C", "bending_inertia_ratio", "slab", 1.0)))
UPDATED = ("parameter,unit,initial_value,final_value,lower,upper\nE_s,Pa,200,190,180,220\nrho,kg/m3,2500,2450,2450,2550\nk,-,1,1.2,0.8,1.2\nC,-,1,1.1,0.9,1.1\n")


class Score(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.truth, self.model = self.folder / "truth", self.folder / "model"
        for part, files in ((self.truth, {"nodes": NODES, "elements": ELEMENTS, "sections": SECTIONS, "materials": MATERIALS,
                                          "springs": "spring,group,stiffness_N_m\nleft,ends,30\nright,ends,10\nother,mast,5\n"}),
                            (self.model, {"springs": "spring,group,stiffness_N_m\nleft,ends,10\nright,ends,10\nother,mast,1\n"})):
            part.mkdir()
            for name, text in files.items():
                (part / f"{name}.csv").write_text(text)
        (self.model / "model.toml").write_text(MODEL)
        (self.folder / "parameters.csv").write_text(UPDATED)
        self.rows = parameter_score.score_parameters(self.truth, self.model, self.folder / "parameters.csv")

    def test_volumes(self):
        self.assertEqual(parameter_score.volumes(self.truth), {"steel_a": 1.5, "steel_b": 2.0, "concrete": 3.0, "rope_steel_9": 2.5})

    def test_the_mean_is_weighed_by_volume_over_the_zones_of_a_material(self):
        steel = self.rows[0]
        self.assertAlmostEqual(steel["true_value"], (1.5 * 100 + 2.0 * 240) / 3.5)
        self.assertEqual((steel["true_least"], steel["true_largest"], steel["true_within_bounds"]), (100.0, 240.0, 1))
        self.assertAlmostEqual(steel["error_before_pct"], 100 * (200 / 180 - 1))
        self.assertEqual(steel["closer"], 1)

    def test_density_and_springs(self):
        self.assertEqual([(r["parameter"], r["true_value"], r["true_within_bounds"], r["closer"]) for r in self.rows[1:3]], [("rho", 2400.0, 0, 1), ("k", 2.0, 0, 1)])
        self.assertEqual((self.rows[2]["true_least"], self.rows[2]["true_largest"]), (1.0, 3.0))

    def test_what_has_no_counterpart_stays_empty_and_is_said(self):
        self.assertNotIn("true_value", self.rows[3])
        self.assertEqual(parameter_score.in_words(self.rows), "3 of 3 updated parameters came closer to the bridge's own value; of rho, k that value lies beyond the "
                         "bounds; 1 have no counterpart there")
        parameter_score.write_parameters(self.rows, self.folder / "out.csv")
        with open(self.folder / "out.csv", newline="", encoding="utf-8") as stream:
            written = list(csv.DictReader(stream))
        self.assertEqual([written[3][name] for name in ("updated_value", "true_value", "closer")], ["1.1", "", ""])


if __name__ == "__main__":
    unittest.main()
