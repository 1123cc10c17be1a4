"""Step 9 on load tests of a girder of two spans whose middle support has settled between them.

The truth is a Timoshenko beam with a haunch over the pier, a stiffer concrete and bearings that turn stiffly, solved here with NumPy on 160
elements; the model is a folder of fourteen Euler-Bernoulli beams. Levels and support forces have noise. Oracle: the settlement that was put in.
LOAD_TEST_SEEDS="7 8 9" takes other seeds.
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
SEEDS = [int(seed) for seed in os.environ.get("LOAD_TEST_SEEDS", "1 2 3 4").split()]
SPANS = (22.0, 18.0)
LENGTH = sum(SPANS)
E, G, AREA, INERTIA, SHEAR = 34e9, 14e9, 2.4, 0.42, 0.4
STEP = 0.25                                     # m, of the truth's elements
MODEL_X = [2.75 * i for i in range(8)] + [22.0 + 3.0 * i for i in range(7)]
SUPPORTS = {"west": 0.0, "pier": 22.0, "east": LENGTH}
LEVELS = {"D1": 5.5, "D2": 11.0, "D3": 28.0, "D4": 31.0, "D5": 22.0}
FORCES = {"R_west": "west", "R_pier": "pier", "R_east": "east"}
CASES = {"empty": {}, "left": {11.0: -4e5}, "right": {31.0: -5e5}}   # N
LEVEL_STD, FORCE_STD = 1e-4, 2e3                # m, N
LEVEL = 0.90


def answer(loads, settlements, modulus, haunch):
    """Deflections in m at the nodes and forces of the supports in N (upwards on the girder)."""
    n = round(LENGTH / STEP)
    k = np.zeros((2 * n + 2, 2 * n + 2))
    for i in range(n):
        deeper = 1.0 + haunch * np.exp(-(((i + 0.5) * STEP - SPANS[0]) / 3.0) ** 2)
        ei, h = modulus * INERTIA * deeper**3, STEP
        phi = 12 * ei / (G * AREA * SHEAR * deeper * h * h)
        at = slice(2 * i, 2 * i + 4)
        k[at, at] += ei / (h**3 * (1 + phi)) * np.array(
            [[12, 6 * h, -12, 6 * h], [6 * h, (4 + phi) * h * h, -6 * h, (2 - phi) * h * h],
             [-12, -6 * h, 12, -6 * h], [6 * h, (2 - phi) * h * h, -6 * h, (4 + phi) * h * h]])
    for node in (0, n):
        k[2 * node + 1, 2 * node + 1] += 2e7    # N m/rad, pots that turn stiffly
    u, f = np.zeros(2 * n + 2), np.zeros(2 * n + 2)
    for x, force in loads.items():
        f[2 * round(x / STEP)] += force
    held = [2 * round(x / STEP) for x in SUPPORTS.values()]
    u[held] = [settlements.get(name, 0.0) for name in SUPPORTS]
    free = np.setdiff1d(np.arange(2 * n + 2), held)
    u[free] = np.linalg.solve(k[np.ix_(free, free)], f[free] - k[np.ix_(free, held)] @ u[held])
    return u[0::2], dict(zip(SUPPORTS, (k @ u - f)[held]))


def table(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, lineterminator="\n").writerows([header.split(","), *rows])


def write_model(folder):
    folder.mkdir(parents=True)
    table(folder / "nodes.csv", "node,x_m,y_m,z_m", [[i + 1, x, 0, 0] for i, x in enumerate(MODEL_X)])
    table(folder / "materials.csv", "material,youngs_modulus_Pa,poisson_ratio,density_kg_m3", [["concrete", E, 0.2, 2500.0]])
    table(folder / "sections.csv", "section,area_m2,inertia_y_m4,inertia_z_m4,torsion_m4", [["girder", AREA, INERTIA, 2.0, 0.3]])
    table(folder / "elements.csv", "element,type,group,material,section,node1,node2,orientation_x,orientation_y,orientation_z",
          [[i + 1, "beam", "span_W" if a < SPANS[0] else "span_E", "concrete", "girder", i + 1, i + 2, 0, 0, 1]
           for i, a in enumerate(MODEL_X[:-1])])
    held = {MODEL_X.index(x): name for name, x in SUPPORTS.items()}
    table(folder / "supports.csv", "support,node,x,y,z,rx,ry,rz",
          [[name, i + 1, int(name == "west"), 1, 1, 1, 0, 0] for i, name in held.items()])
    table(folder / "loads.csv", "load,node,direction,value,unit",
          [["empty", 1, "z", 0.0, "N"]] + [[case, MODEL_X.index(x) + 1, "z", force, "N"] for case, at in CASES.items() for x, force in at.items()])
    (folder / "model.toml").write_text('title = "girder of two spans"\n[[parameter]]\nname = "E"\ntarget = "youngs_modulus"\nof = ["concrete"]\n'
                                       f'unit = "Pa"\ninitial = {E}\nlower = {0.85 * E}\nupper = {1.15 * E}\n')


def write_features(folder, seed, kinds):
    """Rows of levels, of forces, or of both. @return the settlement in m, below 0."""
    folder.mkdir(parents=True)
    random = np.random.default_rng(seed)
    fall = -random.uniform(0.003, 0.015)
    modulus, haunch = E * random.uniform(0.94, 1.06), random.uniform(0.0, 0.06)
    channels = [[name, MODEL_X.index(x) + 1, 0, 0, 1, ""] for name, x in LEVELS.items()] + [[name, "", 0, 0, 1, support] for name, support in FORCES.items()]
    table(folder / "channels.csv", "channel,point,dx,dy,dz,support", channels)
    rows, conditions = [], ""
    for state, cases in (("before", ("left", "right")), ("after", ("empty", "left", "right"))):
        for case in cases:
            deflection, force = answer(CASES[case], {"pier": fall} if state == "after" else {}, modulus, haunch)
            name = f"{state}_{case}"
            conditions += f'[{name}]\nstate = "{state}"\nload = "{case}"\n'
            for channel, x in LEVELS.items():
                rows.append(["static_m", "", channel, name, deflection[round(x / STEP)] + LEVEL_STD * random.normal(), LEVEL_STD])
            for channel, support in FORCES.items():
                rows.append(["static_force_N", "", channel, name, force[support] + FORCE_STD * random.normal(), FORCE_STD])
    table(folder / "rows.csv", "type,mode,channel,condition,value,std", [row for row in rows if row[0] in kinds])
    (folder / "conditions.toml").write_text(conditions)
    return fall


class LoadTests(unittest.TestCase):
    KINDS = {"deflections": ("static_m",), "forces": ("static_force_N",), "both": ("static_m", "static_force_N")}

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        write_model(cls.folder / "model")

    def run_step(self, features, out, *arguments):
        return subprocess.run([BIN / "s9_diagnosis", "--model", self.folder / "model", "--features", features, "--out", out, *arguments],
                              cwd=ROOT, capture_output=True, text=True, timeout=600)

    def diagnosed(self, kind, seed):
        features, out = self.folder / f"features_{kind}_{seed}", self.folder / f"out_{kind}_{seed}"
        fall = write_features(features, seed, self.KINDS[kind])
        done = self.run_step(features, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        return fall, json.loads((out / "diagnosis.json").read_text()), done.stderr

    def check(self, kind, alone):
        """alone: whether these rows can tell the pier from the other supports. Forces cannot: whichever support settles, the girder has one
        redundant force, so that the reactions change in the same proportions."""
        inside = 0
        for seed in SEEDS:
            fall, result, said = self.diagnosed(kind, seed)
            self.assertTrue(result["effects"], f"seed {seed}: {said}")
            effect = result["effects"][0]
            self.assertEqual((effect["cause"], effect["state"]), ("settle", "after"), f"seed {seed}: {said}")
            known = {effect["location"]: effect["parameters"]} | {rival["id"].split("@")[1].split(" in ")[0]: rival["parameters"] for rival in effect["rivals"]}
            self.assertEqual(set(known), {"support:pier"} if alone else {f"support:{name}" for name in SUPPORTS}, f"seed {seed}: {said}")
            (rise,) = known["support:pier"]
            self.assertEqual((rise["name"], rise["unit"]), ("rise_m", "m"))
            self.assertLess(abs(rise["value"] / fall - 1.0), 0.25, f"seed {seed}: {rise} for {fall}")
            held = rise["low"] <= fall <= rise["high"]
            inside += held
            print(f"{kind}, seed {seed}: {1e3 * fall:.2f} mm, found {1e3 * rise['value']:.2f} ({1e3 * rise['low']:.2f} to "
                  f"{1e3 * rise['high']:.2f}) mm, {result['verdict']}, p {effect['probability']:.3f}{'' if held else ', OUTSIDE'}")
        # Of n intervals that hold with probability 0.9, fewer than this hold once in a hundred times.
        n = len(SEEDS)
        least = LEVEL * n - 2.33 * np.sqrt(n * LEVEL * (1 - LEVEL))
        self.assertGreaterEqual(inside, least)

    def test_settlement_from_deflections(self):
        self.check("deflections", alone=True)

    def test_settlement_from_forces(self):
        self.check("forces", alone=False)

    def test_settlement_from_both(self):
        self.check("both", alone=True)

    def test_what_was_not_measured_where_it_says_is_refused_by_line(self):
        features = self.folder / "mistaken"
        write_features(features, 1, ("static_m",))
        for row, words in (("static_strain,,D1,after_left,1e-5,1e-6", "needs a channel at an element"),
                           ("static_force_N,,D1,after_left,1e5,1e3", "needs a channel at a support"),
                           ("static_m,,R_pier,after_left,1e-3,1e-4", "needs a channel at a point")):
            text = (features / "rows.csv").read_text()
            (features / "rows.csv").write_text(text + row + "\n")
            done = self.run_step(features, self.folder / "refused")
            (features / "rows.csv").write_text(text)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("rows.csv:27: channel", done.stderr)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main()
