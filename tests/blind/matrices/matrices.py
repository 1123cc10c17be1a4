"""The published matrices of a real bridge as the engineer's model, and another bridge in the test: step 9 with its defaults.

    matrices.py BIN OUT N SEED [--kinds sound mass …] [--numbers 0 1 …] [--joints] [--keep] [--set key=value …] [--count]

N trials, sixteen a seed (hidden.py), from SEED on. --count prints what they hide and runs nothing. OUT gets matrices_SEED_N.csv, a row a trial as soon as it is done, and
matrices_SEED_N.md, the score with exact 95 % intervals. --set goes to step 9 and is written into the results; a run with it is none of defaults. --joints gives the model the
nodes, directions and coordinates that its authors know and do not publish (bridge.py); a run with it counts apart.

The matrices are read from ../shared/data/gt_pedestrian_bridge (TWINDECK_DATA names another parent). Where they are not at hand nothing is run.
"""
import argparse
import csv
import json
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "exam")]
import bridge as matrices  # noqa: E402
import folders  # noqa: E402
import hidden  # noqa: E402
import rated  # noqa: E402
from intervals import share  # noqa: E402
from trials import run, write_score  # noqa: E402

COLUMNS = (
    "seed", "number", "kind", "version", "set", "form_error_pct", "severity", "channels", "modes", "shape_deviation_pct", "hidden", "sigma", "verdict", "rating",
    "part_beside", "rank_of_truth", "effects", "frequency_scale_pct", "shape_scale_pct", "seconds_diagnosis",
)


def ranking_of(folder):
    """"family@location" of all hypotheses, the most probable first."""
    with open(folder / "hypotheses.csv", newline="", encoding="utf-8") as stream:
        return [f"{row['cause']}@{row['location']}" for row in csv.DictReader(stream)]


def one_trial(told, bridge, trial):
    """A row of the results. A step that refuses its input or does not converge is a result: its message stands in `effects`, the rating is `failed`."""
    out = {
        "seed": trial.seed, "number": trial.number, "kind": trial.kind, "set": " ".join([*(["joints"] if told.joints else []), *told.set]),
        "form_error_pct": f"{100.0 * trial.form_error:g}", "severity": f"{trial.truth.severity:.2f}", "channels": len(trial.channels), "modes": trial.modes,
        "shape_deviation_pct": f"{100.0 * trial.shape_deviation:.2f}", "hidden": hidden.in_words(trial.cause), "sigma": f"{trial.cause.sigma:.1f}" if trial.cause else "",
    }
    work = told.out / "work" / f"{trial.seed}_{trial.number}"
    shutil.rmtree(work, ignore_errors=True)
    folders.write_features(work / "features", bridge, trial, told.joints)
    options = [part for key in told.set for part in ("--set", key)]
    try:
        seconds = run(
            told.bin.resolve() / "s9_diagnosis", "--model", told.out / "work" / "inputs" / "model", "--features", work / "features", "--out", work / "s9", *options,
            "--threads", "1", "--quiet",
        )
    except RuntimeError as failure:
        return out | {"rating": "failed", "effects": str(failure)}
    answer = json.loads((work / "s9" / "diagnosis.json").read_text(encoding="utf-8"))
    manifest = json.loads((work / "s9" / "manifest.json").read_text(encoding="utf-8"))
    scales = {entry["name"]: f"{entry['scale']:.2f}" for entry in answer["form"]}
    out |= {
        "version": f"{manifest['version']} ({manifest['commit'][:9]})", "verdict": answer["verdict"], "rating": rated.rate(answer, trial.cause, bridge),
        "part_beside": int(rated.is_beside(trial.cause, answer)), "rank_of_truth": rated.rank_of_truth(ranking_of(work / "s9"), trial.cause, bridge),
        "effects": rated.in_words(answer), "frequency_scale_pct": scales.get("frequencies", ""), "shape_scale_pct": scales.get("shapes", ""), "seconds_diagnosis": f"{seconds:.1f}",
    }
    if not told.keep:
        shutil.rmtree(work)
    return out


def lines(rows):
    """(what, value) of the score."""
    sound = [r for r in rows if r["kind"] in hidden.SOUND]
    causes = [r for r in rows if r["kind"] not in hidden.SOUND]

    def rated_as(rating, of):
        return share(sum(r["rating"] == rating for r in of), len(of))

    yield "sound: alarms", rated_as("wrong", sound)
    yield "sound: `unknown`", rated_as("unknown", sound)
    for rating in ("right", "wrong", "unknown", "none"):
        yield f"causes: {rating}", rated_as(rating, causes)
    yield "the step ended without an answer", rated_as("failed", rows)
    for column, words in (("kind", "{}"), ("form_error_pct", "form error {} %")):
        for value in sorted({r[column] for r in causes}):
            yield f"{words.format(value)}: right", rated_as("right", [r for r in causes if r[column] == value])


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("trials", type=int, metavar="N")
    parser.add_argument("seed", type=int)
    parser.add_argument("--kinds", nargs="+", choices=sorted(set(hidden.KINDS)))
    parser.add_argument("--numbers", type=int, nargs="+", choices=range(len(hidden.KINDS)), metavar="K", help="those trials of each seed")
    parser.add_argument("--joints", action="store_true", help="nodes with directions and coordinates, which are not published")
    parser.add_argument("--keep", action="store_true", help="keep the folders of every trial")
    parser.add_argument("--count", action="store_true", help="print what the trials hide; run nothing")
    parser.add_argument("--set", action="append", default=[], help="a key of step 9")
    return parser.parse_args()


def main():
    told = arguments()
    if not matrices.is_at_hand():
        print(f"The matrices of the bridge are not at hand ({matrices.DATA}; TWINDECK_DATA names another parent folder). No trial was run.")
        return
    bridge = matrices.read_bridge()
    table = told.out / f"matrices_{told.seed}_{told.trials}.csv"
    if not told.count:
        folders.write_model(matrices.DATA, told.out / "work" / "inputs", bridge, told.joints)
        table.write_text(",".join(COLUMNS) + "\n", encoding="utf-8")
    for position in range(told.trials):
        seed, number = hidden.trial_of(position, told.seed)
        if (told.kinds and hidden.KINDS[number] not in told.kinds) or (told.numbers and number not in told.numbers):
            continue
        trial = hidden.hide(seed, number, bridge)
        head = f"{seed} {number} {trial.kind}, form error {100.0 * trial.form_error:g} %"
        if told.count:
            print(f"{head}: {hidden.in_words(trial.cause)}", flush=True)
            continue
        row = one_trial(told, bridge, trial)
        with open(table, "a", newline="", encoding="utf-8") as stream:
            csv.DictWriter(stream, COLUMNS, lineterminator="\n").writerow(row)
        print(f"{head}: {row.get('verdict', '-')} {row['rating']} | hidden {row['hidden']} | {row['effects']}", flush=True)
    if not told.count:
        write_score(table, lines)


if __name__ == "__main__":
    main()
