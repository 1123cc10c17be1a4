"""The exam of the benchmark frame: two records, before and after; "what changed?".

    exam.py BIN OUT N SEED [--cases 1 3] [--patterns 0 3 4] [--no-diagnosis] [--keep] [--set key=value …]

N pairs from the list of a seed: each case with patterns 1 to 6 and three sound pairs (pattern 0), 45 pairs a seed; further pairs take the next seeds. The order mixes
cases and patterns, so that a small N holds some of each. Steps 3 and 9 run with their defaults; --set goes to step 9 alone and is written into the results.
Beside them run plain least squares and error-domain model falsification (tests/blind/baselines) on the modes of the same step 3.

OUT gets exam_SEED_N.csv, a row a pair as soon as it is done, modes_SEED_N.csv, a row for each mode of step 3 against the truth, and exam_SEED_N.md, the score with exact 95 % intervals.
"""
import argparse
import csv
import functools
import json
import pathlib
import shutil
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
STUDY = HERE.parents[2] / "workflows" / "iasc_asce"
sys.path[:0] = [str(STUDY), str(HERE), str(HERE.parent / "baselines")]
import answers  # noqa: E402
import frame  # noqa: E402
import make_inputs  # noqa: E402
import records  # noqa: E402
from changed_parts import Change, Structure  # noqa: E402
from falsification import Predictions, not_falsified  # noqa: E402
from identified import MODE_COLUMNS, counts, mode_rows  # noqa: E402
from least_squares import fit_shares  # noqa: E402
from measured_modes import read_modes  # noqa: E402
from score import write_score  # noqa: E402
from trials import run  # noqa: E402

SOUND_PAIRS = 3  # of each case and seed
COLUMNS = (
    "seed", "case", "pattern", "draw", "version", "set", "verdict", "rating", "detail", "effects", "probability", "largest_false_loss_pct",
    "modes_before", "modes_after", "spurious", "missed", "squares_located", "squares_false_loss_pct", "squares_losses_pct", "falsification",
    "falsification_sets", "seconds_identification", "seconds_diagnosis",
)
PARTS = [(storey, face) for storey in range(1, frame.FLOORS + 1) for face in frame.ALL_FACES]
# Share of a storey's stiffness along their direction that the braces of one face carry (two faces a direction): FACTS of the benchmark, 71.0 % along y, 45.2 % along x.
FACE_SHARE = {"x0": 0.355, "x2": 0.355, "y0": 0.226, "y2": 0.226}


def pairs_of_seed():
    """(case, pattern, draw) in the order in which they are taken."""
    per_case = [(pattern, 0) for pattern in (1, 3, 0, 4, 2, 6)] + [(0, 1), (0, 2), (5, 0)]
    for place in range(len(per_case)):
        for case in (1, 3, 5, 2, 4):
            yield (case, *per_case[place])


def structure():
    """The engineer's model for the baselines: the sound frame of case 1 with each face's braces a part."""
    whole, mass = frame.stiffness_and_mass(1, frame.Damage())
    parts = [whole - frame.stiffness_and_mass(1, frame.Damage((frame.Loss(s, (f,), 0.0, (0, 1)),)))[0] for s, f in PARTS]
    return Structure(whole - sum(parts), parts, mass, frame.at_sensors(np.eye(3 * frame.FLOORS)))


def groups():
    """Composite places that falsification tries: all faces of a storey, and its two of a direction."""
    for storey in range(1, frame.FLOORS + 1):
        for faces in (frame.ALL_FACES, ("x0", "x2"), ("y0", "y2")):
            yield tuple(PARTS.index((storey, face)) for face in faces)


def least_squares_row(change, losses):
    """How plain least squares answers: shares by face, without a verdict."""
    shares, _ = fit_shares(change)
    lost = {(int(row["storey"]), row["face"]) for row in losses}
    visible = [(int(row["storey"]), row["face"]) for row in losses if row["visible"] == "1"]
    loss = {part: 100.0 * (1.0 - share) for part, share in zip(PARTS, shares)}
    sound = [part for part in PARTS if part not in lost]
    storeys = {}  # loss of a sound storey along a direction, in per cent of its stiffness
    for storey in range(1, frame.FLOORS + 1):
        for faces in (("x0", "x2"), ("y0", "y2")):
            if not any((storey, face) in lost for face in faces):
                storeys[storey, faces] = sum(FACE_SHARE[face] * loss[storey, face] for face in faces)
    located = bool(visible) and min(loss[v] for v in visible) > max([loss[s] for s in sound], default=0.0)
    return {
        "squares_located": int(located) if visible else "",
        "squares_false_loss_pct": f"{max([0.0, *storeys.values()]):.1f}",
        "squares_losses_pct": " ".join(f"{s}_{f}:{loss[s, f]:.0f}" for s, f in PARTS if abs(loss[s, f]) >= 5.0),
    }


@functools.lru_cache(maxsize=None)
def predictions():
    return Predictions(structure(), list(groups()))


def falsification_row(change, losses):
    standing = not_falsified(change, predictions())
    named = [{PARTS[i] for i in which} for which in standing]
    lost = {(int(row["storey"]), row["face"]) for row in losses}
    visible = {(int(row["storey"]), row["face"]) for row in losses if row["visible"] == "1"}
    if () in standing:
        rating = "none"
    elif not standing:
        rating = "unknown"
    else:
        right = [faces for faces in named if faces <= lost]
        rating = "wrong" if not right else "complete" if len(named) <= answers.MOST_PLACES and any(visible <= f for f in right) else "half"
    return {"falsification": rating, "falsification_sets": len(standing)}


def false_loss(answer, faces, rows):
    """The largest loss [% of a storey's stiffness along a direction] that a name or set claims at a face that lost nothing."""
    if answer["verdict"] not in ("named", "ambiguous"):
        return 0.0
    lost = {(int(row["storey"]), row["face"]) for row in rows}
    worst = 0.0
    for effect in answer["effects"]:
        place = faces.of(effect["location"])
        factor = next((p["value"] for p in effect["parameters"] if p["name"] == "factor"), None)
        if place and factor is not None and factor < 1.0:
            worst = max(worst, 100.0 * (1.0 - factor) * max([FACE_SHARE[f] for s, f in place if (s, f) not in lost], default=0.0))
    return worst


def diagnosis_row(folder, faces, rows):
    answer = json.loads((folder / "diagnosis.json").read_text(encoding="utf-8"))
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    rating, detail = answers.rate(answer, rows, faces)
    effects = "; ".join(
        f"{e['cause']}@{e['location']}[{len(answers.places(e, faces))}]"
        + "".join(f" {p['name']}={p['value']:.3g}({p['low']:.3g},{p['high']:.3g})" for p in e["parameters"][:1])
        for e in answer["effects"]
    )
    return {
        "version": f"{manifest['version']} ({manifest['commit'][:9]})", "verdict": answer["verdict"], "rating": rating, "detail": detail,
        "effects": effects, "probability": f"{answer['effects'][0]['probability']:.3f}" if answer["effects"] else "",
        "largest_false_loss_pct": f"{false_loss(answer, faces, rows):.1f}",
    }


def one_pair(told, bin_folder, work, case, pattern, draw, seed, losses):
    """A row of the results, and a row of each mode that step 3 gave."""
    shutil.rmtree(work, ignore_errors=True)
    rows = losses.get((case, pattern), [])
    records.write_campaign(work / "campaign", case, (0, pattern), seed, draw)
    out = {"seed": seed, "case": case, "pattern": pattern, "draw": draw, "set": " ".join(told.set)}
    quiet = ("--threads", "1", "--quiet")
    out["seconds_identification"] = f"{run(bin_folder / 's3_identification', '--campaign', work / 'campaign', '--out', work / 's3', *quiet):.1f}"
    channels = [name for name, *_ in frame.sensors()]
    found = read_modes(work / "s3" / "features" / "rows.csv", channels)
    before, after = (found.get(state, []) for state in records.STATES)
    out |= counts(case, pattern, before, after)
    if before and after:
        change = Change.of(structure(), before, after)
        out |= least_squares_row(change, rows) | falsification_row(change, rows)
    if not told.no_diagnosis:
        options = [part for key in told.set for part in ("--set", key)]
        model = work.parent / "inputs" / "model"
        seconds = run(
            bin_folder / "s9_diagnosis", "--model", model, "--features", work / "s3" / "features", "--out", work / "s9", *options, *quiet
        )
        out |= diagnosis_row(work / "s9", answers.Faces(model), rows) | {"seconds_diagnosis": f"{seconds:.1f}"}
    modes = [
        {"seed": seed, "case": case, "pattern": pattern, "draw": draw, "state": state} | row
        for state, damage, measured in zip(records.STATES, (0, pattern), (before, after)) for row in mode_rows(case, damage, measured)
    ]
    return out, modes


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("count", type=int)
    parser.add_argument("seed", type=int)
    parser.add_argument("--cases", type=int, nargs="+", default=sorted(frame.CASES))
    parser.add_argument("--patterns", type=int, nargs="+", default=sorted(frame.PATTERNS))
    parser.add_argument("--no-diagnosis", action="store_true", help="step 3 and the baselines alone")
    parser.add_argument("--keep", action="store_true", help="keep the folders of every pair")
    parser.add_argument("--set", action="append", default=[], help="a key of step 9; without any the run counts as one of defaults")
    return parser.parse_args()


def main():
    told = arguments()
    losses = answers.read_losses(HERE / "losses.csv")
    work = told.out / "work"
    make_inputs.write_model(work / "inputs" / "model")
    table = told.out / f"exam_{told.seed}_{told.count}.csv"
    done = 0
    with open(table, "w", newline="", encoding="utf-8") as stream, open(told.out / f"modes_{table.name[5:]}", "w", newline="", encoding="utf-8") as other:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        mode_writer = csv.DictWriter(other, MODE_COLUMNS, lineterminator="\n")
        writer.writeheader()
        mode_writer.writeheader()
        for seed in range(told.seed, told.seed + 1000):
            for case, pattern, draw in pairs_of_seed():
                if done == told.count:
                    break
                if case not in told.cases or pattern not in told.patterns:
                    continue
                folder = work / f"{seed}_{case}_{pattern}_{draw}"
                row, modes = one_pair(told, told.bin.resolve(), folder, case, pattern, draw, seed, losses)
                writer.writerow(row)
                mode_writer.writerows(modes)
                stream.flush()
                other.flush()
                print(
                    f"{seed} case {case} pattern {pattern}: {row.get('verdict', '-')} {row.get('rating', '')} {row.get('detail', '')}"
                    f" | squares {row.get('squares_losses_pct', '-')} | falsification {row.get('falsification', '-')} | {row.get('effects', '')}", flush=True
                )
                done += 1
                if not told.keep:
                    shutil.rmtree(folder)
    write_score(table)


if __name__ == "__main__":
    main()
