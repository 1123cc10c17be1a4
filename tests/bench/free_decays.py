"""How near step 3 comes to the damping of free decays: free_decays.py COUNT SEED. The records are those of test_identification_defaults (three
oscillators released from rest, 60 s at 200 Hz, noise of 0.2 %), one a seed; the step runs with its defaults.

A decay is right if it gives the three modes and no other, each damping ratio within 2 % of the truth.
"""
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "steps"))
import test_identification_defaults as decays  # noqa: E402

MOST_OFF = 0.02  # of a damping ratio


def errors_of(seed):
    """Relative errors of the damping ratios, or None where there are not just three modes."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        decays.write(folder / "campaign", [("S1", "free_decay", "still", ["c01", "c02", "c03"], decays.released(seed), 200.0)])
        decays.run(folder / "campaign", folder / "out").check_returncode()
        modes = decays.rows(folder / "out" / "modes.csv")
    if len(modes) != len(decays.MODES):
        return None
    return [float(mode["damping_ratio_pct"]) / (100 * zeta) - 1 for mode, (_, zeta) in zip(modes, decays.MODES)]


def main(count, first):
    found = {seed: errors_of(seed) for seed in range(first, first + count)}
    wrong = [seed for seed, errors in found.items() if errors is None or max(map(abs, errors)) > MOST_OFF]
    worst = max((max(map(abs, errors)) for errors in found.values() if errors is not None), default=float("nan"))
    print(f"{count - len(wrong)} of {count} decays right, largest error of a damping ratio {100 * worst:.3f} %, wrong seeds {wrong}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3]))
