"""The scorer of the virtual campaign's diagnosis.

Oracle: a made-up campaign with two makes of dampers and two stays, and answers written by hand: right, one of a set, under the verdict unknown, wrong,
none; and a campaign whose truth is not there.
"""
import copy
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
SCORER = ROOT / "tests/steps/diagnosis_score.py"
IMPOSED = '''vibrating_stays = ["NE5", "NE7"]
[[damper]]
type = "A"
friction = "100 N"
[[damper]]
type = "C"
friction = "500 N"
mount_stiffness = "10 MN/m"
'''
DAMPERS = '''condition,damper,rms_force_N,sliding_pct,equivalent_slip_m_per_N_s
calm,A1,50,0,0
calm,A2,50,0,0
calm,C1,80,0,0
calm,C2,80,0,0
windy,A1,90,0,0
windy,A2,90,0,0
windy,C1,700,72,0
windy,C2,700,68,0
storm,C1,900,91,0
storm,C2,900,90,0
'''
FRICTION = {"cause": "fric", "location": "dampers:C1,C2", "cluster": ["fric@dampers:C1,C2"], "probability": 0.97, "sentence": "The dampers C1 and C2 stick.",
            "parameters": [{"name": "Fc_N", "value": 434.0, "low": 181.0, "high": 608.0}, {"name": "k_lock_N_m", "value": 5.4e6, "low": 4.7e6, "high": 6.4e6}]}
WRONG = {"cause": "mass", "location": "node:7", "cluster": ["mass@node:7"], "probability": 0.9, "sentence": "A mass.", "parameters": []}


class Score(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        for part, name, text in (("campaign/truth", "dampers.csv", DAMPERS), (".", "imposed.toml", IMPOSED)):
            (self.folder / part).mkdir(parents=True, exist_ok=True)
            (self.folder / part / name).write_text(text)
        (self.folder / "s9").mkdir()
        (self.folder / "s9/residuals.csv").write_text("type,mode,condition\nfrequency_Hz,1,calm\nfrequency_Hz,1,windy\n")

    def run_scorer(self, *effects, verdict="named"):
        told = {"verdict": verdict, "effects": list(effects), "gain": {"rows": 4, "reduction_pct": 11.0}}
        (self.folder / "s9/diagnosis.json").write_text(json.dumps(told))
        done = subprocess.run([sys.executable, SCORER, "--campaign", self.folder / "campaign", "--imposed", self.folder / "imposed.toml", "--diagnosis",
                               self.folder / "s9", "--out", self.folder / "score"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads((self.folder / "score/score.json").read_text())

    def test_what_is_named_is_scored_with_its_sizes(self):
        score = self.run_scorer(FRICTION)
        self.assertTrue(score["scored"])
        self.assertEqual([h["answer"] for h in score["hidden"]], ["named", "missed", "missed"])
        right = score["hidden"][0]
        self.assertIn("C1 and C2 stand still below 500 N each, held by mounts of 10 MN/m; they slide 72 % of the time in windy", right["what"])
        self.assertIn("they slide at no time", score["hidden"][1]["what"])
        self.assertEqual([(s["name"], s["truth"], s["value"], s["inside"]) for s in right["sizes"]],
                         [("Fc_N", 500.0, 434.0, True), ("k_lock_N_m", 1e7, 5.4e6, False)])
        self.assertEqual((score["not_hidden"], score["gain"]["reduction_pct"]), ([], 11.0))
        self.assertEqual(score["diagnosis_sha256"], hashlib.sha256((self.folder / "s9/diagnosis.json").read_bytes()).hexdigest())

    def test_each_kind_of_answer(self):
        in_set = copy.deepcopy(FRICTION) | {"cluster": ["fric@dampers:C1,C2", "mass@node:7"]}
        behind = copy.deepcopy(WRONG) | {"cluster": ["mass@node:7", "fric@dampers:C1,C2"]}
        mount = {**copy.deepcopy(FRICTION), "cause": "dampk", "cluster": ["dampk@dampers:C1,C2"]}
        for effects, verdict, answer, wrong in (([in_set], "ambiguous", "in the set", []), ([behind], "ambiguous", "in the set", []),
                                                ([mount], "named", "another cause at the same place", []),
                                                ([FRICTION], "unknown", "found, under the verdict unknown", []),
                                                ([WRONG], "named", "missed", ["A mass"]), ([], "none", "missed", [])):
            with self.subTest(answer=answer, verdict=verdict):
                score = self.run_scorer(*effects, verdict=verdict)
                self.assertEqual(score["hidden"][0]["answer"], answer)
                self.assertEqual(score["not_hidden"], wrong)

    def test_stays_that_vibrate_are_a_cause(self):
        bars = {"cause": "barstays", "location": "global", "cluster": ["barstays@global"], "probability": 0.9, "sentence": "s", "parameters": []}
        self.assertEqual([h["answer"] for h in self.run_scorer(FRICTION, bars)["hidden"]], ["named", "missed", "named"])

    def test_without_a_truth_nothing_is_scored_and_nothing_fails(self):
        (self.folder / "campaign/truth/dampers.csv").unlink()
        score = self.run_scorer(FRICTION)
        self.assertFalse(score["scored"])
        self.assertNotIn("hidden", score)


class Rules(unittest.TestCase):
    """Oracle: what make says that it would run, with everything taken as out of date."""

    def dry(self, *goals):
        environment = {k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
        done = subprocess.run(["make", "-n", "-B", "NO_BUILD=1", f"BIN={BIN}", *goals], cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_all_diagnoses_and_scores_the_virtual_campaign_before_the_report(self):
        said = self.dry("all", "STUDY=ponte_del_mare")
        order = [said.index(part) for part in ("s3_identification --study", "s9_diagnosis --study workflows/ponte_del_mare_virtual", "diagnosis_score.py",
                                               "twindeck_report report")]
        self.assertEqual(order, sorted(order))
        self.assertIn("s9_diagnosis --study workflows/ponte_del_mare --", said)
        self.assertEqual(said.count("s9_diagnosis --study workflows/ponte_del_mare_virtual"), 1)

    def test_a_study_without_one_has_nothing_to_score(self):
        self.assertNotIn("diagnosis_score.py", self.dry("all", "STUDY=template"))


class OnlyTheScorerReadsTheTruth(unittest.TestCase):
    def test_no_source_of_the_chain_names_the_truth_folder(self):
        """Of C++, report and rules; the step that writes it, and the list of columns, excepted."""
        allowed = ("src/steps/campaign/", "paper/twindeck_reference/")
        found = []
        for part in ("src", "paper", "workflows", "Makefile"):
            root = ROOT / part
            for file in [root] if root.is_file() else root.rglob("*"):
                name = file.relative_to(ROOT).as_posix()
                if file.suffix not in ("", ".cpp", ".hpp", ".py", ".mk", ".sh", ".toml") or not file.is_file() or name.startswith(allowed):
                    continue
                if any(mark in file.read_text(encoding="utf-8") for mark in ('"truth"', '/ "truth', "truth/")):
                    found.append(name)
        self.assertEqual(found, [])


if __name__ == "__main__":
    unittest.main()
