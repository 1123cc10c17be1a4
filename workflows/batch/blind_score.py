"""Adds up the scores of blind trials that ran in several jobs: blind_score.py CHUNK.txt … prints what one run of all would.

Each chunk is what `blind_trials N SEED` prints. Trials, cases by family and hits over cases (k/n) add; the proportions' 95 % intervals are
exact (Clopper and Pearson 1934), of the sums. What does not add, such as a mean, is left out.
"""
import math
import re
import sys

TRIAL = re.compile(r"^ *(\d+) +\S+ +D ")
FAMILY = re.compile(r"^  (\S+|\(.*\)) +(\d+) +(\d+) +(\d+) +(\d+)$")
SCORE = re.compile(r"^  (.+?) +(\d+)/(\d+) .*target (>=|<=) +(\d+) %")


def exact_interval(k, n):
    """The exact 95 % interval of a proportion."""

    def solve(least, level):  # p at which P(K >= least) = level
        low, high = 1e-12, 1.0 - 1e-12
        for _ in range(60):
            p = 0.5 * (low + high)
            tail = sum(math.comb(n, i) * p**i * (1.0 - p) ** (n - i) for i in range(least, n + 1))
            low, high = (p, high) if tail < level else (low, p)
        return 0.5 * (low + high)

    return (0.0 if k == 0 else solve(k, 0.025)), (1.0 if k == n else solve(k + 1, 0.975))


def added(texts):
    """(trials by seed, cases by family, [name, k, n, sense, target]) of all chunks."""
    trials, families, scores = {}, {}, {}
    for text in texts:
        for line in text.splitlines():
            if match := TRIAL.match(line):
                trials[int(match[1])] = line
            elif match := SCORE.match(line):
                entry = scores.setdefault(match[1], [0, 0, match[4], int(match[5])])
                entry[0] += int(match[2])
                entry[1] += int(match[3])
            elif match := FAMILY.match(line):
                counts = families.setdefault(match[1], [0, 0, 0, 0])
                families[match[1]] = [a + int(b) for a, b in zip(counts, match.groups()[1:])]
    return trials, families, scores


def main(files):
    texts = []
    for file in files:
        with open(file, encoding="utf-8") as stream:
            texts.append(stream.read())
    trials, families, scores = added(texts)
    print("\n".join(trials[seed] for seed in sorted(trials)))
    print("\nby family: cases, detected, family named, truth in the reported set")
    for family, counts in sorted(families.items()):
        print(f"  {family:<12}" + "".join(f" {c:>4}" for c in counts))
    print("\nscore, exact 95 % intervals")
    missed = False
    for name, (k, n, sense, target) in scores.items():
        low, high = exact_interval(k, n)
        wrong = n > 0 and (100 * high < target if sense == ">=" else 100 * low > target)
        missed = missed or wrong
        print(
            f"  {name:<58} {k:>4}/{n:<4} {100 * k / n if n else 0:>5.1f} %  [{100 * low:>5.1f}, {100 * high:>5.1f}]  target {sense} {target:>3} %  "
            + ("no case" if n == 0 else "MISSED" if wrong else "held")
        )
    print("a target is missed" if missed else "targets held")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
