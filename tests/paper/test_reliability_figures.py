"""Figures of step 10. Oracle: tables written by hand, whose medians, bands and shares the drawn lines have to hold."""
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "paper"))

from twindeck_report.figures import figures_of, fragility, reliability_years, visible_loss  # noqa: E402
from twindeck_report.figures.style import plt  # noqa: E402
from twindeck_report.page.reliability import reliability  # noqa: E402
from twindeck_report.study import Study  # noqa: E402

FRAGILITY = """limit_state,model,years,dampers,fault,speed_m_s,probability,low,high
stability,A,0,off,,10,0,0,0
comfort_vertical,A,0,off,,10,0.2,0.1,0.4
comfort_vertical,A,0,off,,20,0.8,0.6,0.9
comfort_vertical,A,50,off,,20,0.9,0.7,1
comfort_vertical,A,0,on,C1 held,20,0.5,0.4,0.6
"""
CRITICAL = """model,years,dampers,fault,speed_m_s,low_m_s,high_m_s,deviation_pct
A,0,off,,24,22,26,5
A,50,off,,23,21,25,5
A,0,on,C1 held,,,,
"""
IMPORTANCE = """model,years,dampers,fault,input,slope_per_deviation_pct,importance
A,0,off,,structural_damping,3,0.9
A,0,off,,parameter:rho_1,1,0.1
A,0,off,,turbulence_intensity,0,0
"""
YEARS = """years,dampers,fault,quantity,place,value,low,high,unit
0,off,,critical_speed,model A,24,22,26,m/s
50,off,,critical_speed,model A,23,21,25,m/s
0,off,,frequency,mode 1,2.0,1.9,2.1,Hz
50,off,,frequency,mode 1,1.9,1.8,2.0,Hz
"""
VISIBLE = """wall,section,wall_thickness_m,smallest_loss_m,share_pct,years,located_loss_m,distance,mode,change_pct
1,edge,0.01,0.0005,5,30,0.002,3.29,1X,-0.5
2,mast,0.02,,,,,1.1,1X,-0.1
"""
NODES = "node,x_m,y_m,z_m\n1,0,0,0\n2,10,0,0\n3,5,4,0\n4,5,4,9\n"
ELEMENTS = "element,group,section,node1,node2,node3,node4\n1,deck_edge,edge,1,2,,\n2,mast,mast,3,4,,\n"


class ReliabilityFigures(unittest.TestCase):
    def setUp(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        step = folder / "results/mine/s10_reliability"
        step.mkdir(parents=True)
        for name, text in (("fragility", FRAGILITY), ("critical", CRITICAL), ("importance", IMPORTANCE), ("years", YEARS)):
            (step / f"{name}.csv").write_text(text)
        self.step = step
        (folder / "workflows/mine").mkdir(parents=True)
        (folder / "workflows/mine/study.toml").write_text('steps = ["s10_reliability"]\n')
        self.study = Study("mine", folder / "results/mine", folder / "data/mine", folder / "workflows/mine")

    def tearDown(self):
        plt.close("all")

    def walls(self):
        (self.step / "visible.csv").write_text(VISIBLE)
        model = self.step.parent / "s6_updating/model"
        model.mkdir(parents=True)
        (model / "nodes.csv").write_text(NODES)
        (model / "elements.csv").write_text(ELEMENTS)

    def test_a_study_with_the_step_has_both_figures_and_with_walls_the_third(self):
        self.assertEqual({figure.NAME for figure in figures_of(self.study)}, {"fragility", "reliability_years"})
        self.walls()
        self.assertEqual({figure.NAME for figure in figures_of(self.study)}, {"fragility", "reliability_years", "visible_loss"})

    def test_visible_loss_holds_bars_in_mm_and_colours_members(self):
        self.walls()
        figure, _ = visible_loss.draw(self.study)
        plan, bars = figure.axes[:2]
        self.assertEqual([round(bar.get_width(), 9) for bar in bars.patches], [0.5, 2.0, 20.0])  # seen, located, not seen
        self.assertEqual([text.get_text() for text in bars.texts], ["year 30", "not seen"])
        edge, mast, upright = plan.lines[1:]
        self.assertEqual(list(edge.get_xdata()[:2]), [0, 10])
        self.assertEqual(edge.get_color(), visible_loss.COLOURS(1.0))
        self.assertEqual((mast.get_color(), list(upright.get_xydata()[0])), (visible_loss.UNSEEN, [5, 4]))

    def test_the_page_answers_its_question_first(self):
        self.walls()
        told = reliability(self.study)
        self.assertIn("after 50 years?", told["question"])
        self.assertEqual(told["winds"]["head"], ["vertical comfort", "instability (5 to 95 %)"])
        self.assertEqual(told["winds"]["rows"], [("without dampers, year 0", ["15.0 m/s", "24.0 m/s (22.0 to 26.0)"]),  # half way from 0.2 at 10 to 0.8 at 20 m/s
                                                 ("without dampers, year 50", ["below 20 m/s", "23.0 m/s (21.0 to 25.0)"]),
                                                 ("with dampers, C1 held, year 0", ["below 20 m/s", "none found"])])
        [visible] = told["answers"]
        self.assertIn("edge: from a loss of 0.50 mm (5 % of the wall) on, in year 30", visible)
        self.assertIn("1 of 2 walls", visible)
        self.assertEqual([table["title"] for table in told["tables"]][-1], "What monitoring would see")
        (self.study.workflow / "study.toml").write_text('steps = ["s1_model"]\n')
        self.assertIsNone(reliability(self.study))

    def test_the_wall_seen_first_is_the_one_of_the_least_years(self):
        """A wall of 5 % in year 30 beside one of 8 % in year 12."""
        self.walls()
        (self.step / "visible.csv").write_text(VISIBLE + "3,foot_rail,0.01,0.0008,8,12,0.002,3.29,1X,-0.5\n3,rail,0.01,0.0008,8,12,0.002,3.29,1X,-0.5\n")
        [visible] = reliability(self.study)["answers"]
        self.assertIn("first see the corrosion of foot rail and 1 more: from a loss of 0.80 mm (8 % of the wall) on, in year 12", visible)

    def test_fragility_holds_probabilities_bands_and_the_median_of_the_critical_speed(self):
        figure, data = fragility.draw(self.study)
        vertical, _, instability = figure.axes
        self.assertEqual([list(line.get_ydata()) for line in vertical.lines], [[0.2, 0.8], [0.9], [0.5]])
        low = vertical.collections[0].get_paths()[0].vertices
        self.assertEqual({(10.0, 0.1), (20.0, 0.6), (10.0, 0.4), (20.0, 0.9)} - {tuple(p) for p in low}, set())
        curves = [line for line in instability.lines if len(line.get_xdata()) > 2]
        for curve, median in zip(curves, (24.0, 23.0)):
            self.assertAlmostEqual(float(np.interp(median, curve.get_xdata(), curve.get_ydata())), 0.5, delta=0.01)
        self.assertIn("C1 held", instability.texts[0].get_text())
        self.assertEqual(len(data), 5)

    def test_years_hold_shares_speeds_and_changes(self):
        figure, _ = reliability_years.draw(self.study)
        left, middle, right = figure.axes
        self.assertEqual(sorted(round(bar.get_width(), 9) for bar in left.patches), [0.1, 0.9])
        self.assertEqual([label.get_text() for label in left.get_yticklabels()], ["structural damping", "$\\rho_{\\mathrm{1}}$"])
        self.assertEqual(list(middle.lines[0].get_ydata()), [24, 23])
        self.assertAlmostEqual(right.patches[0].get_height(), -5.0, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
