"""Steps 0 and 3 of the study, scored: Table 4 in each state, Table 5, free decays, dampers that begin to slide.

Oracle: the truth folder of the virtual campaign (campaign_score.py says what counts as found), the closed-form expectations of each test.
One campaign is one draw of half hours of noise. LIMITS hold what the method can do: each is passed by 999 campaigns of 1,000, by what 30
campaigns gave (seeds 201 to 230, none of them looked at before). The rates themselves are held over 30 campaigns, with TWINDECK_SLOW=1.
With TWINDECK_SLOW=1 also 30 campaigns of other seeds: calibration of the standard deviations, recall, the paper's own rule beside the
automatic one; what they show is written to results/scoring/ as CSV and figure, seed by seed: a run that was broken off goes on.
"""
import hashlib
import json
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import campaign_score  # noqa: E402
from campaign_score import rows  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("TWINDECK_BIN", ROOT / "build" / "bin")).resolve()
STUDY = ROOT / "workflows" / "ponte_del_mare_virtual"
SCORING = ROOT / "results" / "scoring"
KERNELS = "Haswell"  # of OpenBLAS, which steps take (src/runner/threads.cpp)
STATES = ("without_dampers", "with_dampers", "with_dampers_high")
# Behind each limit: what the 30 campaigns gave, and the law by which one in a thousand exceeds the limit.
LIMITS = {
    # Named modes lost: 2 in 30 campaigns without dampers, 2 with, 24 on the windy day (modes 6 and 8 above all, whose damping of some
    # 3 % half an hour hardly settles). Poisson.
    "lost": {"without_dampers": 2, "with_dampers": 2, "with_dampers_high": 5},
    # Modes that are none: 2, 1 and 6 in 30 campaigns. Poisson.
    "spurious": {"without_dampers": 2, "with_dampers": 2, "with_dampers_high": 3},
    # Harmonics of stays: one of 900 was not found, the worst of the others was 0.47 % off.
    "stay_harmonics_lost": 1, "stay_frequency": 0.008,
    # Intervals of 99 % that miss: 2 of 180. Poisson.
    "stay_intervals_missed": 2,
    # ERA against SSI, and against the truth, in standard deviations: 482 and 392 values, largest 3.8 and 4.0. Student's law of 30 blocks.
    "decay": 5.0,
    # From the calm to the windy day, in standard deviations of the change (mean, deviation of 30): frequency of mode 1 -1.0, 0.6; its
    # damping 4.4, 1.0; frequency of mode 7 -0.7, 0.8. Normal.
    "mode_1_frequency_rises": 1.0, "mode_1_damping_rises": 1.0, "mode_7_frequency_moves": 3.2,
    # Of 8 dampings that are compared 5 to 9 rise, 83 % in the mean. Binomial.
    "share_of_dampings_that_rise": 1.0 / 3.0,
}


def run(step, *arguments):
    done = subprocess.run(["nice", "-n", "5", BIN / step, *map(str, arguments), "--quiet"], cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(done.stderr)


def of_the_study():
    """The study's results, where make says that steps 0 and 3 of these executables are up to date there (`make test` runs them first). Under
    other kernels (make processors) they are not this test's."""
    if os.environ.get("OPENBLAS_CORETYPE", KERNELS) != KERNELS or BIN != (ROOT / "build" / "bin").resolve():
        return None
    folder = pathlib.Path("results") / STUDY.name
    asked = ["make", "-q", "NO_BUILD=1", f"STUDY={STUDY.name}", f"RESULTS={folder}", f"{folder}/s3_identification/manifest.json"]
    done = subprocess.run(asked, cwd=ROOT, capture_output=True, env={k: v for k, v in os.environ.items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")})
    return ROOT / folder if done.returncode == 0 else None


def covered_intervals(truth, fitted):
    """(stay and quantity, error in standard deviations, whether the interval holds the truth) of the stays that are strings: with sleeves no
    string has the printed frequencies."""
    out = []
    for r in fitted:
        t = truth[r["condition"], r["stay"]]
        if not t["lambda_squared"]:
            continue
        quantile = statistics.NormalDist().inv_cdf(0.5 + 0.5 * float(r["level"]))
        for column, value in (("tension_per_mass{}_m2_s2", float(t["pull_per_mass_m2_s2"])), ("lambda_squared{}", float(t["lambda_squared"]))):
            low, middle, high = (float(r[column.format(part)]) for part in ("_low", "", "_high"))
            deviation = (middle - low if value < middle else high - middle) / quantile
            out.append((f"{r['stay']} {column.format('')}", (middle - value) / deviation, low <= value <= high))
    return out


class Study(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        results = of_the_study()
        if results is None:
            results = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
            for step in ("s0_campaign", "s3_identification"):
                run(step, "--study", STUDY, "--results", results, "--out", results / step, "--threads", 2)
        cls.campaign, cls.out = results / "s0_campaign", results / "s3_identification"
        cls.scores = {state: campaign_score.score(cls.campaign, cls.out, state, state == STATES[0]) for state in STATES}

    def test_named_modes_are_found_within_their_limits(self):
        # The tenth mode leaves the tests' range when the dampers' anchorages hold it (3.4 Hz): nine are left below 2.6 Hz.
        for state, named in (("without_dampers", 10), ("with_dampers", 9), ("with_dampers_high", 9)):
            with self.subTest(state):
                score = self.scores[state]
                self.assertEqual(len(score.named), named)
                self.assertLessEqual(named - len(score.good), LIMITS["lost"][state], [m for m in score.named if not m.good])

    def test_little_else_below_2_6_Hz(self):
        for state in STATES:
            self.assertLessEqual(len(self.scores[state].spurious), LIMITS["spurious"][state], self.scores[state].spurious)

    def test_stays(self):
        truth = {(r["condition"], r["stay"]): r for r in rows(self.campaign / "truth" / "stays.csv")}
        found = rows(self.out / "stays.csv")
        self.assertGreaterEqual(len(found), 30 - LIMITS["stay_harmonics_lost"])  # 6 x 5 harmonics
        for r in found:
            f = float(truth[r["condition"], r["stay"]][f"f{r['harmonic']}_Hz"])
            self.assertLess(abs(float(r["frequency_Hz"]) / f - 1.0), LIMITS["stay_frequency"], r)
        covered = covered_intervals(truth, rows(self.out / "stay_tensions.csv"))
        self.assertEqual(len(covered), 6)
        missed = [name for name, error, holds in covered if not holds]
        self.assertLessEqual(len(missed), LIMITS["stay_intervals_missed"], missed)

    def test_free_decays_agree_with_ambient_records(self):
        """ERA against SSI without dampers, the structure being linear: frequencies of the modes that both find, by the standard deviation of
        their difference, and of ERA's own from a true mode; with dampers a decay starts where they slide."""
        found = [r for r in rows(self.out / "decays.csv") if r["condition"] == "without_dampers"]
        both = [r for r in found if r["ambient_mode"]]
        self.assertGreaterEqual(len(both), 12)
        for r in both:
            deviation = math.hypot(float(r["frequency_std_Hz"]), float(r["ambient_frequency_std_Hz"]))
            self.assertLess(abs(float(r["frequency_Hz"]) - float(r["ambient_frequency_Hz"])), LIMITS["decay"] * deviation, r)
        true = [float(r["frequency_Hz"]) for r in rows(self.campaign / "truth" / "modes.csv") if r["condition"] == "without_dampers"]
        for r in (r for r in found if float(r["frequency_Hz"]) < campaign_score.BAND_HZ):
            self.assertLess(min(abs(float(r["frequency_Hz"]) - f) for f in true), LIMITS["decay"] * float(r["frequency_std_Hz"]), r)

    def test_dampers_that_begin_to_slide(self):
        """Mode 1, which the dampers hold: from the calm to the windy day its damping rises by more than the data leave open and its frequency
        does not; mode 7, which they hardly touch, keeps its frequency."""
        calm, windy = ({m.name: m.found for m in self.scores[s].named if m.found} for s in ("with_dampers", "with_dampers_high"))

        def change(name, value, deviation):
            return (windy[name][value] - calm[name][value]) / math.hypot(windy[name][deviation], calm[name][deviation])
        self.assertLess(change("1", "frequency_Hz", "frequency_std_Hz"), LIMITS["mode_1_frequency_rises"])
        self.assertGreater(change("1", "damping_ratio_pct", "damping_ratio_std_pct"), LIMITS["mode_1_damping_rises"])
        self.assertLess(abs(change("7", "frequency_Hz", "frequency_std_Hz")), LIMITS["mode_7_frequency_moves"])
        names = [n for n in calm if n in windy]
        rises = sum(windy[n]["damping_ratio_pct"] > calm[n]["damping_ratio_pct"] for n in names)
        self.assertGreater(rises, LIMITS["share_of_dampings_that_rise"] * len(names))


@unittest.skipUnless(os.environ.get("TWINDECK_SLOW") == "1", "TWINDECK_SLOW=1 identifies 30 campaigns (about ten minutes on two idle cores)")
class Seeds(unittest.TestCase):
    SEEDS = range(111, 141)  # none that a setting was ever looked at with

    def test_deviations_are_calibrated_and_modes_found(self):
        of_seed = {}
        with tempfile.TemporaryDirectory() as folder:
            workflow = shortened_campaign(pathlib.Path(folder), of_two_states)
            for seed in self.SEEDS:
                of_seed[seed] = kept(f"{seed}", lambda: self.scored(seed, workflow, pathlib.Path(folder)))
                write("identification_recall", "seed,state,selection,named,found,lost,spurious", of_seed, "recall")
                write("identification_errors", "seed,state,mode,frequency_error,damping_error", of_seed, "errors")
        lines = [line for one in of_seed.values() for line in one["recall"]]
        errors = np.array([e[3:] for one in of_seed.values() for e in one["errors"]])
        deviation = dict(zip(("frequency", "damping"), errors.std(axis=0)))
        draw(errors, deviation, SCORING / "identification_errors.png")

        def mean(state, selection, column):
            return np.mean([line[column] for line in lines if line[1:3] == [state, selection]])
        for state in STATES[:2]:
            for selection in ("automatic", "paper"):
                print(state, selection, "found", mean(state, selection, 4), "spurious", mean(state, selection, 6))
        print("standard deviation of normalised errors", deviation)
        for what, value in deviation.items():
            self.assertTrue(0.8 <= value <= 1.25, (what, value))
        # A damping error beyond three standard deviations from 30 blocks happens to one mode in 180 (Student's law), to twice as many where
        # stays' modes lie within the bandwidth: one row of Table 4 in forty may fail, over all campaigns.
        self.assertGreaterEqual(mean(STATES[0], "automatic", 4), 9.75)
        self.assertGreaterEqual(mean(STATES[1], "automatic", 4), 8.75)
        self.assertLessEqual(np.mean([mean(state, "automatic", 6) for state in STATES[:2]]), 0.1)

    @staticmethod
    def scored(seed, workflow, folder):
        given = os.environ.get("TWINDECK_CAMPAIGNS")  # folder with campaigns already made, cSEED/s0_campaign
        results = pathlib.Path(given) / f"c{seed}" if given else folder / str(seed)
        if not (results / "s0_campaign" / "manifest.json").exists():
            run("s0_campaign", "--study", workflow, "--out", results / "s0_campaign", "--threads", 2, "--seed", seed)
        recall, errors = [], []
        for selection in ("automatic", "paper"):
            identified = folder / "identified" / selection
            run("s3_identification", "--study", STUDY, "--campaign", results / "s0_campaign", "--out", identified, "--threads", 2,
                "--set", f"selection={selection}")
            for state in STATES[:2]:
                score = campaign_score.score(results / "s0_campaign", identified, state, state == STATES[0])
                lost = " ".join(m.name for m in score.named if not m.good)
                recall.append([seed, state, selection, len(score.named), len(score.good), lost, len(score.spurious)])
                if selection == "automatic":
                    errors += [[seed, state, m.name, m.frequency_error, m.damping_error] for m in score.named if m.found]
        if not given:
            shutil.rmtree(results)
        return {"recall": recall, "errors": errors}

    def test_intervals_of_stays_hold_as_often_as_they_say(self):
        of_seed = {}
        with tempfile.TemporaryDirectory() as folder:
            workflow = shortened_campaign(pathlib.Path(folder), of_stays)
            for seed in self.SEEDS:
                of_seed[seed] = kept(f"stays_{seed}", lambda: self.stays_scored(seed, workflow, pathlib.Path(folder)))
                write("stay_intervals", "seed,quantity,error,holds", of_seed, "intervals")
        errors = np.array([line[2] for one in of_seed.values() for line in one["intervals"]])
        holds = np.mean([line[3] for one in of_seed.values() for line in one["intervals"]])
        print("stays: intervals of 95 % that hold the truth", holds, "standard deviation of normalised errors", errors.std())
        self.assertEqual(len(errors), 6 * len(self.SEEDS))
        # Of 180 intervals 171 +- 3 hold; tension and sag of one stay go together, which widens that to 4: 159 is three deviations down.
        self.assertGreaterEqual(holds, 159 / 180)
        self.assertTrue(0.8 <= errors.std() <= 1.25, errors.std())
        self.assertLess(max(one["largest_frequency_error"] for one in of_seed.values()), 0.005)

    @staticmethod
    def stays_scored(seed, workflow, folder):
        run("s0_campaign", "--study", workflow, "--out", folder / "s0_campaign", "--threads", 2, "--seed", seed)
        # The short ambient record is there because a campaign has one; it is read with few block rows.
        run("s3_identification", "--study", STUDY, "--campaign", folder / "s0_campaign", "--out", folder / "identified", "--threads", 2,
            "--set", 'setups=["ST1"]', "--set", "block_rows=12", "--set", "maximum_order=20", "--set", "stay.level=0.95")
        truth = {(r["condition"], r["stay"]): r for r in rows(folder / "s0_campaign" / "truth" / "stays.csv")}
        largest = max(abs(float(r["frequency_Hz"]) / float(truth[r["condition"], r["stay"]][f"f{r['harmonic']}_Hz"]) - 1.0)
                      for r in rows(folder / "identified" / "stays.csv"))
        covered = covered_intervals(truth, rows(folder / "identified" / "stay_tensions.csv"))
        return {"intervals": [[seed, name, error, int(holds)] for name, error, holds in covered], "largest_frequency_error": largest}


def kept(name, work):
    """What `work` makes; if it was made before by the same sources and settings, that. So a run that was broken off goes on."""
    file, stamp = SCORING / "seeds" / f"{name}.json", stamp_of_what_decides()
    if file.exists() and (before := json.loads(file.read_text()))["stamp"] == stamp:
        return before
    done = {"stamp": stamp, **work()}
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(done))
    return done


def write(name, header, of_seed, part):
    """Table of the seeds so far, which the report shows."""
    lines = [",".join(f"{v:.4f}" if isinstance(v, float) else str(v) for v in row) for one in of_seed.values() for row in one[part]]
    (SCORING / f"{name}.csv").write_text("\n".join([header, *lines]) + "\n")


def stamp_of_what_decides():
    """Of the sources and settings that campaign, identification and score are made by."""
    content = hashlib.sha256()
    folders = ("src/signal", "src/records", "src/identification", "src/ponte/virtual_bridge", "src/steps/identification",
               "src/steps/campaign")
    files = [f for folder in folders for f in sorted((ROOT / folder).glob("*.?pp"))]
    for file in [*files, STUDY / "s0_campaign.toml", STUDY / "s3_identification.toml", pathlib.Path(campaign_score.__file__)]:
        content.update(file.read_bytes())
    return content.hexdigest()


def of_two_states(block):
    """The ambient records of the first two states and the stays."""
    return not (block.startswith("[[record]]") and ("kind" in block or 'setup = "M"' in block or "with_dampers_high" in block))


def of_stays(block):
    """The stays alone."""
    return not block.startswith("[[record]]")


def shortened_campaign(folder, wanted):
    """The study's settings with the records that are wanted; where no ambient one is, a short one."""
    workflow = folder / "workflow"
    workflow.mkdir()
    for file in STUDY.iterdir():
        if file.is_file():
            shutil.copy(file, workflow)
    blocks = [b for b in re.split(r"(?m)^(?=\[)", (STUDY / "s0_campaign.toml").read_text()) if wanted(b)]
    if not any(b.startswith("[[record]]") for b in blocks):
        blocks.append('[[record]]\nsetup = "ST1"\ncondition = "without_dampers"\nduration = "200 s"\n')
    (workflow / "s0_campaign.toml").write_text("".join(blocks))
    return workflow


def draw(errors, deviation, file):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 2, figsize=(8, 3), sharey=True)
    x = np.linspace(-4, 4, 200)
    for axis, own, what in zip(axes, errors.T, ("frequency", "damping")):
        axis.hist(own, bins=np.arange(-4, 4.1, 0.4), density=True, color="0.75")
        axis.plot(x, np.exp(-x**2 / 2) / math.sqrt(2 * math.pi), color="C0")
        axis.set_title(f"{what}: {len(errors)} errors, standard deviation {deviation[what]:.2f}", fontsize=9)
        axis.set_xlabel("error / standard deviation")
    figure.tight_layout()
    figure.savefig(file, dpi=120)


if __name__ == "__main__":
    unittest.main()
