"""`--correct FILE` of steps 4, 6 and 9, and the file that step 9 writes for it.

Oracles: features that were never wrong (a corrected folder gives the same numbers as they do); the faults that were put in; the contract
of corrections.toml. The chain and its features are those of test_diagnosis.py.
"""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import test_diagnosis as chain  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin"))


def faulty(y):
    """As recorded: c2 and c5 in each other's sockets, what stands under c2 upside down, and c7 reading 1.6 times what it should."""
    y = y.copy()
    y[[1, 4]] = y[[4, 1]]
    y[1] *= -1.0
    y[6] *= 1.6
    return y


ALL_THREE = ('[[correction]]\nchannel = "c2"\naction = "reverse"\n[[correction]]\nchannel = "c7"\naction = "scale"\nfactor = 0.625\n'
             '[[correction]]\nchannel = "c2"\naction = "exchange"\nwith = "c5"\n')


class OnAChain(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        chain.write_model(cls.folder / "model")
        chain.write_features(cls.folder / "right")
        chain.write_features(cls.folder / "wrong", channel=faulty, noise=0.0)
        chain.write_features(cls.folder / "right_too", noise=0.0)
        (cls.folder / "all_three.toml").write_text(ALL_THREE)

    def run_step(self, token, features, *arguments, out="out"):
        done = subprocess.run([BIN / token, "--model", self.folder / "model", "--features", self.folder / features, "--out", self.folder / out,
                               *(("--catalogue", ROOT / "workflows/common/hypotheses") if token.startswith("s9") else ()),
                               *map(str, arguments)], capture_output=True, text=True, check=False, cwd=ROOT)
        return done, self.folder / out

    def good(self, *arguments, **out):
        done, folder = self.run_step(*arguments, **out)
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder


class CorrectedFeatures(OnAChain):
    def rows(self, file):
        with open(file, newline="", encoding="utf-8") as stream:
            return list(csv.DictReader(stream))

    def test_are_those_that_were_never_wrong(self):
        wrong = self.rows(self.good("s4_refinement", "wrong", "--set", "least_paired=0", out="s4_wrong") / "mac.csv")
        for token, settings in (("s4_refinement", ()), ("s6_updating", ("--set", "parameters=['g4']"))):
            right = self.good(token, "right_too", *settings, out=token + "_right")
            mended = self.good(token, "wrong", "--correct", self.folder / "all_three.toml", *settings, out=token + "_mended")
            for a, b in zip(self.rows(right / "mac.csv"), self.rows(mended / "mac.csv")):
                self.assertAlmostEqual(float(a["mac"]), float(b["mac"]), places=7)
            if token == "s4_refinement":  # and the faults were no trifle
                self.assertGreater(max(abs(float(a["mac"]) - float(c["mac"])) for a, c in zip(self.rows(right / "mac.csv"), wrong)), 0.1)
            manifest = json.loads((mended / "manifest.json").read_text())
            self.assertEqual(manifest["corrections"], ["c2 reversed", "c7 multiplied by 0.625", "c2 and c5 exchanged"])
            self.assertTrue(any("all_three.toml" in name for name in manifest["inputs"]))
            self.assertNotIn("corrections", json.loads((right / "manifest.json").read_text()))

    def test_the_diagnosis_weighs_the_same_rows(self):
        """With its covariance, turned and scaled like the rows; standard deviations of a scaled channel are scaled too."""
        right = self.good("s9_diagnosis", "right_too", out="s9_right")
        mended = self.good("s9_diagnosis", "wrong", "--correct", self.folder / "all_three.toml", out="s9_mended")
        by_row = {(r["type"], r["mode"], r["channel"]): r for r in self.rows(mended / "residuals.csv")}
        for row in self.rows(right / "residuals.csv"):
            other = by_row[row["type"], row["mode"], row["channel"]]
            self.assertAlmostEqual(float(row["value"]), float(other["value"]), places=7)
            self.assertAlmostEqual(float(row["std"]) * (0.625 if row["channel"] == "c7" else 1.0), float(other["std"]), places=9)

    def test_modes_of_another_program_are_corrected_by_channel(self):
        folder = self.folder / "modes"
        folder.mkdir()
        rows = self.rows(self.folder / "wrong" / "rows.csv")
        (folder / "modes.csv").write_text("mode,frequency_Hz,frequency_std_Hz\n" + "".join(
            f'{r["mode"]},{r["value"]},{r["std"]}\n' for r in rows if r["type"] == "frequency_Hz"))
        (folder / "shapes.csv").write_text("mode,point,direction,value\n" + "".join(
            f'{r["mode"]},{r["channel"][1:]},{r["channel"]},{r["value"]}\n' for r in rows if r["type"] == "shape"))
        (folder / "channels.csv").write_text((self.folder / "wrong" / "channels.csv").read_text())
        done = subprocess.run([BIN / "s4_refinement", "--model", self.folder / "model", "--modes", folder, "--out", self.folder / "from_modes",
                               "--correct", self.folder / "all_three.toml"], capture_output=True, text=True, check=False, cwd=ROOT)
        self.assertEqual(done.returncode, 0, done.stderr)
        right = self.good("s4_refinement", "right_too", out="s4_right_again")
        for a, b in zip(self.rows(right / "mac.csv"), self.rows(self.folder / "from_modes" / "mac.csv")):
            self.assertAlmostEqual(float(a["mac"]), float(b["mac"]), places=7)
        done = subprocess.run([BIN / "s4_refinement", "--model", self.folder / "model", "--modes", folder, "--out", self.folder / "never",
                               "--condition", "calm"], capture_output=True, text=True, check=False, cwd=ROOT)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--condition", done.stderr)


class WhatIsWritten(OnAChain):
    def found(self, out):
        return json.loads((out / "diagnosis.json").read_text())

    def test_nothing_found_nothing_written(self):
        out = self.good("s9_diagnosis", "right", out="nothing")
        self.assertEqual(self.found(out)["measurement_corrections"], [])
        self.assertFalse((out / "corrections.toml").exists())

    def test_what_was_found_can_be_given_back(self):
        kinds = {"pol": (chain.changed(3, -1.0), {"channel": "c4", "action": "reverse", "with": ""}),
                 "swap": (chain.exchanged(1, 4), {"channel": "c2", "action": "exchange", "with": "c5"}),
                 "gain": (chain.changed(5, 1.4), {"channel": "c6", "action": "scale", "with": ""})}
        for name, (fault, expected) in kinds.items():
            chain.write_features(self.folder / name, channel=fault)
            out = self.good("s9_diagnosis", name, out=name + "_out")
            corrections = self.found(out)["measurement_corrections"]
            self.assertEqual([{key: c[key] for key in expected} for c in corrections], [expected])
            self.assertAlmostEqual(corrections[0]["factor"], 1 / 1.4 if name == "gain" else 1.0, delta=0.04)
            again = self.good("s9_diagnosis", name, "--correct", out / "corrections.toml", out=name + "_again")
            self.assertEqual(self.found(again)["verdict"], "none", self.found(again)["message"])
            self.assertEqual(self.found(again)["measurement_corrections"], [])

    def test_two_faults_are_both_offered(self):
        def fault(y):
            return chain.changed(6, -1.0)(chain.exchanged(1, 4)(y))
        chain.write_features(self.folder / "both", channel=fault)
        out = self.good("s9_diagnosis", "both", out="both_out")
        actions = [c["action"] for c in self.found(out)["measurement_corrections"]]
        self.assertEqual(sorted(actions), ["exchange", "reverse"], self.found(out)["message"])
        again = self.good("s9_diagnosis", "both", "--correct", out / "corrections.toml", out="both_again")
        self.assertEqual(self.found(again)["verdict"], "none", self.found(again)["message"])

    def test_a_second_run_adds_to_the_first(self):
        given = self.folder / "given.toml"
        given.write_text('[[correction]]\nchannel = "c3"\naction = "reverse"\n')
        def fault(y):
            return chain.changed(2, -1.0)(chain.exchanged(5, 7)(y))
        chain.write_features(self.folder / "more", channel=fault)
        out = self.good("s9_diagnosis", "more", "--correct", given, out="more_out")
        self.assertEqual([c["channel"] for c in self.found(out)["measurement_corrections"]], ["c6"])
        text = (out / "corrections.toml").read_text()
        self.assertIn('"c3"', text)
        again = self.good("s9_diagnosis", "more", "--correct", out / "corrections.toml", out="more_again")
        self.assertEqual(self.found(again)["verdict"], "none")

    def test_a_wrong_correction_is_taken_back(self):
        given = self.folder / "mistaken.toml"
        given.write_text('[[correction]]\nchannel = "c3"\naction = "reverse"\n')
        out = self.good("s9_diagnosis", "right", "--correct", given, out="mistaken_out")
        self.assertEqual([c["channel"] for c in self.found(out)["measurement_corrections"]], ["c3"])
        self.assertNotIn("[[correction]]", (out / "corrections.toml").read_text())


class Refusals(OnAChain):
    CASES = [('[[correction]]\nchannel = "c33"\naction = "reverse"\n', ("wrong.toml:1: channel", "c33", "c3")),
             ('[[correction]]\nchannel = "c3"\naction = "revers"\n', ("wrong.toml:3: action", "revers", "reverse, exchange, scale")),
             ('[[correction]]\nchannel = "c3"\naction = "scale"\n', ("wrong.toml:1: factor", "missing")),
             ('[[correction]]\nchannel = "c3"\naction = "scale"\nfactor = -2\n', ("wrong.toml:4: factor", "-2")),
             ('[[correction]]\nchannel = "c3"\naction = "exchange"\n', ("with", "missing")),
             ('[[correction]]\nchannel = "c3"\naction = "exchange"\nwith = "c3"\n', ("with", "itself")),
             ('[[correction]]\nchannel = "c3"\naction = "exchange"\nwith = "x"\n', ("with", "'x'")),
             ('[[correction]]\nchannel = "c3"\naction = "reverse"\nwith = "c4"\n', ("with", "exchange")),
             ('[[correction]]\naction = "reverse"\n', ("channel", "missing")),
             ('[[correction]]\nchannel = "c3"\n', ("action", "missing")),
             ('[[correction]]\nchannel = "c3"\naction = "reverse"\nby = 2\n', ("wrong.toml:4: by",)),
             ('[[correction]]\nchannel = "c3"\naction = "reverse"\n' * 2, ("twice",)),
             ('corrections = 1\n', ("wrong.toml:1: corrections",)),
             ("", ("[[correction]]",))]

    def test_one_clear_line_and_nothing_written(self):
        file = self.folder / "wrong.toml"
        for token in ("s4_refinement", "s6_updating", "s9_diagnosis"):
            for text, words in self.CASES if token == "s4_refinement" else self.CASES[:3]:
                file.write_text(text)
                done, out = self.run_step(token, "right", "--correct", file, out="never")
                self.assertEqual(done.returncode, 2, (text, done.stderr))
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
                self.assertFalse(out.exists())
                for word in words:
                    self.assertIn(word, done.stderr)

    def test_a_file_that_is_not_there(self):
        done, _ = self.run_step("s6_updating", "right", "--correct", self.folder / "nowhere.toml", out="never")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--correct: ", done.stderr)


if __name__ == "__main__":
    unittest.main()
