"""The whole chain on structures of another class than the model: records of two setups, step 3, step 9, all with defaults.

    chain.py BIN OUT N SEED [--only girder truss frame cable-stayed] [--kinds sound change …] [--no-diagnosis] [--keep] [--set key=value …] [--count]

N trials from SEED on; forty consecutive seeds hold each structure with each kind (hidden.py). --count prints what the seeds hide and runs nothing. OUT gets chain_SEED_N.csv, a row a trial as
soon as it is done, and chain_SEED_N.md, the score with exact 95 % intervals. --set goes to step 9 and is written into the results; a run with it is none of defaults.
"""
import argparse
import csv
import json
import pathlib
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "exam")]
import folders  # noqa: E402
import hidden  # noqa: E402
import rated  # noqa: E402
from intervals import share  # noqa: E402
from trials import run, write_score  # noqa: E402

COLUMNS = (
    "seed", "structure", "kind", "version", "set", "hidden", "visible", "verdict", "rating", "found", "effects", "modes", "seconds_identification", "seconds_diagnosis",
)


def modes_in(features):
    """Modes of each condition, as "8 7"."""
    found = {}
    with open(features / "rows.csv", newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            if row["type"] == "frequency_Hz":
                found[row["condition"]] = found.get(row["condition"], 0) + 1
    return " ".join(str(n) for n in found.values())


def one_trial(told, work, trial):
    """A row of the results. A step that refuses its input or does not converge is a result: its message stands in `effects`, the rating is `failed`."""
    out = {
        "seed": trial.seed, "structure": trial.plan.name, "kind": trial.kind, "set": " ".join(told.set),
        "hidden": "; ".join(f"{c.kind}@{c.place} {c.size:.3g} ({c.sigma:.0f} sigma)" for c in trial.causes),
        "visible": sum(c.sigma >= rated.VISIBLE_SIGMA for c in trial.causes),
    }
    shutil.rmtree(work, ignore_errors=True)
    folders.write_model(work / "model", trial.plan)
    folders.write_campaign(work / "campaign", trial)
    quiet = ("--threads", "1", "--quiet")
    binaries = told.bin.resolve()
    try:
        out["seconds_identification"] = f"{run(binaries / 's3_identification', '--campaign', work / 'campaign', '--out', work / 's3', *quiet):.1f}"
        out["modes"] = modes_in(work / "s3" / "features")
        if told.no_diagnosis:
            return out
        options = [part for key in told.set for part in ("--set", key)]
        out["seconds_diagnosis"] = "{:.1f}".format(
            run(binaries / "s9_diagnosis", "--model", work / "model", "--features", work / "s3" / "features", "--out", work / "s9", *options, *quiet)
        )
    except RuntimeError as failure:
        return out | {"rating": "failed", "effects": str(failure)}
    answer = json.loads((work / "s9" / "diagnosis.json").read_text(encoding="utf-8"))
    manifest = json.loads((work / "s9" / "manifest.json").read_text(encoding="utf-8"))
    rating, found = rated.rate(answer, trial.causes, rated.Places(work / "model"), trial.plan.length)
    effects = "; ".join(
        f"{e['cause']}@{e['location']}[{len(e.get('cluster', []))}] p {e['probability']:.2f}"
        + "".join(f" {p['name']}={p['value']:.3g}({p['low']:.3g},{p['high']:.3g})" for p in e["parameters"][:1]) for e in answer["effects"]
    )
    return out | {
        "version": f"{manifest['version']} ({manifest['commit'][:9]})", "verdict": answer["verdict"], "rating": rating, "found": found, "effects": effects,
    }


def lines(rows):
    """(what, value) of the score, of the trials that were diagnosed."""
    rows = [r for r in rows if r["rating"]]
    sound = [r for r in rows if r["kind"].startswith("sound")]
    hidden_rows = [r for r in rows if int(r["visible"]) > 0]
    yield "sound: alarms", share(sum(r["rating"] == "wrong" for r in sound), len(sound))
    yield "sound: `unknown`", share(sum(r["rating"] == "unknown" for r in sound), len(sound))
    yield "visible causes: right", share(sum(r["rating"] == "right" for r in hidden_rows), len(hidden_rows))
    yield "visible causes: wrong", share(sum(r["rating"] == "wrong" for r in hidden_rows), len(hidden_rows))
    two = [r for r in rows if int(r["visible"]) == 2]
    yield "two visible causes: both", share(sum(r["rating"] == "right" for r in two), len(two))
    yield "a step ended without an answer", share(sum(r["rating"] == "failed" for r in rows), len(rows))
    for column in ("kind", "structure"):
        for value in sorted({r[column] for r in hidden_rows}):
            here = [r for r in hidden_rows if r[column] == value]
            yield f"{value}: right", share(sum(r["rating"] == "right" for r in here), len(here))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("trials", type=int, metavar="N")
    parser.add_argument("seed", type=int)
    parser.add_argument("--only", nargs="+", help="structures")
    parser.add_argument("--kinds", nargs="+", choices=sorted(set(hidden.KINDS)))
    parser.add_argument("--no-diagnosis", action="store_true", help="records and step 3 alone")
    parser.add_argument("--keep", action="store_true", help="keep the folders of every trial")
    parser.add_argument("--count", action="store_true", help="print what the seeds hide; run nothing")
    parser.add_argument("--set", action="append", default=[], help="a key of step 9")
    return parser.parse_args()


def main():
    told = arguments()
    told.out.mkdir(parents=True, exist_ok=True)
    table, done, seed = told.out / f"chain_{told.seed}_{told.trials}.csv", 0, told.seed
    with open(table, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        writer.writeheader()
        while done < told.trials and seed < told.seed + 40 * told.trials:
            trial, seed = hidden.hide(seed), seed + 1
            if (told.only and trial.plan.name not in told.only) or (told.kinds and trial.kind not in told.kinds):
                continue
            done += 1
            hides = "; ".join(f"{c.kind}@{c.place} {c.size:.3g} ({c.sigma:.0f} sigma)" for c in trial.causes)
            if told.count:
                print(f"{trial.seed} {trial.plan.name} {trial.kind}: {hides or 'nothing'}")
                continue
            work = told.out / "work" / str(trial.seed)
            row = one_trial(told, work, trial)
            writer.writerow(row)
            stream.flush()
            print(f"{trial.seed} {trial.plan.name} {trial.kind}: {row.get('verdict', '-')} {row.get('rating', '')} | hidden {hides or 'nothing'} | {row.get('effects', '')}"
                  f" | modes {row.get('modes', '')}", flush=True)
            if not told.keep:
                shutil.rmtree(work)
    if not told.count:
        write_score(table, lines)


if __name__ == "__main__":
    main()
