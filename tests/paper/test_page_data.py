"""What the report page draws, before a browser sees it.

Oracles: shapes that were put in and must come out through oblique sensors; a mode shape and itself (MAC 1), and one at right angles to it
(MAC 0); a block of solids whose inner face nobody sees.
"""
import base64
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "paper")]

from twindeck_report.errors import InputError  # noqa: E402
from twindeck_report.page import measured, picture, poles, scripts  # noqa: E402
from twindeck_report.page.drawing import read_drawing  # noqa: E402
from twindeck_report.page.flowchart import duration, flowchart  # noqa: E402
from twindeck_report.page.heatmap import colour, heatmaps  # noqa: E402
from twindeck_report.page.places import place_of, places, where_data  # noqa: E402
from twindeck_report.page.processors import processors, reproduced  # noqa: E402
from twindeck_report.page.shapes import _models, packed  # noqa: E402
from twindeck_report.figures.flow import FlowStep  # noqa: E402
from twindeck_report.study import Study  # noqa: E402


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


class Drawings(unittest.TestCase):
    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.study = Study("made_up", self.root, self.root / "data", self.root / "workflow")

    def model(self, elements):
        corners = [(x, y, z) for z in (0, 1, 2) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        write(
            self.root / "model/nodes.csv",
            "node,x_m,y_m,z_m\n" + "".join(f"{i},{x},{y},{z}\n" for i, (x, y, z) in enumerate(corners, 1)) + "99,9,9,9\n",
        )
        header = "element,type,name,group,material,section," + ",".join(f"node{i}" for i in range(1, 9))
        write(self.root / "model/elements.csv", header + "\n" + "\n".join(elements) + "\n")
        return read_drawing(self.study, "model")

    def test_the_first_picture_leaves_approaches_out_unless_a_cause_lies_there(self):
        """A girder and, behind it, a ramp to a far node: its end is not drawn, its beginning belongs to the girder."""
        drawing = self.model(["1,beam,,girder,steel,,1,2,,,,,,", "2,beam,,ramp,steel,,2,99,,,,,,"])
        cause = {"spots": [], "nodes": []}
        self.assertEqual(drawing.approach.tolist(), [False, False, True])
        self.assertEqual(picture._without_approaches(drawing, [cause]).tolist(), [True, True, False])
        for there in ({"nodes": [2]}, {"spots": [[9.0, 9.0, 9.0]]}):
            self.assertTrue(picture._without_approaches(drawing, [cause | there]).all())
        ramp = self.model(["1,beam,,ramp,steel,,1,2,,,,,,"])
        self.assertTrue(picture._without_approaches(ramp, []).all(), "a model of a ramp")

    def test_two_solids_show_ten_faces(self):
        """Two cubes, one on the other: 12 faces less the two that touch; 10 squares are 20 triangles; the edges of the seam are drawn
        once as edges of neighbours, hence not free."""
        drawing = self.model(["1,solid,,block,concrete,,1,2,3,4,5,6,7,8", "2,solid,,block,concrete,,5,6,7,8,9,10,11,12"])
        self.assertEqual(len(drawing.faces), 20)
        self.assertEqual(len(drawing.ids), 12, "the node that no element touches is left out")
        area = (
            0.5
            * np.linalg.norm(
                np.cross(
                    drawing.points[drawing.faces[:, 1]] - drawing.points[drawing.faces[:, 0]],
                    drawing.points[drawing.faces[:, 2]] - drawing.points[drawing.faces[:, 0]],
                ),
                axis=1,
            ).sum()
        )
        self.assertAlmostEqual(area, 10.0)
        self.assertEqual(sorted(drawing.groups["concrete"]), list(range(12)))

    def test_shells_show_their_free_edges_and_members_their_line(self):
        """Two squares that share an edge have six free edges; a stay from node 1 to node 12 is a line of its own, with its name."""
        drawing = self.model(
            ["1,shell,,slab,concrete,,1,2,6,5,,,,", "2,shell,,slab,concrete,,2,3,7,6,,,,", "3,stay,NE1,stays,steel,,1,12,,,,,,"]
        )
        self.assertEqual((len(drawing.faces), len(drawing.lines)), (4, 7))
        self.assertEqual({drawing.ids[i] for i in drawing.names["NE1"]}, {"1", "12"})

    def test_the_model_before_updating_is_shown_where_the_designed_one_has_other_nodes(self):
        steps = ("s1_model", "s4_refinement", "s6_updating")
        write(self.root / "workflow/study.toml", f"steps = {list(steps)}\n")
        for token, x in zip(steps, (0, 1, 1)):
            write(self.root / token / "model/nodes.csv", f"node,x_m,y_m,z_m\n1,{x},0,0\n")
            write(self.root / token / "shapes.csv", "mode,point,direction,value\n")
        self.assertEqual([title for _, title in _models(self.study)], ["Updated model", "Model before updating", "Model as designed"])
        write(self.root / "s1_model/model/nodes.csv", "node,x_m,y_m,z_m\n1,1,0,0\n")
        study = Study("made_up", self.root, self.root / "data", self.root / "workflow")
        self.assertEqual([title for _, title in _models(study)], ["Updated model", "Model as designed"])

    def test_a_group_of_dampers_or_stays_has_its_places(self):
        self.model(["1,beam,NE1,,steel,,1,5", "2,beam,SE1,,steel,,2,6"])
        write(self.root / "model/springs.csv", "spring,group,node,node2\nC1,damper_C,5,\nC2,damper_C,6,\n")
        write(self.root / "model/model.toml", 'title = "made up"\n')
        effect = {"cause": "barstays", "location": "global", "parameters": [{"name": f"force_{s}_N"} for s in ("NE1", "SE1")]}
        where, words = place_of(effect)
        self.assertEqual(words, "the stays NE1 and SE1")
        dampers, stays = places(self.study, {}, "model", [{"location": "dampers:C1,C2", "score": 2.0}, {"location": where, "score": 1.0}])
        self.assertEqual(dampers["spots"], [[0, 0, 1], [1, 0, 1]])
        self.assertEqual((stays["spots"], len(stays["nodes"])), ([[0, 0, 0.5], [1, 0, 0.5]], 4))

    def test_a_triangle_beside_a_square_shares_its_edge(self):
        """A square and a triangle on one of its sides: three faces, five free edges."""
        drawing = self.model(["1,shell,,slab,concrete,,1,2,6,5,,,,", "2,shell,,slab,concrete,,2,3,6,,,,,"])
        self.assertEqual((len(drawing.faces), len(drawing.lines)), (3, 5))

    def test_an_unknown_node_is_named(self):
        with self.assertRaisesRegex(InputError, "elements.csv: node 77 is not in nodes.csv"):
            self.model(["1,beam,,b,steel,,1,77,,,,,,"])

    def test_matrices_have_nothing_to_draw(self):
        self.assertIsNone(read_drawing(self.study, "model"))


class Measured(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(3)
        self.positions = np.array([[0.0, 0, 0], [10.0, 0, 0], [20.0, 1, 0]])
        self.truth = random.normal(size=(2, 3, 3)) + 1j * random.normal(size=(2, 3, 3))
        axes = random.normal(size=(9, 3))
        axes /= np.linalg.norm(axes, axis=1)[:, None]
        rows = [[f"c{i}", f"P{i // 3}", *self.positions[i // 3], *axes[i]] for i in range(9)]
        self.channels = pd.DataFrame(rows, columns=["channel", "point", "x_m", "y_m", "z_m", "dx", "dy", "dz"])
        self.axes = axes

    def assembled(self, shapes):
        table = pd.DataFrame(
            [
                {"mode": m + 1, "channel": f"c{i}", "value": self.axes[i] @ shapes[m, i // 3]}
                for m in range(len(shapes))
                for i in range(9)
            ]
        )
        return measured._assembled(
            self.channels, table, [(str(m + 1), 1.0 + m, None) for m in range(len(shapes))], [["P0", "P1"], ["P1", "gone"]]
        )

    def test_oblique_sensors_give_the_vectors_back(self):
        found = self.assembled(self.truth)
        for shape, truth in zip(found.shapes, self.truth):
            np.testing.assert_allclose(shape, truth / np.abs(truth).max(), atol=1e-12)
        self.assertEqual(found.lines, [(0, 1)], "a line to a point without sensors is left out")

    def test_a_missing_channel_moves_nothing_along_itself(self):
        """Two of three axes at P0: the vector lies in their plane and meets both readings."""
        table = pd.DataFrame(
            [{"mode": 1, "channel": f"c{i}", "value": self.axes[i] @ self.truth[0, i // 3]} for i in range(1, 9)]
        )
        found = measured._assembled(self.channels, table, [("1", 1.0, None)], [])
        full = found.shapes[0]
        scale = (self.axes[4] @ full[1]) / (self.axes[4] @ self.truth[0, 1])
        for i in (1, 2):
            self.assertAlmostEqual(self.axes[i] @ full[0], scale * (self.axes[i] @ self.truth[0, 0]))

    def test_the_partner_is_the_mode_of_highest_mac(self):
        real = self.truth.real
        first, second = real[0], real[1]
        projected = np.array([[self.axes[i] @ s[i // 3] for i in range(9)] for s in (first, second)])
        # the second, less what it has of the first at the sensors: MAC 0 with the first
        other = second - first * (projected[0] @ projected[1]) / (projected[0] @ projected[0])
        found = self.assembled(np.array([3.0 * first, other]).astype(complex))
        pairs = measured.partners(found, self.positions, [other, -2.0 * first])
        self.assertEqual([p[0] for p in pairs], [1, 0])
        np.testing.assert_allclose([p[1] for p in pairs], 1.0, atol=1e-12)
        np.testing.assert_allclose(
            pairs[0][2] * -2.0 * first, found.shapes[0].real, atol=1e-12, err_msg="the factor puts one onto the other"
        )
        self.assertLess(measured.partners(found, self.positions, [other])[0][1], 1e-12)

    def features(self, rows):
        root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        write(root / "features/rows.csv", "type,mode,channel,condition,value,std\n" + rows)
        write(root / "features/channels.csv", "channel,point,x_m,y_m,z_m,dx,dy,dz\nNA,NA,0,0,0,0,0,1\nB,B,1,0,0,0,0,1\n")
        write(root / "workflow/study.toml", "steps = [\"s4_refinement\"]\n")
        found = measured.read_measured(Study("made_up", root, root / "data", root / "workflow"), {"features": root / "features"})
        return found.modes, found.values

    def test_a_mode_of_two_conditions_is_that_of_the_first(self):
        """Frequency, damping and shape belong together; the second condition's, which stand further down, are another state."""
        rows = "".join(f"frequency_Hz,1,,{c},{f},0.1\ndamping_ratio_pct,1,,{c},{z},0.1\n" + "".join(
            f"shape,1,{n},{c},{v},0.1\nshape_imag,1,{n},{c},{w},0.1\n" for n, v, w in shape)
            for c, f, z, shape in (("calm", 2.0, 1.0, (("NA", 1.0, 0.1), ("B", 0.5, 0.2))), ("storm", 3.0, 4.0, (("NA", -1.0, 0.3), ("B", 1.0, 0.4)))))
        modes, values = self.features(rows)
        self.assertEqual(modes, [("1", 2.0, 1.0)])
        np.testing.assert_allclose(values, [[1.0 + 0.1j, 0.5 + 0.2j]])

    def test_a_mode_may_have_a_name_and_rows_without_a_mode_stand_beside(self):
        """The contract of rows.csv: a whole number or a name; a row of temperature has none."""
        self.assertEqual(self.features("frequency_Hz,sway,,calm,2,0.1\nshape,sway,NA,calm,1,0.1\nshape,sway,B,calm,1,0.1\n")[0][0][:2], ("sway", 2.0))
        self.assertEqual(self.features("temperature_C,,,calm,12,1\nfrequency_Hz,3,,calm,2,0.1\nshape,3,NA,calm,1,0.1\nshape,3,B,calm,1,0.1\n")[0][0][:2], ("3", 2.0))

    def test_sensors_off_the_model_have_no_partner(self):
        found = self.assembled(self.truth)
        self.assertEqual(measured.partners(found, self.positions + [0, 5.0, 0], [np.ones((3, 3))]), [])


class Pieces(unittest.TestCase):
    def test_packed_numbers_come_back(self):
        values = np.array([[1.5, -2.0], [0.25, 1e6]])
        np.testing.assert_array_equal(np.frombuffer(base64.b64decode(packed(values, "f4")), "<f4").reshape(2, 2), values)

    def test_embedded_text_cannot_end_its_script(self):
        self.assertNotIn("</", scripts.embedded({"name": "</script><b>"}))

    def test_colours_of_residuals(self):
        self.assertEqual(colour(0.0), "#f8f8f8")
        self.assertEqual((colour(50.0), colour(-50.0)), ("#b3261e", "#0b5fa5"))
        rows = pd.DataFrame(
            {
                "type": "frequency_Hz",
                "mode": [1, 2],
                "channel": [np.nan, np.nan],
                "condition": "still",
                "held_out": [0, 1],
                "residual_before": [4.0, -1.0],
                "residual_after": [0.5, -1.0],
            }
        )
        (found,) = heatmaps(rows, True)
        self.assertEqual(found["title"], "Frequencies, still: 2 rows")
        for part in ("mode 1, before: +4.00 standard deviations<", "mode 2, after: -1.00 standard deviations, held out<"):
            self.assertIn(part, found["svg"])
        self.assertNotIn("after", heatmaps(rows, False)[0]["svg"])

    def test_residuals_of_named_modes_and_of_rows_without_a_mode(self):
        """A mode may have a name; rows of a load test have none and are told by their sensor."""
        rows = pd.DataFrame({"type": ["frequency_Hz", "frequency_Hz", "static_m"], "mode": ["sway", "2", np.nan], "channel": [np.nan, np.nan, "D1"],
                             "condition": "still", "held_out": 0, "residual_before": [4.0, 1.0, -2.0], "residual_after": 0.0})
        frequencies, deflection = heatmaps(rows, False)
        for part in ("mode sway, before: +4.00", "mode 2, before: +1.00"):
            self.assertIn(part, frequencies["svg"])
        self.assertIn(">D1, before: -2.00", deflection["svg"])
        self.assertNotIn("mode", deflection["svg"])
        own = rows[:2].assign(mode=["still 5", "2"])
        self.assertIn(">own mode 5</text>", heatmaps(own, False)[0]["svg"], "the title tells the condition")
        numbers = rows[1:].assign(mode=[2.0, np.nan])  # as pandas reads a column of numbers with an empty cell
        self.assertIn("mode 2, before: +1.00", heatmaps(numbers, False)[0]["svg"])

    def test_scores_lie_on_their_parts(self):
        found = [
            {"location": "group:E", "score": 4.0, "spots": [], "nodes": [0, 1]},
            {"location": "node:7", "score": 2.0, "spots": [[1.0, 2.0, 3.0]], "nodes": []},
            {"location": "element:3", "score": 1.0, "spots": [], "nodes": [1, 2]},
        ]
        data = where_data(found, 4)
        np.testing.assert_allclose(np.frombuffer(base64.b64decode(data["score"]), "<f4"), [1.0, 1.0, 0.25, 0.0])
        self.assertEqual(data["spots"], [{"name": "node:7", "score": 2.0, "at": [1.0, 2.0, 3.0]}])

    def test_steps_stand_right_of_what_they_read(self):
        def step(token, reads, status="converged", seconds=1.0):
            return FlowStep(token, "does\nthis", "", reads, status, seconds, "", "")

        drawn = flowchart(
            [
                step("s1_model", ()),
                step("s4_refinement", ("s1_model",), seconds=125.0),
                step("s6_updating", ("s4_refinement", "s1_model"), "not run", None),
            ]
        )
        self.assertEqual(drawn.count('class="arrow"'), 3)
        places = [int(part.split('"')[0]) for part in drawn.split('<rect x="')[1:]]
        self.assertEqual(places, sorted(places))
        for part in ("2 min 05 s", "not run", 'class="box idle"'):
            self.assertIn(part, drawn)
        self.assertEqual(duration(None), "")

    def test_peaks_survive_thinning(self):
        n = 5 * poles.MOST_SPECTRUM
        table = pd.DataFrame({"setup": "A", "frequency_Hz": np.arange(n) / n, "sv1": 1.0})
        table.loc[1234, "sv1"] = 9.0
        kept = poles._spectrum(table, "A", 0.0, 1.0)
        self.assertLessEqual(len(kept), poles.MOST_SPECTRUM)
        self.assertIn([round(1234 / n, 4), 9.0], kept)



class MadeAnew(unittest.TestCase):
    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.study = Study("made_up", self.root / "results/made_up", self.root / "data", self.root / "workflow")

    def test_what_was_not_run_is_not_told(self):
        self.assertEqual(processors(self.study), [])
        self.assertEqual(reproduced(self.study), {})

    def test_a_file_that_differs_and_a_column_that_moves_are_told(self):
        write(self.root / "results/reproduce/files.csv",
              "file,same,why\ns4/modes.csv,yes,\ns4/pairs.csv,no,\nreport/report.html,no,shows the time of the run\n")
        write(self.root / "results/reproduce/columns.csv",
              "build,file,column,relative_change,where\nclang,s4/modes.csv,frequency_Hz,1e-12,row 1\nclang,s6/starts.csv,value,2e-3,row 4\n"
              "clang,s6/starts.csv,name,inf,row 2: a / b\n")
        told = reproduced(self.study)
        self.assertEqual((told["files"], told["time"], told["different"]), (3, 1, ["s4/pairs.csv"]))
        self.assertEqual(told["builds"], [{"name": "clang", "moved": 3, "large": [
            {"column": "s6/starts.csv name", "change": "text differs", "where": "row 2: a / b"},
            {"column": "s6/starts.csv value", "change": "2.0e-03", "where": "row 4"}]}])


if __name__ == "__main__":
    unittest.main()
