"""Step 7 on a user's own straight deck of beams, no study.

Oracles: the cosine rule on a straight deck, V_cr = V_A/cos theta, exact; the closed form of galloping by a constant h1* in a mode
whose shape and modal mass follow from the model's own modes; files that are not as they should be are refused by their names.
"""
import csv
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))
NAMES = [g + str(i) for g in "hpa" for i in range(1, 7)]
LENGTH, PANELS, WIDTH, CHORD, XI, H1 = 60.0, 24, 3.0, 4.0, 0.005, -3.0
EXCEPTIONS = '["quasi_steady: all derivatives but h1 are zero"]'


def write_model(folder):
    """Two edge beams, floor beams between them, held at both ends against everything but rotation about the supports' line."""
    folder.mkdir()
    (folder / "model.toml").write_text('title = "straight deck"\ngravity = 9.81\n')
    nodes, elements = [], []
    for i in range(PANELS + 1):
        x = LENGTH * i / PANELS
        nodes += [f"{2 * i + 1},{x},{-WIDTH / 2},10", f"{2 * i + 2},{x},{WIDTH / 2},10"]
        elements.append(("floor", 2 * i + 1, 2 * i + 2))
        if i < PANELS:
            elements += [("edge", 2 * i + 1, 2 * i + 3), ("edge", 2 * i + 2, 2 * i + 4)]
    (folder / "nodes.csv").write_text("node,x_m,y_m,z_m\n" + "\n".join(nodes) + "\n")
    (folder / "elements.csv").write_text(
        "element,type,group,material,section,node1,node2\n" +
        "".join(f"{n},beam,deck_{g},steel,{g},{a},{b}\n" for n, (g, a, b) in enumerate(elements, 1)))
    (folder / "materials.csv").write_text("material,youngs_modulus_Pa,poisson_ratio,density_kg_m3\nsteel,2.1e11,0.3,7850\n")
    (folder / "sections.csv").write_text("section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4\nedge,0.06,0.004,0.02,0.002\nfloor,0.02,0.002,0.02,0.002\n")
    last = 2 * PANELS
    (folder / "supports.csv").write_text("support,node,x,y,z,rx,ry,rz\n" + "".join(
        f"s{n},{n},{1 if n <= 2 else 0},1,1,0,0,0\n" for n in (1, 2, last + 1, last + 2)))


def write_flutter(path, column="V_over_fB", low=0.1, high=400.0):
    """h1* = H1 at every reduced velocity."""
    values = ",".join(str(H1) if n == "h1" else "0" for n in NAMES)
    path.write_text(f"{column}," + ",".join(NAMES) + "\n" + "".join(f"{v},{values}\n" for v in (low, high)))


class Aerodynamics(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        write_model(self.folder / "model")
        write_flutter(self.folder / "flutter.csv")
        (self.folder / "polar.csv").write_text("alpha_deg,C_D,C_L,C_M\n-10,0.1,0.54105,0\n0,0.1,0,0\n10,0.1,-0.54105,0\n")  # C_L' = -3.1

    def run_step(self, *options, direction=90.0, models='["A"]', status=0, exceptions=EXCEPTIONS):
        study = self.folder / "study"
        study.mkdir(exist_ok=True)
        (study / "s7_aerodynamics.toml").write_text(
            f'direction_deg = {direction}\nnodes_per_deck = 40\nmodels = {models}\nsets = ["standin"]\nstructural_damping = {XI}\n'
            'n_modes = 6\nfollowed_modes = 2\nmax_speed = 150.0\nspeed_step = 5.0\n'
            f'[[deck]]\nname = "deck"\ncross_group = "deck_floor"\nchord = {CHORD}\nexceptions = {exceptions}\n'
            f'polar = "{self.folder}/polar.csv"\nflutter = "{self.folder}/flutter.csv"\n')
        done = subprocess.run([BIN / "s7_aerodynamics", "--study", study, "--model", self.folder / "model", "--out", self.folder / "out", "--quiet",
                               *options], capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(done.returncode, status, done.stderr)
        return done.stderr

    def read(self, name):
        with open(self.folder / "out" / name, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def critical(self, model):
        return next(float(r["V_cr_m_s"]) for r in self.read("critical.csv") if r["model"] == model and r["structural_damping_pct"] == "0.5")

    def test_cosine_rule_on_a_straight_deck(self):
        self.run_step()
        normal = self.critical("A")
        for theta in (20.0, -40.0):
            self.run_step(direction=90.0 + theta, models='["A", "C"]')
            self.assertAlmostEqual(self.critical("C") * math.cos(math.radians(theta)) / normal, 1.0, delta=1e-9)
            self.assertAlmostEqual(self.critical("A") / normal, 1.0, delta=1e-9)
            self.assertTrue(all(abs(float(r["yaw_deg"]) - theta) < 1e-9 for r in self.read("nodes.csv")))

    def test_galloping_meets_its_closed_form(self):
        self.run_step()
        row = self.read("critical.csv")[0]
        # Simply supported: the first vertical mode is a sine, whose modal mass is half the deck's: V = 4 m w xi/(rho B |h1|), with m
        # the mass per length (the end beams rest). Strips move along straight lines between sections, which loses (kh)²/6 of z².
        mass = 7850 * (2 * 0.06 * LENGTH + 0.02 * WIDTH * PANELS) / LENGTH / (1 - (math.pi / PANELS) ** 2 / 6)
        omega = 2 * math.pi * float(row["f_cr_Hz"])
        closed = 4 * mass * omega * XI / (1.25 * CHORD * abs(H1))
        self.assertEqual(row["mode"], "1")
        self.assertAlmostEqual(float(row["V_cr_m_s"]) / closed, 1.0, delta=2e-3)
        self.assertAlmostEqual(float(row["V_den_hartog_m_s"]) / closed, 1.0, delta=3e-3)  # C_L' + C_D = h1 to the digits of the polar
        self.assertLess(float(row["theta_rms_deg"]), 1e-9)
        self.assertAlmostEqual(float(row["exponent"]), 0.0, delta=1e-6)

    def test_named_and_more_nodes_give_the_same_bridge(self):
        """Nodes named by the model at every section (here on one edge) against nodes laid between them: the same strips to the chord
        of the shape; 30, 60 and 120 nodes to the lumping of a sine, 1/(1 + (pi/n)²/6) at most."""
        self.run_step("--set", "nodes_per_deck=30")
        speed = {30: self.critical("A")}
        for n in (60, 120):
            self.run_step("--set", f"nodes_per_deck={n}")
            speed[n] = self.critical("A")
            self.assertEqual(len(self.read("nodes.csv")), n)
            self.assertAlmostEqual(speed[n] / speed[30], 1.0, delta=2e-3)
        named = "".join(f"aero_deck_{i + 1:02d},{2 * i + 1}\n" for i in range(PANELS + 1))
        (self.folder / "model/points.csv").write_text("point,node\n" + named)
        self.run_step("--set", f"nodes_per_deck={PANELS + 1}")
        nodes = self.read("nodes.csv")
        self.assertEqual({float(r["y_m"]) for r in nodes}, {-WIDTH / 2})
        self.assertAlmostEqual(sum(float(r["length_m"]) for r in nodes), LENGTH * (1 + 1 / PANELS), places=9)  # half a panel beyond each end
        # trapezoid of sin² at the sections is exact; the interpolation between them lost (kh)²/6
        self.assertAlmostEqual(self.critical("A") / speed[120] / (1 - (math.pi / PANELS) ** 2 / 6), 1.0, delta=1e-3)

    def test_what_is_asked_of_models_and_tables_is_what_they_have(self):
        """Without A no ratio to it, though the identified damping is tried with A; without G and H no difference of theirs; galloping.csv
        as far as polar and table reach. Ratios of two runs of one model are those of their speeds."""
        self.run_step(models='["C", "A"]', direction=110.0)
        bare = self.critical("A")
        for row in self.read("critical.csv"):
            self.assertAlmostEqual(float(row["ratio_to_A"]), float(row["V_cr_m_s"]) / bare, places=9)
        self.assertEqual(len(self.read("galloping.csv")), 5 * 39)
        (self.folder / "polar.csv").write_text("alpha_deg,C_D,C_L,C_M\n-2,0.1,0.10821,0\n0,0.1,0,0\n2,0.1,-0.10821,0\n")
        write_flutter(self.folder / "flutter.csv", high=16.0)
        self.run_step("--set", "max_speed=20.0", models='["C"]', direction=110.0, exceptions="[]")
        self.assertEqual({r["ratio_to_A"] for r in self.read("critical.csv")}, {""})
        self.assertEqual([r["quantity"] for r in self.read("summary.csv") if r["quantity"].endswith("G_H")], [])
        rows = self.read("galloping.csv")
        self.assertEqual({float(r["angle_of_attack_deg"]) for r in rows}, {-2.0, 0.0, 2.0})
        self.assertEqual(max(float(r["V_over_fB"]) for r in rows), 16.0)
        self.run_step("--set", "max_speed=20.0", models='["G", "H"]', direction=110.0, exceptions="[]")
        self.assertEqual(len([r for r in self.read("summary.csv") if r["quantity"].endswith("G_H")]), 2)

    def test_static_forces_add_up(self):
        self.run_step()
        drag = sum(float(r["drag_N"]) for r in self.read("static.csv"))
        area = 0.5 * 1.25 * 40.4**2 * CHORD * 0.1 * LENGTH  # C_D = 0.1 at every angle
        self.assertAlmostEqual(drag / area, 1.0, delta=1e-9)

    def test_what_is_not_as_it_should_be_is_refused(self):
        write_flutter(self.folder / "flutter.csv", column="V_star")
        self.assertIn("does not say which reduced velocity", self.run_step(status=2))
        write_flutter(self.folder / "flutter.csv", high=3.0)
        message = self.run_step(status=2, exceptions="[]")
        self.assertIn("flutter.csv", message)
        self.assertIn("V/(f B) 0.1 to 3", message)
        write_flutter(self.folder / "flutter.csv")
        self.assertIn("expected less than 90 either way", self.run_step(direction=0.0, status=2))
        self.assertIn("choose one of A, C, D", self.run_step(models='["Z"]', status=2))
        self.assertIn("no aerodynamic set", self.run_step("--set", 'sets=["standing"]', status=2))

    def test_holding_the_end_values_must_be_asked_for(self):
        write_flutter(self.folder / "flutter.csv", high=3.0)
        self.run_step(status=2, exceptions="[]")
        self.run_step("--set", "above_range=hold", exceptions="[]")
        self.assertGreater(self.critical("A"), 0.0)


class Laws(unittest.TestCase):
    """Aerodynamic data of the Ponte del Mare with one sign turned. Oracle: the set as it is passes its laws (the step goes on to look for a
    model), a turned sign is refused with file, place and law before anything is computed."""

    STUDY = ROOT / "workflows/ponte_del_mare"
    AERO = "data/ponte_del_mare/aero"

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def turned(self, file, *columns, exceptions=""):
        """What step 7 says of the study with these columns of one file multiplied by -1."""
        with open(ROOT / self.AERO / file, newline="", encoding="utf-8") as lines:
            rows = list(csv.DictReader(lines))
        with open(self.folder / file, "w", newline="", encoding="utf-8") as out:
            writer = csv.DictWriter(out, rows[0])
            writer.writeheader()
            writer.writerows({name: str(-float(v)) if name in columns else v for name, v in row.items()} for row in rows)
        text = (self.STUDY / "s7_aerodynamics.toml").read_text(encoding="utf-8").replace(f"{self.AERO}/{file}", str(self.folder / file))
        if exceptions:
            text = text.replace("chord = 4.5", f"exceptions = {exceptions}\nchord = 4.5")
        (self.folder / "s7_aerodynamics.toml").write_text(text, encoding="utf-8")
        done = subprocess.run([BIN / "s7_aerodynamics", "--study", self.folder, "--results", self.folder / "none", "--out", self.folder / "out", "--quiet"],
                              capture_output=True, text=True, cwd=ROOT)
        self.assertEqual(done.returncode, 2)
        return done.stderr

    def test_the_set_as_it_is_passes(self):
        self.assertIn("s6_updating/model: is not there", self.turned("foot_flutter.csv"))

    def test_each_turned_sign_is_refused(self):
        for file, column, law in (("foot_flutter.csv", "a3", "quasi_steady"), ("foot_flutter.csv", "h1", "quasi_steady"), ("foot_flutter.csv", "h3", "quasi_steady"),
                                  ("foot_flutter.csv", "a2", "pitching_damping"), ("cycle_flutter.csv", "a3", "quasi_steady"), ("foot_polar.csv", "C_D", "drag"),
                                  ("foot_polar.csv", "dC_M_per_rad", "slopes"), ("foot_polar.csv", "dC_L_per_rad", "slopes"), ("cycle_polar.csv", "dC_M_per_rad", "slopes")):
            message = self.turned(file, column)
            self.assertIn(f"breaks the law '{law}'", message, (file, column))
            self.assertIn(file, message)
        self.assertIn("dC_M/dalpha is -0.25", self.turned("foot_polar.csv", "C_M", "dC_M_per_rad"), "coefficient and slope together")

    def test_an_exception_needs_a_reason_and_a_broken_law(self):
        named = '["quasi_steady: a3 was measured at another axis"]'
        self.assertIn("s6_updating/model: is not there", self.turned("foot_flutter.csv", "a3", exceptions=named))
        self.assertIn("'quasi_steady' is excepted, but holds", self.turned("foot_flutter.csv", exceptions=named))
        self.assertIn("gives no reason for 'quasi_steady'", self.turned("foot_flutter.csv", "a3", exceptions='["quasi_steady"]'))
        self.assertIn("did you mean 'quasi_steady'", self.turned("foot_flutter.csv", "a3", exceptions='["quasi_stedy: a3 was measured elsewhere"]'))


if __name__ == "__main__":
    unittest.main()
