"""FORM and subset simulation on the published problems of the unit tests: ours against OpenTURNS, same run, same limit states.

Run by tests/bench/run.py; without OpenTURNS (Debian: python3-openturns) its rows are left out, and a line says so. FORM starts at the mean
alone on both sides; subset simulation has 2000 samples a level and a level share of 0.1. Limit states are compiled on our side and OpenTURNS'
own symbolic functions on theirs, so that calls compare methods and seconds compare programs. Prints the table of values beside.
"""
import math
import statistics
import subprocess
import sys
import time

import table

LEVEL, SHARE = 2000, 0.1
E = "0.1*(u0-u1)^2", "(u0+u1)/sqrt(2)", "7/sqrt(2)"
# name -> (limit state in OpenTURNS' words, dimension, published probability)
PROBLEMS = {
    "R-S": ("5+u0-u1", 2, 0.5 * math.erfc(5 / 2)),
    "four_branches": (f"min(min(3+{E[0]}-{E[1]},3+{E[0]}+{E[1]}),min(u0-u1+{E[2]},u1-u0+{E[2]}))", 2, 2.2228e-3),
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
    """(probability, calls, seconds), the first two of the first run; None where the search fails."""
    seconds = []
    for run in range(runs):
        ot.RandomGenerator.SetSeed(run + 1)
        g, n = limit_state(ot, name)
        vector = ot.RandomVector(ot.Normal(n))
        event = ot.ThresholdEvent(ot.CompositeRandomVector(g, vector), ot.LessOrEqual(), 0.0)
        started = time.process_time()
        try:
            if method == "form":
                algorithm = ot.FORM(ot.AbdoRackwitz(), event, [0.0] * n)
                algorithm.run()
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
        if run == 0:
            found = probability, g.getEvaluationCallsNumber()
    return *found, statistics.median(seconds)


NO_END = "does not converge"


def told(probability):
    return f"{float(probability):.4e}" if float(probability) > 0.0 else NO_END


def rows(binaries, runs):
    try:
        import openturns as ot
    except ImportError:
        print("bench: OpenTURNS is not here (apt-get install python3-openturns): reliability is left out", file=sys.stderr)
        return []
    ot.Log.Show(ot.Log.NONE)
    ot.TBB.Disable()
    lines = subprocess.run([binaries / "bench_reliability", str(runs)], check=True, capture_output=True, text=True).stdout.splitlines()
    out = []
    for name, method, probability, calls, seconds in (line.split() for line in lines):
        peer = theirs(ot, name, method, runs)
        words = f"published {PROBLEMS[name][2]:.4e}, ours {told(probability)}, OpenTURNS {told(peer[0]) if peer else NO_END}"
        part = f"reliability: {name}, {method} ({words})"
        if peer and float(probability) > 0.0:
            out += [table.row(part, "calls of the limit state", float(calls), "calls", float(peer[1]), "OpenTURNS"),
                    table.row(part, "processor time", float(seconds), "s", peer[2], "OpenTURNS, symbolic functions")]
        else:
            out.append(table.row(part, "calls of the limit state", float(calls), "calls", beside="one of the two does not converge"))
    return out
