"""FORM and subset simulation on the published problems of the unit tests: ours against OpenTURNS, same run, same limit states.

    python3 tests/bench/reliability.py BIN GUIDE [RUNS]

writes the table of values, calls and ratios into the guide (docs/reliability.md), between its two marks; tests/steps/test_reliability_peers.py and
tests/unit/reliability/published_problems_test.cpp hold it. tests/bench/run.py asks for the rows of `make bench`. Without OpenTURNS (Debian:
python3-openturns) they are left out, and a line says so. FORM starts at the mean alone on both sides; subset simulation has 2000 samples a level and a level share of 0.1. Limit states are compiled on our side and OpenTURNS'
own symbolic functions on theirs, so that calls compare methods and seconds compare programs.
"""
import math
import pathlib
import statistics
import subprocess
import sys
import time

import table

LEVEL, SHARE, SUBSET_RUNS = 2000, 0.1, 20
LARGEST_ERROR = 1e-3  # of the limit state at a design point, which is 1 to 16 at the medians
SPREAD = math.sqrt(math.log1p(0.01))  # of the logarithm of the beam's strength, whose coefficient of variation is 0.1
E = "0.1*(u0-u1)^2", "(u0+u1)/sqrt(2)", "7/sqrt(2)"
# name -> (limit state in OpenTURNS' words, dimension, published probability)
PROBLEMS = {
    "R-S": ("5+u0-u1", 2, 0.5 * math.erfc(5 / 2)),
    "four_branches": (f"min(min(3+{E[0]}-{E[1]},3+{E[0]}+{E[1]}),min(u0-u1+{E[2]},u1-u0+{E[2]}))", 2, 2.2228e-3),
    "beam": (f"{math.exp(-0.5 * SPREAD**2)}*exp({SPREAD}*u0)-({750 / 3e6 / math.pi * 1e4}+{50 / 3e6 / math.pi * 1e4}*u1)", 2, 0.029198),
    "RP22": (f"2.5-{E[1]}+{E[0]}", 2, 4.2073e-3),
    "RP25": ("max(u0^2-8*u1+16,-16*u0+u1+32)", 2, 4.1486e-5),
    "RP31": ("2-u1+256*u0^4", 2, 3.2267e-3),
    **{f"linear_{n}": (None, n, 0.5 * math.erfc(3.5 / math.sqrt(2))) for n in (2, 20, 200)},
    "RP107": (None, 10, 2.8665e-7)}


def limit_state(ot, name):
    words, n, _ = PROBLEMS[name]
    names = [f"u{i}" for i in range(n)]
    if words is None:
        words = f"{5.0 if name == 'RP107' else 3.5}-({'+'.join(names)})/sqrt({n})"
    g = ot.SymbolicFunction(names, [words])
    g.setGradient(ot.CenteredFiniteDifferenceGradient(ot.ConstantStep([1e-4] * n), g.getEvaluation()))  # as ours, so that calls compare
    return g, n


def theirs(ot, name, method, runs):
    """(probability, calls, median seconds) of `runs` runs; of subset simulation the mean of SUBSET_RUNS; None where the search fails."""
    seconds, probabilities, calls = [], [], []
    for run in range(SUBSET_RUNS if method == "subset" else runs):
        ot.RandomGenerator.SetSeed(run + 1)
        g, n = limit_state(ot, name)
        vector = ot.RandomVector(ot.Normal(n))
        event = ot.ThresholdEvent(ot.CompositeRandomVector(g, vector), ot.LessOrEqual(), 0.0)
        started = time.process_time()
        try:
            if method == "form":
                algorithm = ot.FORM(ot.AbdoRackwitz(), event, [0.0] * n)
                algorithm.run()
                if algorithm.getResult().getOptimizationResult().getConstraintError() > LARGEST_ERROR:
                    return None  # it stopped beside the limit
                probability = algorithm.getResult().getEventProbability()
            else:
                algorithm = ot.SubsetSampling(event)
                algorithm.setMaximumOuterSampling(LEVEL)
                algorithm.setBlockSize(1)
                algorithm.setConditionalProbability(SHARE)
                algorithm.run()
                probability = algorithm.getResult().getProbabilityEstimate()
        except RuntimeError:
            return None
        seconds.append(time.process_time() - started)
        probabilities.append(probability)
        calls.append(g.getEvaluationCallsNumber())
    return statistics.fmean(probabilities), int(statistics.fmean(calls)), statistics.median(seconds)


NO_END = "does not converge"


def told(result):
    return f"{result[0]:.4e}" if result else NO_END


def compared(binaries, runs):
    """One entry a problem and method: what is published, ours and theirs; None without OpenTURNS."""
    ot = peer()
    if ot is None:
        return None
    lines = subprocess.run([binaries / "bench_reliability", str(runs)], check=True, capture_output=True, text=True).stdout.splitlines()
    out = []
    for name, method, probability, calls, seconds in (line.split() for line in lines):
        found = theirs(ot, name, method, runs)
        ours = float(probability), int(calls), float(seconds)
        out.append({"problem": name, "method": method, "published": PROBLEMS[name][2], "ours": ours if ours[0] > 0.0 else None, "calls": ours[1], "theirs": found})
    return out


def peer():
    try:
        import openturns as ot
    except ImportError:
        return None
    ot.Log.Show(ot.Log.NONE)
    ot.TBB.Disable()
    return ot


def rows(binaries, runs):
    found = compared(binaries, runs)
    if found is None:
        print("bench: OpenTURNS is not here (apt-get install python3-openturns): reliability is left out", file=sys.stderr)
        return []
    out = []
    for entry in found:
        ours, other = entry["ours"], entry["theirs"]
        part = f"reliability: {entry['problem']}, {entry['method']} (published {entry['published']:.4e}, ours {told(ours)}, OpenTURNS {told(other)})"
        if ours and other:
            out += [table.row(part, "calls of the limit state", float(ours[1]), "calls", float(other[1]), "OpenTURNS"),
                    table.row(part, "processor time", ours[2], "s", other[2], "OpenTURNS, symbolic functions")]
        else:
            out.append(table.row(part, "calls of the limit state", float(entry["calls"]), "calls", beside="one of the two does not converge"))
    return out


MARKS = "<!-- peers -->\n", "<!-- end of peers -->"
HEAD = ("problem", "method", "published", "twindeck", "OpenTURNS", "calls", "calls, OpenTURNS", "processor seconds, OpenTURNS over twindeck")


def guide_table(found):
    lines = [f"| {' | '.join(HEAD)} |", "|---|---|" + "---:|" * (len(HEAD) - 2)]
    for entry in found:
        ours, other = entry["ours"], entry["theirs"]
        cells = [entry["problem"], entry["method"], f"{entry['published']:.4e}", told(ours), told(other), str(ours[1]) if ours else "", str(other[1]) if other else "",
                 f"{float(f'{other[2] / ours[2]:.1g}'):.0f}" if ours and other else ""]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main():
    binaries, guide = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    found = compared(binaries, int(sys.argv[3]) if len(sys.argv) > 3 else 5)
    if found is None:
        sys.exit("reliability.py: OpenTURNS is not here: apt-get install python3-openturns")
    before, rest = guide.read_text(encoding="utf-8").split(MARKS[0])
    guide.write_text(before + MARKS[0] + guide_table(found) + MARKS[1] + rest.split(MARKS[1])[1], encoding="utf-8")


if __name__ == "__main__":
    main()
