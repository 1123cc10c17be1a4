"""Scores the diagnosis of a virtual campaign against what the campaign hid, and the updated parameters against its bridge; nothing else reads
the campaign's truth.

    python3 tests/steps/diagnosis_score.py --campaign results/ponte_del_mare_virtual/s0_campaign \\
        --imposed workflows/ponte_del_mare_virtual/s0_campaign.toml --diagnosis results/ponte_del_mare_virtual/s9_diagnosis \\
        --updating results/ponte_del_mare_virtual/s6_updating --model results/ponte_del_mare_virtual/s4_refinement/model \\
        --out results/ponte_del_mare_virtual/score

Hidden is what the campaign's settings impose and the diagnosed model lacks: friction and mounts of the dampers of each make, stays that vibrate.
`truth/dampers.csv` says which dampers there are and how long each slides. score.json then holds what was hidden, what was answered, the sizes with
their intervals; with --updating, parameters.csv the parameters before and after it (parameter_score.py). Without a truth folder it says so, and
nothing is scored.
"""
import argparse
import csv
import hashlib
import json
import pathlib
import sys
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import parameter_score  # noqa: E402

UNITS = {"N": 1.0, "kN": 1e3, "MN": 1e6, "N/m": 1.0, "kN/m": 1e3, "MN/m": 1e6, "GN/m": 1e9}
SIZES = {"Fc_N": ("force at which each begins to slide", "N"), "k_lock_N_m": ("stiffness of each while it is held", "N/m")}
ALSO = "Hidden too, but no cause is asked to name it: another mesh, slabs of uneven thickness, bearing springs, colder days."


def quantity(text):
    """'500 N' in SI units."""
    number, unit = text.split()
    return float(number) * UNITS[unit]


def listed(names):
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def si(value, unit):
    return f"{value / 1e6:g} M{unit}" if value >= 1e6 else f"{value:g} {unit}"


def read_rows(file):
    with open(file, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def hidden_dampers(settings, truth, conditions):
    """One a make of damper: cause, places that are right, sizes that were imposed. @param conditions  that the diagnosis was given"""
    rows = [r for r in read_rows(truth / "dampers.csv") if r["condition"] in conditions]
    for make in sorted(settings.get("damper", []), key=lambda make: -quantity(make.get("friction", "0 N"))):  # what shows most comes first
        names = sorted({r["damper"] for r in rows if r["damper"].startswith(make["type"])})
        if not names or "friction" not in make:
            continue
        force = quantity(make["friction"])
        mount = quantity(make["mount_stiffness"]) if "mount_stiffness" in make else None
        slides = {}
        for r in rows:
            if r["damper"] in names:
                slides[r["condition"]] = max(slides.get(r["condition"], 0.0), float(r["sliding_pct"]))
        told = ", ".join(f"{share:.0f} % of the time in {condition}" for condition, share in slides.items() if share > 0.0) or "at no time"
        what = f"Friction: the dampers {listed(names)} stand still below {si(force, 'N')} each"
        what += f", held by mounts of {si(mount, 'N/m')}" if mount else ""
        yield {"what": f"{what}; they slide {told}.", "causes": ["fric"], "locations": ["dampers:" + ",".join(names), *(f"damper:{n}" for n in names)],
               "truth": {"Fc_N": force} | ({"k_lock_N_m": mount} if mount else {})}


def hidden_stays(settings):
    stays = settings.get("vibrating_stays", [])
    if stays:
        yield {"what": f"The stays {listed(stays)} vibrate; the model's are bars that do not.", "causes": ["barstays", "cable"],
               "locations": ["global", "stays:" + ",".join(stays), *(f"stay:{s}" for s in stays)], "truth": {}}


def is_of(hidden, member):
    cause, _, location = member.partition("@")
    return cause in hidden["causes"] and location in hidden["locations"]


def answer(hidden, told):
    """What the diagnosis says of one hidden thing, and the sizes that it gives."""
    said, found = "missed", None
    for effect in told["effects"]:
        own = f"{effect['cause']}@{effect['location']}"
        if is_of(hidden, own):
            found = effect
            if told["verdict"] == "unknown":
                said = "found, under the verdict unknown"
            else:
                said = "named" if len(effect["cluster"]) == 1 else "in the set"
            break
        if any(is_of(hidden, member) for member in effect["cluster"]):
            said = "in the set"
        elif effect["location"] in hidden["locations"] and said == "missed":
            said = "another cause at the same place"
    given = {p["name"]: p for p in found["parameters"]} if found else {}
    sizes = []
    for name, value in hidden["truth"].items():
        words, unit = SIZES[name]
        p = given.get(name)
        sizes.append({"name": name, "words": words, "unit": unit, "truth": value, "value": p and p["value"], "low": p and p["low"], "high": p and p["high"],
                      "inside": bool(p and p["low"] <= value <= p["high"])})
    return {"what": hidden["what"], "causes": hidden["causes"], "location": hidden["locations"][0], "answer": said,
            "probability": found["probability"] if found else None, "sizes": sizes}


def score(campaign, imposed, diagnosis):
    """@param imposed  s0_campaign.toml @param diagnosis  folder of s9_diagnosis"""
    text = (diagnosis / "diagnosis.json").read_bytes()
    stamp = {"schema": 1, "diagnosis_sha256": hashlib.sha256(text).hexdigest()}
    if not (campaign / "truth" / "dampers.csv").is_file():
        return stamp | {"scored": False, "why": f"{campaign / 'truth'} is not there"}
    told = json.loads(text)
    settings = tomllib.loads(imposed.read_text(encoding="utf-8"))
    conditions = {r["condition"] for r in read_rows(diagnosis / "residuals.csv")}
    hidden = [*hidden_dampers(settings, campaign / "truth", conditions), *hidden_stays(settings)]
    wrong = [effect["sentence"].rstrip(".") for effect in told["effects"]
             if not any(effect["location"] in h["locations"] or any(is_of(h, member) for member in effect["cluster"]) for h in hidden)]
    return stamp | {"scored": True, "verdict": told["verdict"], "hidden": [answer(h, told) for h in hidden], "not_hidden": wrong,
                    "gain": told["gain"], "also": ALSO}


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("campaign", "imposed", "diagnosis", "out"):
        parser.add_argument(f"--{name}", type=pathlib.Path, required=True)
    for name in ("updating", "model"):
        parser.add_argument(f"--{name}", type=pathlib.Path)
    options = parser.parse_args(arguments)
    rows = []
    try:
        found = score(options.campaign, options.imposed, options.diagnosis)
        if options.updating and found["scored"]:
            rows = parameter_score.score_parameters(options.campaign / "truth/model", options.model, options.updating / "parameters.csv")
            found["parameters"] = {"words": parameter_score.in_words(rows), "rows": rows}
    except (OSError, KeyError, ValueError) as problem:
        print(f"diagnosis_score: {problem}; run `make s9` and `make s0` of the study first", file=sys.stderr)
        return 2
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "score.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    if rows:
        parameter_score.write_parameters(rows, options.out / "parameters.csv")
        print(f"score: {found['parameters']['words']}")
    for h in found.get("hidden", []):
        sizes = "; ".join(f"{s['words']} {s['truth']:g} {s['unit']}" + (f", found {s['value']:.3g} ({s['low']:.3g} to {s['high']:.3g})" if s["value"] else "")
                          for s in h["sizes"])
        print(f"score: {h['answer']}: {h['what']}" + (f" {sizes}" if sizes else ""))
    if not found["scored"]:
        print(f"score: nothing is scored: {found['why']}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
