"""Step 4 on the study: columns of every table, the ten pairs of Table 7, each as-built change with an effect on every mode; and on a
matrix model with measured shapes, pairing by MAC. Oracles: the contract of the outputs, arithmetic on their own columns, and a
chain whose modes are known."""

import csv
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import tomllib
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))
STUDY = ROOT / "workflows" / "ponte_del_mare"


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def run(*arguments):
    return subprocess.run([str(a) for a in arguments], cwd=ROOT, capture_output=True, text=True)


class OnTheStudy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        results = pathlib.Path(cls.folder.name) / "results"
        # The study as it is, on the coarse mesh.
        study = pathlib.Path(cls.folder.name) / "study"
        shutil.copytree(STUDY, study)
        with open(study / "study.toml", "a") as file:
            file.write('mesh = "coarse"\n')
        (study / "s1_model.toml").unlink()
        for token in ("s1_model", "s4_refinement"):
            done = run(BIN / token, "--study", study, "--results", results, "--out", results / token, "--quiet")
            assert done.returncode == 0, done.stderr
        cls.out = results / "s4_refinement"

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_ten_pairs_as_published(self):
        rows = [r for r in table(self.out / "comparison.csv") if r["stage"] == "refined"]
        pairs = [f'{r["experimental_mode"]}-{r["numerical_mode"]}' for r in rows]
        self.assertEqual(pairs, ["1X-1N", "2X-2N", "3X-3N", "4X-4N", "5X-5N", "6X-6N", "7X-8N", "8X-10N", "9X-9N", "10X-12N"])
        self.assertEqual({r["pairing"] for r in rows}, {"published"})
        self.assertEqual([r["mac"] for r in rows], [""] * 10)
        self.assertEqual([f'{r["experimental_mode"]}-{r["numerical_mode"]}' for r in table(self.out / "pairs.csv")], pairs)

    def test_initial_by_order(self):
        rows = [r for r in table(self.out / "comparison.csv") if r["stage"] == "initial"]
        self.assertEqual([(r["experimental_mode"], r["numerical_mode"]) for r in rows], [(f"{i}X", f"{i}N") for i in range(1, 11)])
        self.assertEqual({r["pairing"] for r in rows}, {"order"})

    def test_errors_are_those_of_the_frequencies(self):
        computed = {r["mode"]: float(r["frequency_Hz"]) for r in table(self.out / "modes.csv")}
        for row in table(self.out / "comparison.csv"):
            measured, model = float(row["measured_Hz"]), float(row["computed_Hz"])
            self.assertAlmostEqual(float(row["error_pct"]), 100 * (model - measured) / measured, places=8)
            if row["stage"] == "refined":
                self.assertEqual(model, computed[row["numerical_mode"][:-1]])

    def test_every_change_on_every_mode(self):
        with open(ROOT / "data" / "ponte_del_mare" / "bridge.toml", "rb") as file:
            changes = [c["name"] for c in tomllib.load(file)["change"]]
        rows = table(self.out / "changes.csv")
        self.assertEqual(list(dict.fromkeys(r["change"] for r in rows)), changes)
        modes = len(table(self.out / "modes.csv"))
        self.assertEqual(modes, 15)
        for change in changes:
            self.assertEqual([r["mode"] for r in rows if r["change"] == change], [str(i + 1) for i in range(modes)])
        for row in rows:
            if not row["frequency_alone_Hz"]:
                continue
            ratio = float(row["frequency_alone_Hz"]) / float(row["frequency_before_Hz"])
            self.assertAlmostEqual(float(row["effect_alone_pct"]), 100 * (ratio - 1), places=7)
            self.assertTrue(0 <= float(row["mac_alone"]) <= 1)
        for change in changes:
            self.assertTrue(any(abs(float(r["effect_alone_pct"] or 0)) > 1e-3 for r in rows if r["change"] == change), change)

    def test_all_changes_together_are_the_refined_model(self):
        rows = table(self.out / "changes.csv")
        last = [r for r in rows if r["change"] == rows[-1]["change"] and r["effect_cumulative_pct"]]
        ends = sorted(float(r["frequency_before_Hz"]) * (1 + float(r["effect_cumulative_pct"]) / 100) for r in last)
        refined = [float(r["frequency_Hz"]) for r in table(self.out / "modes.csv")]
        for end in ends:
            if end < refined[-1]:
                self.assertLess(min(abs(end / f - 1) for f in refined), 1e-6)

    def test_folder_of_the_model_and_shapes(self):
        self.assertTrue((self.out / "model" / "model.toml").is_file())
        shapes = table(self.out / "shapes.csv")
        self.assertEqual(list(shapes[0]), ["mode", "point", "direction", "value"])
        self.assertEqual(max(float(r["value"]) for r in shapes if r["mode"] == "1"), 1.0)
        self.assertEqual(table(self.out / "mac.csv"), [])


def write_chain(folder, n, k, m):
    """A chain of n masses between n + 1 springs as a matrix model: shapes sin(j pi i / (n + 1))."""
    folder.mkdir(parents=True)
    with open(folder / "dofs.csv", "w") as file:
        file.write("dof,node,direction,x_m,y_m,z_m\n")
        file.writelines(f"{i},{i},z,{i},0,0\n" for i in range(1, n + 1))
    header = "%%MatrixMarket matrix coordinate real symmetric\n"
    springs = [(i, i, 2 * k) for i in range(1, n + 1)] + [(i + 1, i, -k) for i in range(1, n)]
    masses = [(i, i, m) for i in range(1, n + 1)]
    for name, entries in (("K0.mtx", springs), ("M0.mtx", masses), ("K1.mtx", [(1, 1, 1.0)])):
        lines = "".join(f"{i} {j} {v!r}\n" for i, j, v in entries)
        (folder / name).write_text(f"{header}{n} {n} {len(entries)}\n{lines}")
    (folder / "model.toml").write_text(
        '[matrices]\nK = "K0.mtx"\nM = "M0.mtx"\n[[parameter]]\nname = "k1"\nmatrix = "K1.mtx"\ntarget = "stiffness"\n'
        "initial = 0.0\nlower = -1.0\nupper = 1.0\n"
    )


class OnAMatrixModel(unittest.TestCase):
    N = 12

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        write_chain(self.root / "model", self.N, 1000.0, 2.0)

    def tearDown(self):
        self.folder.cleanup()

    def frequency(self, j):
        return math.sqrt(4 * 1000.0 / 2.0) * math.sin(j * math.pi / (2 * (self.N + 1))) / (2 * math.pi)

    def write_measured(self, modes, std="0.01"):
        """Measured modes that are the chain's own, listed in another order and seen at four sensors."""
        folder = self.root / "measured"
        folder.mkdir(exist_ok=True)
        with open(folder / "modes.csv", "w") as file:
            file.write("mode,frequency_Hz,frequency_std_Hz,damping_ratio_pct,damping_ratio_std_pct\n")
            file.writelines(f"{name},{self.frequency(j) * 1.02},{std},,\n" for name, j in modes)
        with open(folder / "shapes.csv", "w") as file:
            file.write("mode,point,direction,value\n")
            for name, j in modes:
                for point in (2, 5, 8, 11):
                    file.write(f"{name},{point},z,{-3 * math.sin(j * math.pi * point / (self.N + 1))}\n")
        return folder

    def step(self, *arguments):
        return run(BIN / "s4_refinement", "--model", self.root / "model", "--out", self.root / "out", "--quiet", *arguments)

    def test_pairs_by_mac(self):
        done = self.step("--modes", self.write_measured([("1", 2), ("2", 1), ("3", 3)]), "--set", "n_modes=5")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [r for r in table(self.root / "out" / "comparison.csv") if r["stage"] == "refined"]
        self.assertEqual([r["numerical_mode"] for r in rows], ["2N", "1N", "3N"])
        self.assertEqual({r["pairing"] for r in rows}, {"mac"})
        for row in rows:
            self.assertGreater(float(row["mac"]), 1 - 1e-9)
            self.assertAlmostEqual(float(row["error_pct"]), 100 * (1 / 1.02 - 1), places=6)
        self.assertEqual(len(table(self.root / "out" / "mac.csv")), 15)
        self.assertEqual(table(self.root / "out" / "changes.csv"), [])
        for row in table(self.root / "out" / "modes.csv"):
            self.assertAlmostEqual(float(row["frequency_Hz"]) / self.frequency(int(row["mode"])), 1.0, places=9)
        self.assertTrue((self.root / "out" / "model" / "dofs.csv").is_file())

    def test_refuses_modes_without_standard_deviation(self):
        done = self.step("--modes", self.write_measured([("1", 1)], std=""))
        self.assertEqual(done.returncode, 2)
        self.assertIn("standard deviation", done.stderr)
        self.assertIn("modes.csv:2", done.stderr)
        self.assertFalse((self.root / "out").exists())

    def features(self, rows, conditions="[quiet]\n"):
        folder = self.root / "features"
        folder.mkdir(exist_ok=True)
        (folder / "rows.csv").write_text("type,mode,channel,condition,value,std\n" + rows)
        (folder / "conditions.toml").write_text(conditions)
        (folder / "channels.csv").write_text(
            "channel,point,x_m,y_m,z_m,dx,dy,dz\nc1,a,2.1,0,0,0,0,1\nc2,b,4.9,0,0,0,0,-1\nc3,c,8,0,0,0,0,1\nfar,d,90,0,0,0,0,1\n")
        return folder

    def test_features_place_sensors_by_coordinates(self):
        rows = ""
        for mode, j in ((1, 1), (2, 2)):
            rows += f"frequency_Hz,{mode},,quiet,{self.frequency(j)},0.01\n"
            for channel, point, sign in (("c1", 2, 1), ("c2", 5, -1), ("c3", 8, 1)):
                rows += f"shape,{mode},{channel},quiet,{sign * math.sin(j * math.pi * point / (self.N + 1))},0.1\n"
        done = self.step("--features", self.features(rows))
        self.assertEqual(done.returncode, 0, done.stderr)
        pairs = table(self.root / "out" / "pairs.csv")
        self.assertEqual([(r["experimental_mode"], r["numerical_mode"]) for r in pairs], [("1X", "1N"), ("2X", "2N")])
        self.assertTrue(all(float(r["mac"]) > 1 - 1e-9 for r in pairs))

    def test_messages_of_wrong_features(self):
        good = f"frequency_Hz,1,,quiet,{self.frequency(1)},0.01\n"
        cases = [
            (f"frequency_Hz,1,,quiet,{self.frequency(1)},\n", "[quiet]\n", "rows.csv:2: std"),
            ("frequency_hz,1,,quiet,1.0,0.1\n", "[quiet]\n", "frequency_Hz"),
            (good + "shape,1,c9,quiet,1.0,0.1\n", "[quiet]\n", "channels.csv"),
            (good + "shape,1,far,quiet,1.0,0.1\n", "[quiet]\n", "nearest node"),
            ("damping_ratio_pct,1,,quiet,1.0,0.1\n", "[quiet]\n", "no row of type frequency_Hz"),
            (good, "[a]\n[b]\n", "2 conditions"),
            (good, '[quiet]\ndampers = "half"\n', "expected \"on\" or \"off\""),
            (good, "[other]\n", "is not in conditions.toml"),
        ]
        for rows, conditions, message in cases:
            with self.subTest(message=message):
                done = self.step("--features", self.features(rows, conditions))
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(message, done.stderr)
                self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)

    def test_messages_of_wrong_pairs(self):
        rows = "".join(f"frequency_Hz,{j},,quiet,{self.frequency(j)},0.01\n" for j in (1, 2))
        folder = self.features(rows)
        for pairs, message in (
            ('["1X8N"]', "'1X8N' is no pair"),
            ('["1X-1N", "2X-1N"]', "another pair names too"),
            ('["1X-99N"]', "numerical mode 99 of"),
        ):
            with self.subTest(message=message):
                done = self.step("--features", folder, "--set", f"pairs={pairs}")
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(message, done.stderr)
        done = self.step("--features", folder, "--set", 'pairs=["2X-3N"]')
        self.assertEqual(done.returncode, 0, done.stderr)
        kept = [(r["stage"], r["experimental_mode"], r["numerical_mode"]) for r in table(self.root / "out" / "comparison.csv")]
        self.assertEqual(kept, [("initial", "2X", "2N"), ("refined", "2X", "3N")])


if __name__ == "__main__":
    unittest.main()
