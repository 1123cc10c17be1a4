"""Figures of step 10. Oracle: tables written by hand, whose medians, bands and shares the drawn lines have to hold."""
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "paper"))

from twindeck_report.figures import figures_of, fragility, reliability_years  # noqa: E402
from twindeck_report.figures.style import plt  # noqa: E402
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


class ReliabilityFigures(unittest.TestCase):
    def setUp(self):
        folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        step = folder / "results/mine/s10_reliability"
        step.mkdir(parents=True)
        for name, text in (("fragility", FRAGILITY), ("critical", CRITICAL), ("importance", IMPORTANCE), ("years", YEARS)):
            (step / f"{name}.csv").write_text(text)
        (folder / "workflows/mine").mkdir(parents=True)
        (folder / "workflows/mine/study.toml").write_text('steps = ["s10_reliability"]\n')
        self.study = Study("mine", folder / "results/mine", folder / "data/mine", folder / "workflows/mine")

    def tearDown(self):
        plt.close("all")

    def test_a_study_with_the_step_has_both_figures(self):
        self.assertEqual({figure.NAME for figure in figures_of(self.study)}, {"fragility", "reliability_years"})

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
        self.assertEqual([label.get_text() for label in left.get_yticklabels()], ["structural damping", "rho 1"])
        self.assertEqual(list(middle.lines[0].get_ydata()), [24, 23])
        self.assertAlmostEqual(right.patches[0].get_height(), -5.0, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
