"""All measured frequencies off by one known factor: a unit or a weight for a mass, which steps 5, 6 and 9 name before they update or name anything.

Oracle: the frequencies of the template's features divided by sqrt(9.80665); the words of each refusal, and its remedy followed. Frequencies and
shapes of a girder of three equal spans in space, in closed form, of which only the vertical modes are measured.
"""
import csv
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
TEMPLATE = ROOT / "data" / "template"


class UnitSlips(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        for part in ("model", "features"):
            shutil.copytree(TEMPLATE / part, cls.folder / part)
        with open(cls.folder / "features/rows.csv", newline="") as table:
            rows = list(csv.DictReader(table))
        for row in rows:
            if row["type"] == "frequency_Hz":
                row["value"], row["std"] = (float(row[key]) / math.sqrt(9.80665) for key in ("value", "std"))
        with open(cls.folder / "features/rows.csv", "w", newline="") as table:
            writer = csv.DictWriter(table, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)
        # The same model whose bounds reach the factor of ten in stiffness over mass.
        shutil.copytree(cls.folder / "model", cls.folder / "wide")
        file = cls.folder / "wide/model.toml"
        text = re.sub(r"lower = 204e9\nupper = 216e9", "lower = 5e9\nupper = 2e12", file.read_text())
        file.write_text(text.replace("lower = 0.2\nupper = 5.0", "lower = 0.01\nupper = 100.0"))

    def run_step(self, step, model, out, *more):
        return subprocess.run([BIN / step, "--model", model, "--features", "features", "--out", out, "--threads", "1", *more], cwd=self.folder,
                              capture_output=True, text=True, timeout=300)

    def refused(self, done):
        self.assertEqual(done.returncode, 2, done.stderr)
        said = done.stderr.splitlines()[-1]
        self.assertIn("are 0.305 times those of the computed modes with their shapes", said)
        self.assertIn("is a mass divided by g once too often?", said)
        return said

    def test_steps_5_6_and_9_name_the_unit(self):
        for step in ("s5_sensitivity", "s6_updating", "s9_diagnosis"):
            self.refused(self.run_step(step, "model", f"out/{step}", "--quiet"))

    def test_step_9_names_no_material_though_bounds_reach_the_factor(self):
        said = self.refused(self.run_step("s9_diagnosis", "wide", "out/wide", "--quiet"))
        self.assertIn("a parameter that is meant to be so far off gets that value in the model and as its `initial`", said)
        file = self.folder / "wide/model.toml"
        file.write_text(file.read_text().replace("initial = 210e9", "initial = 21e9").replace("initial = 1.0\nlower = 0.01", "initial = 0.1\nlower = 0.01"))
        materials = self.folder / "wide/materials.csv"
        materials.write_text(materials.read_text().replace("2.1e11", "2.1e10").replace("210e9", "21e9").replace("210000000000", "21000000000"))
        done = self.run_step("s9_diagnosis", "wide", "out/meant", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(json.loads((self.folder / "out/meant/diagnosis.json").read_text())["verdict"], ("none", "named", "ambiguous", "unknown"))


class GirderInSpace(unittest.TestCase):
    """A steel girder of three spans of 20 m that is sqrt(Iy / Iz) = 3.3 times as fast upwards as sideways, nearly sqrt(9.81)."""
    ELASTIC, AREA, IY, IZ, SPAN, MASS = 200e9, 0.05, 0.0218, 0.002, 20.0, 3500.0  # MASS in kg/m, all of it in points
    ELEMENTS, SENSORS = 60, (6, 13, 26, 33, 47, 54)
    WAVES = (math.pi, 3.5500, 4.3040)  # of the first three modes, times the span (Blevins 1979, table 8-5)

    @classmethod
    def deflection(cls, mode, x):
        """Mode 1 is a sine; modes 2 and 3 have equal moments at both inner supports, of opposite and of the same sign."""
        wave, span = cls.WAVES[mode - 1], int(x // cls.SPAN)
        part = x / cls.SPAN - span
        if mode == 1:
            return math.sin(wave * x / cls.SPAN)
        bent = lambda at: math.sinh(wave * at) / math.sinh(wave) - math.sin(wave * at) / math.sin(wave)  # noqa: E731
        right = -1.0 if mode == 2 else 1.0
        return {0: bent(part), 1: bent(1 - part) + right * bent(part), 2: right * bent(1 - part)}[span]

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        for name, factor in (("right", 1.0), ("weight", 9.80665)):
            cls.write_model(cls.folder / name, factor)
        for name, modes in (("three", (1, 2, 3)), ("two", (1, 2))):
            cls.write_features(cls.folder / name, modes, shapes=True)
        cls.write_features(cls.folder / "frequencies", (1, 2, 3), shapes=False)
        shutil.copytree(cls.folder / "three", cls.folder / "elsewhere")
        channels = cls.folder / "elsewhere/channels.csv"
        channels.write_text(channels.read_text().replace(",0,0,0,0,1,", ",9,0,0,0,1,"))

    @classmethod
    def write_model(cls, folder, factor):
        folder.mkdir()
        n, step = cls.ELEMENTS, 3 * cls.SPAN / cls.ELEMENTS
        mass = lambda i: factor * cls.MASS * step * (0.5 if i in (0, n) else 1.0)  # noqa: E731
        tables = {
            "nodes": ["node,x_m,y_m,z_m"] + [f"{i + 1},{i * step},0,0" for i in range(n + 1)],
            "elements": ["element,type,group,material,section,node1,node2,orientation_x,orientation_y,orientation_z"]
                        + [f"{i},beam,girder,steel,g,{i},{i + 1},0,0,0" for i in range(1, n + 1)],
            "masses": ["group,node,mass_kg"] + [f"deck,{i + 1},{mass(i)}" for i in range(n + 1)],
            "materials": ["material,youngs_modulus_Pa,poisson_ratio,density_kg_m3", f"steel,{cls.ELASTIC},0.3,0"],
            "sections": ["section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4", f"g,{cls.AREA},{cls.IY},{cls.IZ},0.001"],
            "supports": ["support,node,x,y,z,rx,ry,rz", "a,1,1,1,1,1,0,0"]
                        + [f"b{at},{at},0,1,1,1,0,0" for at in (n // 3 + 1, 2 * n // 3 + 1, n + 1)]}
        for name, rows in tables.items():
            (folder / f"{name}.csv").write_text("\n".join(rows) + "\n")
        (folder / "model.toml").write_text('[[parameter]]\nname = "E"\ntarget = "youngs_modulus"\nof = ["steel"]\nunit = "Pa"\n'
                                           "initial = 200e9\nlower = 150e9\nupper = 250e9\n")

    @classmethod
    def write_features(cls, folder, modes, shapes):
        folder.mkdir()
        rows = ["type,mode,channel,condition,value,std"]
        for mode in modes:
            frequency = (cls.WAVES[mode - 1] / cls.SPAN)**2 / (2 * math.pi) * math.sqrt(cls.ELASTIC * cls.IY / cls.MASS)
            rows.append(f"frequency_Hz,{mode},,as_tested,{frequency},{0.005 * frequency}")
            for x in cls.SENSORS if shapes else ():
                rows.append(f"shape,{mode},z{x},as_tested,{cls.deflection(mode, x)},0.005")
        (folder / "rows.csv").write_text("\n".join(rows) + "\n")
        (folder / "conditions.toml").write_text("[as_tested]\n")
        if shapes:
            (folder / "channels.csv").write_text(
                "channel,x_m,y_m,z_m,dx,dy,dz,quantity,unit,gain,reference,role\n"
                + "".join(f"z{x},{x},0,0,0,0,1,acceleration,m/s^2,1,1,response\n" for x in cls.SENSORS))

    def answers(self, model, features):
        for step in ("s5_sensitivity", "s6_updating", "s9_diagnosis"):
            yield subprocess.run([BIN / step, "--model", model, "--features", features, "--out", f"out/{step}", "--threads", "1"],
                                 cwd=self.folder, capture_output=True, text=True, timeout=300)

    def test_lateral_modes_that_no_sensor_sees_are_no_weight(self):
        for done in self.answers("right", "three"):
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("weight", done.stdout + done.stderr)

    def test_frequencies_alone_leave_it_open(self):
        for done in self.answers("right", "frequencies"):
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("Or the measured modes are others of the computed ones", done.stdout + done.stderr)

    def test_step_5_compares_frequencies_where_channels_are_not_on_the_model(self):
        done = next(self.answers("right", "elsewhere"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Or the measured modes are others of the computed ones", done.stdout + done.stderr)

    def test_weights_are_named_by_the_modes_with_the_measured_shapes(self):
        for features, how_many in (("three", "all 3"), ("two", "all 2")):
            for done in self.answers("weight", features):
                self.assertEqual(done.returncode, 2, done.stderr)
                said = done.stderr.splitlines()[-1]
                self.assertIn(f"{how_many} measured frequencies", said)
                self.assertRegex(said, r"are 3\.1[234] times those of the computed modes with their shapes")
                self.assertIn("is a weight in newtons given as a mass in kilograms?", said)


if __name__ == "__main__":
    unittest.main()
