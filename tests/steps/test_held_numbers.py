"""Numbers of the smoke chain and of three diagnoses, held where they are: a fault in any step moves some column, also where every result
stays plausible.

Oracle: the tables of held, of the run before. Every column of every CSV, and every name of diagnosis.json, has its root mean square, its mean in the order of the rows (another
order or sign shows there) and a sum of its words. `make hold` writes the tables anew; a change of them is read in the review.
"""
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

os.environ["OPENBLAS_CORETYPE"] = "Haswell"  # before NumPy loads it: the features that are diagnosed are computed here
import numpy as np  # noqa: E402
import pandas as pd  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "reproduction"))
sys.path.insert(0, str(ROOT / "tests" / "steps"))
import test_diagnosis  # noqa: E402
import test_diagnosis_form  # noqa: E402
from columns import NOT_COMPARED, SHOWN  # noqa: E402

BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))
HELD = pathlib.Path(__file__).parent / "held"
# Of a column's root mean square. Other processors' kernels move a column by up to 1e-6 of its largest number (test_processors).
TOLERANCE = 1e-5
# Of a diagnosis. A fit ends where chi² falls by less than 0.02, and may end on either side of where a mode changes its partner: other processors'
# kernels move log odds by up to 0.1 of 300. All runs here use the kernels of one processor.
OF_FITS = 1e-3
# Rounding alone, where a basis holds the measured modes exactly.
NOT_HELD = NOT_COMPARED | {"full_model.largest_deviation_pct"}


def leaves(value, name=""):
    """(name, value) of everything in a JSON file; members of a list share a name."""
    if isinstance(value, dict):
        for key, member in value.items():
            yield from leaves(member, f"{name}.{key}".lstrip("."))
    elif isinstance(value, list):
        for member in value:
            yield from leaves(member, name)
    else:
        yield name, value


def row_of(file, column, cells):
    """@param cells  numbers and words, as strings"""
    x = pd.to_numeric(pd.Series(cells, dtype=str), errors="coerce").to_numpy(dtype=float)
    number = np.isfinite(x)
    place = np.arange(1, len(x) + 1) / max(len(x), 1)
    rms = float(np.sqrt(np.mean(x[number] ** 2))) if number.any() else 0.0
    in_order = float(np.mean(x[number] * place[number])) if number.any() else 0.0
    words = "\n".join(cell for cell, is_number in zip(cells, number) if not is_number)
    return (str(file), column, len(x), f"{rms:.9g}", f"{in_order:.9g}", "" if number.all() else hashlib.sha256(words.encode()).hexdigest()[:12])


def columns_of(results):
    """A row a column, or a name of a JSON file: file, column, rows, rms, in_order, words."""
    rows = []
    for file in sorted(results.rglob("diagnosis.json")):
        by_name = {}
        for name, value in leaves(json.loads(file.read_text())):
            by_name.setdefault(name, []).append(str(value))
        rows += [row_of(file.relative_to(results), name, cells) for name, cells in by_name.items() if name not in NOT_HELD]
    for file in sorted(results.rglob("*.csv")):
        name = file.relative_to(results)
        if "records" in name.parts or name.parts[0] in SHOWN:
            continue
        table = pd.read_csv(file, keep_default_na=False, dtype=str)
        for column in table.columns:
            if column in NOT_COMPARED:
                continue
            rows.append(row_of(name, column, list(table[column])))
    return pd.DataFrame(rows, columns=["file", "column", "rows", "rms", "in_order", "words"])


def moved(held, found, tolerance=TOLERANCE):
    """Words for every column that is not where it was."""
    out = []
    key = ["file", "column"]
    both = held.merge(found, on=key, how="outer", suffixes=("", "_now"), indicator="where")
    scale = {(r.file, r.column): float(r.rms) for r in held.itertuples()}
    for row in both.itertuples():
        name = f"{row.file} {row.column}"
        if row.where != "both":
            out.append(f"{name} is {'gone' if row.where == 'left_only' else 'new'}")
            continue
        # An imaginary part is judged by the size of the whole number: beside a real one it may be rounding alone.
        # The square of a number below 1e-154 is zero, and so is the rms of a p-value there.
        size = max(float(row.rms), scale.get((row.file, row.column.removesuffix("_imag")), 0.0)) or abs(float(row.in_order))
        if row.rows != row.rows_now or row.words != row.words_now:
            out.append(f"{name} has other rows or words")
        elif any(abs(float(a) - float(b)) > tolerance * size for a, b in ((row.rms, row.rms_now), (row.in_order, row.in_order_now))):
            out.append(f"{name}: rms {row.rms} is {row.rms_now}, in order {row.in_order} is {row.in_order_now}")
    return out


def run(command):
    environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MAKELEVEL", "MFLAGS")}
    done = subprocess.run([str(word) for word in command], cwd=ROOT, capture_output=True, text=True, env=environment)
    if done.returncode:
        raise AssertionError(f"{command} failed with {done.returncode}:\n{done.stdout}\n{done.stderr}")


def smoke(results):
    run(["make", "--no-print-directory", "steps", "STUDY=smoke", "NO_BUILD=1", f"BIN={BIN}", f"RESULTS={results}"])


def diagnose(model, features, out, *settings):
    run([BIN / "s9_diagnosis", "--model", model, "--features", features, "--out", out, "--catalogue", "workflows/common/hypotheses",
         *(word for setting in settings for word in ("--set", setting))])


def diagnoses(folder, results):
    """A chain with a tie, by a model whose form is exact; a girder with a frozen bearing, by one whose form is not."""
    test_diagnosis.write_model(folder / "chain")
    test_diagnosis.write_features(folder / "tied", tie=(3, 6, 8e5))
    diagnose(folder / "chain", folder / "tied", results / "chain")
    at = test_diagnosis_form.write_model(folder / "girder")
    test_diagnosis_form.write_features(folder / "frozen", at, test_diagnosis_form.FROST, 2)
    diagnose(folder / "girder", folder / "frozen", results / "girder")


class HeldNumbers(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.results = self.folder / "results"

    def assert_held(self, name, least, tolerance=TOLERANCE):
        held, found = HELD / f"{name}.csv", columns_of(self.results)
        if os.environ.get("TWINDECK_HOLD"):
            found.to_csv(held, index=False)
        kept = pd.read_csv(held, dtype=str, keep_default_na=False).astype({"rows": int})
        self.assertGreater(len(kept), least)
        self.assertEqual(moved(kept, found, tolerance), [])

    def test_the_smoke_chain_is_where_it_was(self):
        smoke(self.results)
        self.assert_held("smoke", 700)

    def test_diagnoses_of_a_chain_and_a_girder_are_where_they_were(self):
        diagnoses(self.folder, self.results)
        self.assert_held("diagnoses", 200, OF_FITS)

    def test_a_diagnosis_of_the_smoke_chain_is_where_it_was(self):
        """Damped modes, stays and sixteen channels of the bridge, by an unrefined model that is far off."""
        smoke(self.folder / "chain")
        diagnose(self.folder / "chain/s4_refinement/model", self.folder / "chain/s3_identification/features", self.results / "bridge",
                 "sensor_tolerance=10 m", "names_alike=true", "zones=6", "nodes=4")
        self.assert_held("diagnosis_of_smoke", 100, OF_FITS)

    def test_a_moved_number_another_order_and_another_word_are_seen(self):
        def table(text):
            (self.folder / "modes.csv").write_text("mode,frequency_Hz\n" + text)
            return columns_of(self.folder)

        held = table("1,1.0\n2,2.0\nx,3.0\n")
        self.assertEqual(moved(held, table("1,1.0\n2,2.0\nx,3.0\n")), [])
        for other, column in (("1,1.0\n2,2.001\nx,3.0\n", "frequency_Hz"), ("1,2.0\n2,1.0\nx,3.0\n", "frequency_Hz"), ("1,1.0\n2,2.0\ny,3.0\n", "mode"),
                              ("1,1.0\n2,2.0\n", "mode"), ("1,-1.0\n2,2.0\nx,3.0\n", "frequency_Hz")):
            said = moved(held, table(other))
            self.assertTrue(any(column in line for line in said), other)


if __name__ == "__main__":
    unittest.main()
