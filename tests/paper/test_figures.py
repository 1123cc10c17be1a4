"""What figures draw is what the model holds. Oracle: arcs, forces, dampers and shapes of a made-up study (made_up_bridge.py), known by
construction, and orthogonality of sines on a uniform grid."""
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

import made_up_answer  # noqa: E402
import made_up_bridge  # noqa: E402
import made_up_study  # noqa: E402
from twindeck_report.campaign_mac import mac_table  # noqa: E402
from twindeck_report.deck_section import chord_forces, circle_through, mean_forces, sections  # noqa: E402
from twindeck_report.errors import InputError  # noqa: E402
from twindeck_report.figures import diagnosis, fig_01, fig_02, fig_03  # noqa: E402
from twindeck_report.figures.mesh import read_mesh  # noqa: E402
from twindeck_report.figures.stabilisation import apart  # noqa: E402
from twindeck_report.figures.style import plt  # noqa: E402
from twindeck_report.figures.writer import write_figure  # noqa: E402
from twindeck_report.study import Study  # noqa: E402


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        data, workflow, results = made_up_study.make_study(cls.folder.name)
        cls.study = Study("made_up", results, data, workflow)

    def tearDown(self):
        plt.close("all")

    def test_circle_through_an_arc(self):
        angle = np.linspace(-0.5, 0.5, 7)
        found = circle_through(pd.DataFrame({"x_m": 3 + 80 * np.sin(angle), "y_m": -20 + 80 * np.cos(angle)}))
        np.testing.assert_allclose([found.x_m, found.y_m, found.radius_m], [3, -20, 80], rtol=1e-9)

    def test_chords_are_told_apart_and_keep_their_force(self):
        forces = chord_forces(self.study)
        self.assertEqual(len(forces), 2 * 3 * made_up_bridge.PIECES)
        mean = mean_forces(forces)
        for (deck, level), force in made_up_bridge.FORCES.items():
            for chord in ("bottom",) if level == "bottom" else ("top inner", "top outer"):
                self.assertAlmostEqual(mean.at[deck, chord], force, delta=1e-6)
        reach = forces[(forces["deck"] == "foot")]["station_m"].abs().max()
        self.assertAlmostEqual(reach, 80.0 * made_up_bridge.REACH * (1 - 1.0 / made_up_bridge.PIECES), delta=1e-6)

    def test_section_of_a_deck(self):
        places = sections(self.study)["foot"]
        for chord, place in {"top inner": (-2, 0), "top outer": (2, 0), "bottom": (0, -1.5)}.items():
            np.testing.assert_allclose(places[chord], place, atol=1e-6)

    def test_figure_2_says_where_the_paper_differs(self):
        """The made-up foot deck's bottom chord is compressed, the paper's pulled."""
        figure, data = fig_02.draw(self.study)
        titles = [axes.get_title(loc="left") for axes in figure.axes if axes.get_title(loc="left")]
        self.assertEqual(titles, ["foot deck, bottom: compression (tension in section 2.1)", "cycle deck, bottom: tension (compression in section 2.1)"])
        self.assertEqual(set(data["deck"]), {"foot", "cycle"})

    def test_figure_3_draws_every_damper_where_the_model_has_it(self):
        _, data = fig_03.draw(self.study)
        self.assertEqual(list(data["damper"]), ["A1", "A2", "B1", "B2", "C1", "C2", "C3", "C4"])
        self.assertEqual(data[data["dz"] == 0]["damper"].tolist(), ["A1", "A2"], "the bearing is no damper, and A acts across")
        self.assertEqual(data.iloc[1][["x_m", "y_m", "z_m"]].tolist(), [15.0, 0.0, 10.0], "node 7 of the strip")

    def test_a_drawing_leaves_the_approaches_out(self):
        folder = self.study.results / "s1_model/with_ramp"
        made_up_study.write_rows(folder / "nodes.csv", ["node", "x_m", "y_m", "z_m"], [[1, 0, 0, 0], [2, 1, 0, 0], [3, 500, 0, 0]])
        made_up_study.write_rows(folder / "elements.csv", ["element", "group", "node1", "node2", "node3", "node4"],
                                 [[1, "foot_top_chord", 1, 2, "", ""], [2, "ramp", 2, 3, "", ""]])
        mesh = read_mesh(self.study, "s1_model/with_ramp")
        self.assertEqual((mesh.ids.tolist(), mesh.lines.tolist(), mesh.groups.tolist()), ([1, 2], [[0, 1]], ["foot_top_chord"]))
        self.assertEqual(mesh.extent("chord")[1].tolist(), [1, 0, 0])

    def test_one_figure_needs_its_own_steps_only(self):
        with tempfile.TemporaryDirectory() as fresh:
            study = Study("made_up", Path(fresh), self.study.data, self.study.workflow)
            (study.results / "s1_model").symlink_to(self.study.results / "s1_model")
            picture = write_figure(study, "fig_05")
            self.assertGreater(picture.stat().st_size, 10_000)
            self.assertFalse((study.results / "figures").exists(), "the figures that belong together are left alone")
            with self.assertRaisesRegex(InputError, "no figure fig_99; it has fig_01"):
                write_figure(study, "fig_99")

    def test_the_diagnosis_names_places_apart_and_without_keys(self):
        folder = self.study.results / "s9_diagnosis"
        at = [{"location": f"damper:C{i}", "score": 9.0 - i, "words": f"the damper C{i} at x = -59 m, y = 14 m, z = 12 m"} for i in range(1, 15)]
        made_up_answer.write_diagnosis(folder, made_up_answer.diagnosis(localisation=at))
        figure, data = diagnosis.draw(self.study)
        figure.canvas.draw()
        for axes in figure.axes:
            boxes = sorted((t.get_window_extent() for t in axes.get_yticklabels() if t.get_text()), key=lambda box: box.y0)
            self.assertTrue(all(below.y1 <= above.y0 for below, above in zip(boxes, boxes[1:])))
            self.assertTrue(all(box.x0 >= 0 for box in boxes), "none is cut")
        self.assertEqual(figure.axes[1].get_yticklabels()[0].get_text(), "the damper C1\nat x = -59 m, y = 14 m, z = 12 m")
        self.assertEqual(figure.axes[0].get_yticklabels()[0].get_text(), "Frequencies (2)\nwindy")
        self.assertEqual([t.get_text() for t in figure.axes[0].texts], ["1"], "3.4 standard deviations")
        self.assertEqual(len(data), 2)

    def test_step_10_stands_below_step_9(self):
        self.assertEqual(sorted(["s10_reliability", "s1_model", "s9_diagnosis"], key=fig_01._number), ["s1_model", "s9_diagnosis", "s10_reliability"])

    def test_names_do_not_meet(self):
        places = [1.0, 1.01, 1.02, 2.0]
        moved = apart(places, 0.1, (0.0, 3.0))
        self.assertTrue(all(b - a >= 0.1 - 1e-12 for a, b in zip(moved, moved[1:])))
        np.testing.assert_allclose(moved, [0.91, 1.01, 1.11, 2.0])

    def test_mac_with_the_campaign(self):
        """Identified: the model's own second half wave, at the campaign's eight channels, for the first row; over points that are spread
        evenly over a span, half waves of different order are orthogonal."""
        folder = self.study.results / "s3_identification"
        made_up_study.write_rows(folder / "features/channels.csv", ["channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz"],
                                 [[f"P{i}z", f"P{i}", 5.0 * i, 0, 10.0, 0, 0, 1] for i in range(1, 20)] + [["far", "far", 10, 40, 10, 0, 0, 1]])
        made_up_study.write_rows(folder / "shapes.csv", ["mode", "point", "direction", "value", "value_imag"],
                                 [[m, f"P{i}", f"P{i}z", np.sin(2 * m * np.pi * i / 20), 0] for m in range(1, 11) for i in range(1, 20)]
                                 + [[m, "far", "far", 50.0, 0] for m in range(1, 11)])
        found = mac_table(self.study, "s6_updating", ["1N", "2N", "4N"], ["1X", "2X", "11X"])
        np.testing.assert_allclose(found[["1X", "2X"]], [[0, 0], [1, 0], [0, 1]], atol=1e-12)
        self.assertTrue(found["11X"].isna().all(), "no such row of Table 4")
        with self.assertRaisesRegex(InputError, "no mode 99N"):
            mac_table(self.study, "s6_updating", ["99N"], ["1X"])


if __name__ == "__main__":
    unittest.main()
