"""Step 9 on a girder whose truth is of another class than its model: the truth is a Timoshenko beam with a haunch and uneven mass on
bearings that turn stiffly, computed here with NumPy on 96 elements; the model is a folder of twelve Euler-Bernoulli beams.

Oracles: what was put in: nothing in the sound girder, a support that stiffens in the cold, exchanged channels.
"""
import csv
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))
SPANS, PIECES, DEPTH = (22.0, 18.0), 12, 1.6
LENGTH = sum(SPANS)
E, G, AREA, INERTIA, DENSITY, SHEAR = 34e9, 14e9, 2.4, 0.42, 2500.0, 0.4
BEARING = 8e7   # N/m under the pier
MODES, FROST = 6, 3.0
USUAL = {"haunch": 0.10, "haunch_m": 3.0, "uneven": 0.04, "wave": 2.3, "phase": 0.0, "pots": 4e8}
# Where an oscillator at a node that is held, whose own mode moves nothing else, was once taken for a mode of the structure.
OTHER = {"haunch": 0.09188923929, "haunch_m": 2.047101403, "uneven": 0.01126137461, "wave": 2.173147148, "phase": 0.4571918056, "pots": 60468102.73}


def timoshenko(n, frost=1.0, truth=None):
    """Frequencies and shapes of n elements with shear: deflection of each node."""
    really = USUAL | (truth or {})
    k, m = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
    h = LENGTH / n
    for i in range(n):
        x = (i + 0.5) * h
        haunch = 1.0 + really["haunch"] * np.exp(-((x - SPANS[0]) / really["haunch_m"]) ** 2)  # deeper over the pier
        uneven = 1.0 + really["uneven"] * np.sin(really["wave"] * x + really["phase"])        # mass that the drawing does not have
        ei, ga = E * INERTIA * haunch**3, G * AREA * SHEAR * haunch
        phi = 12 * ei / (ga * h * h)
        c = ei / (h**3 * (1 + phi))
        ke = c * np.array([[12, 6 * h, -12, 6 * h], [6 * h, (4 + phi) * h * h, -6 * h, (2 - phi) * h * h],
                           [-12, -6 * h, 12, -6 * h], [6 * h, (2 - phi) * h * h, -6 * h, (4 + phi) * h * h]])
        mu, rot = DENSITY * AREA * uneven * h, DENSITY * INERTIA * h
        me = np.diag([mu / 2, rot / 2, mu / 2, rot / 2])
        at = slice(2 * i, 2 * i + 4)
        k[at, at] += ke
        m[at, at] += me
    pier = round(SPANS[0] / h)
    k[2 * pier, 2 * pier] += BEARING * frost
    for node in (0, n):
        k[2 * node + 1, 2 * node + 1] += really["pots"]                 # pots that turn stiffly
    free = [d for d in range(2 * n + 2) if d not in (0, 2 * n)]
    root = 1 / np.sqrt(np.diag(m)[free])
    values, vectors = np.linalg.eigh(root[:, None] * k[np.ix_(free, free)] * root[None, :])
    shapes = np.zeros((2 * n + 2, MODES))
    shapes[free] = root[:, None] * vectors[:, :MODES]
    return np.sqrt(values[:MODES]) / (2 * np.pi), shapes[0::2]


def table(path, header, rows):
    with open(path, "w", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([header.split(","), *rows])


def write_model(folder):
    folder.mkdir()
    at = np.concatenate([np.linspace(0, SPANS[0], 7), SPANS[0] + np.linspace(0, SPANS[1], 7)[1:]])
    table(folder / "nodes.csv", "node,x_m,y_m,z_m", [[i + 1, x, 0, 0] for i, x in enumerate(at)])
    table(folder / "materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3", [["concrete", E, 0.2, DENSITY]])
    table(folder / "sections.csv", "section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4", [["girder", AREA, INERTIA, 2.0, 0.3]])
    table(folder / "elements.csv", "element,type,group,material,section,node1,node2,orientation_x,orientation_y,orientation_z",
          [[i + 1, "beam", "long_span" if i < 6 else "short_span", "concrete", "girder", i + 1, i + 2, 0, 0, 1] for i in range(PIECES)])
    table(folder / "supports.csv", "support,node,x,y,z,rx,ry,rz",
          [["abutment" if i in (0, PIECES) else "plane", i + 1, 1, 1, int(i in (0, PIECES)), 1, 0, 1] for i in range(PIECES + 1)])
    table(folder / "springs.csv", "spring,group,node,direction_x,direction_y,direction_z,quantity,stiffness_N_m",
          [["pier", "pier", 7, 0, 0, 1, "translation", BEARING]])
    (folder / "model.toml").write_text('title = "girder"\n' + "".join(
        f'[[parameter]]\nname = "{name}"\ntarget = "{target}"\nof = ["{of}"]\nunit = "{unit}"\ninitial = {value}\n'
        f"lower = {0.85 * value}\nupper = {1.15 * value}\n"
        for name, target, of, unit, value in (("E_concrete", "youngs_modulus", "concrete", "Pa", E),
                                              ("k_pier", "spring_stiffness", "pier", "-", 1.0))))
    return at


def write_features(folder, at, frost, seed, truth=None):
    """Two conditions, a warm and a cold day; noise 0.2 % in frequency and 1 % in shape."""
    random = np.random.default_rng(seed)
    folder.mkdir()
    rows = ["type,mode,channel,condition,value,std"]
    n = 96
    x = np.linspace(0, LENGTH, n + 1)
    inner = [i for i in range(1, PIECES) if i != 6]
    for condition, factor in (("warm", 1.0), ("cold", frost)):
        frequency, shapes = timoshenko(n, factor, truth)
        for mode in range(MODES):
            std = 0.002 * frequency[mode]
            rows.append(f"frequency_Hz,{mode + 1},,{condition},{frequency[mode] + std * random.standard_normal():.10g},{std:.6g}")
            y = np.interp(at[inner], x, shapes[:, mode])
            y /= np.abs(y).max()
            rows += [f"shape,{mode + 1},c{i},{condition},{v + 0.01 * random.standard_normal():.10g},0.01" for i, v in zip(inner, y)]
    (folder / "rows.csv").write_text("\n".join(rows) + "\n")
    (folder / "conditions.toml").write_text("[warm]\ntemperature_C = 20\n[cold]\ntemperature_C = -8\n")
    (folder / "channels.csv").write_text("channel,point,x_m,y_m,z_m,dx,dy,dz\n" +
                                         "".join(f"c{i},{i + 1},{at[i]},0,0,0,0,1\n" for i in inner))


class FormOfTheModel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        cls.at = write_model(cls.folder / "model")
        write_features(cls.folder / "sound", cls.at, 1.0, 1)
        write_features(cls.folder / "frozen", cls.at, FROST, 2)
        write_features(cls.folder / "chilled", cls.at, 1.6, 3)
        write_features(cls.folder / "exchanged", cls.at, 1.0, 4)
        write_features(cls.folder / "other", cls.at, FROST, 1, OTHER)
        rows = (cls.folder / "exchanged/rows.csv").read_text()
        (cls.folder / "exchanged/rows.csv").write_text(rows.replace(",c3,", ",other,").replace(",c5,", ",c3,").replace(",other,", ",c5,"))

    def diagnose(self, features):
        out = self.folder / f"{features}_out"
        if not out.exists():
            done = subprocess.run([BIN / "s9_diagnosis", "--model", self.folder / "model", "--features", self.folder / features, "--out", out,
                                   "--catalogue", ROOT / "workflows/common/hypotheses"],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((out / "diagnosis.json").read_text())

    def test_a_sound_girder_is_sound(self):
        result = self.diagnose("sound")
        self.assertEqual(result["verdict"], "none", result["message"])
        self.assertEqual(result["effects"], [])
        self.assertLess(result["detection"]["probability"], 0.95)
        self.assertLess(result["detection"]["log_odds"], result["detection"]["threshold"])

    def test_the_errors_of_the_model_are_told_by_class(self):
        result = self.diagnose("sound")
        self.assertEqual(result["schema"], 2)
        classes = {entry["name"]: entry for entry in result["form"]}
        self.assertEqual(list(classes)[:3], ["frequencies", "shapes", "channels of shapes"])
        for entry in classes.values():
            self.assertLess(entry["low"], entry["scale"], entry)
            self.assertGreater(entry["high"], entry["scale"], entry)
        # What a fit of the model leaves is about a per cent; the scale is some two times the RMS.
        self.assertGreater(classes["frequencies"]["high"], 0.3)
        self.assertLess(classes["frequencies"]["low"], 5.0)

    def test_what_differs_between_two_conditions_is_found(self):
        result = self.diagnose("frozen")
        self.assertIn(result["verdict"], ("named", "ambiguous"), result["message"])
        self.assertTrue(any("pier" in member for member in result["effects"][0]["cluster"]), result["effects"][0]["cluster"])
        self.assertEqual(result["effects"][0]["cause"], "freeze")

    def test_a_size_far_from_the_screens_magnitudes_is_found_too(self):
        """The screen tries a support 4 and 15 times as stiff; with errors of 0.2 % what is 1.6 times as stiff is like neither."""
        result = self.diagnose("chilled")
        self.assertEqual(result["verdict"], "named", result["message"])
        self.assertEqual(result["effects"][0]["cluster"], ["freeze@support:pier"])
        factor = next(p for p in result["effects"][0]["parameters"] if p["name"] == "factor")
        self.assertLessEqual(factor["low"], 1.6)
        self.assertGreaterEqual(factor["high"], 1.6)

    def test_an_entry_that_cannot_be_solved_costs_no_results(self):
        result = self.diagnose("other")
        self.assertEqual(result["verdict"], "named", result["message"])
        self.assertEqual(result["effects"][0]["cluster"], ["freeze@support:pier"])

    def test_exchanged_channels_are_named(self):
        result = self.diagnose("exchanged")
        self.assertEqual(result["verdict"], "named", result["message"])
        self.assertEqual([effect["cluster"] for effect in result["effects"]], [["swap@channels:c3,c5"]])

    def test_what_these_rows_do_not_show_is_no_entry(self):
        """A node that is held in every direction but along the girder moves nothing: no leftover may make a leader of it."""
        self.diagnose("frozen")
        with open(self.folder / "frozen_out/hypotheses.csv", newline="") as stream:
            places = {(row["cause"], row["location"]) for row in csv.DictReader(stream)}
        self.assertIn(("freeze", "support:pier"), places)
        self.assertNotIn(("freeze", "support:plane"), places)

    def test_the_gain_comes_from_modes_left_out(self):
        gain = self.diagnose("frozen")["gain"]
        self.assertEqual(gain["blocks"], MODES)
        self.assertEqual(gain["held_out"], "each mode in turn, in all conditions")
        self.assertGreater(gain["log_gain_interval"][0], 0.0)
        self.assertGreater(gain["reduction_pct"], 0.0)
        self.assertLess(gain["after"], gain["before"])

    def test_keys_of_earlier_methods_are_refused_with_what_replaces_them(self):
        for setting, words in (("form=on", ("one method now", "leave it out")), ("nulls=200", ("no longer used", "docs/diagnosis.md")),
                               ("threshold_cache=x", ("no longer used",)), ("residual_alpha=0.01", ("earlier method", "95 %")),
                               ("residual_alpha_named=0.01", ("earlier method",)), ("refine_locations=true", ("raise nodes and zones",))):
            with self.subTest(setting=setting):
                done = subprocess.run([BIN / "s9_diagnosis", "--model", self.folder / "model", "--features", self.folder / "sound", "--out",
                                       self.folder / "refused", "--set", setting], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 2)
                for word in (setting.split("=")[0], *words):
                    self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()
