"""Parameters of an updated model against the bridge whose records it was updated to; only the scorer reads that bridge, `truth/model`.

A parameter stands for a modulus, a density or a factor on springs. The bridge need not have one value for it: its members come out of a workshop,
zone by zone. Held against the updated value is the mean over the elements that the parameter scales, weighed by their volume (springs: each alike),
and beside it the least and the largest.
"""
import csv
import math
import tomllib

COLUMNS = {"youngs_modulus": "youngs_modulus_Pa", "density": "density_kg_m3"}
HEADER = ["parameter", "unit", "initial_value", "updated_value", "true_value", "true_least", "true_largest", "lower", "upper", "true_within_bounds",
          "error_before_pct", "error_after_pct", "closer"]


def table(file):
    with open(file, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def volumes(folder):
    """{material: volume [m3] of its elements}"""
    at = {r["node"]: [float(r[f"{axis}_m"]) for axis in "xyz"] for r in table(folder / "nodes.csv")}
    sections = {r["section"]: r for r in table(folder / "sections.csv")}
    found = {}
    for r in table(folder / "elements.csv"):
        corners = [at[r[f"node{i}"]] for i in range(1, 9) if r.get(f"node{i}")]
        section = sections.get(r["section"])
        if section is None or len(corners) < 2:
            continue
        across = float(section["thickness_m"]) if len(corners) > 2 else float(section["area_m2"])
        size = math.dist(*corners) if len(corners) == 2 else sum(_triangle(corners[0], *pair) for pair in zip(corners[1:], corners[2:]))
        found[r["material"]] = found.get(r["material"], 0.0) + size * across
    return found


def _triangle(a, b, c):
    u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
    return 0.5 * math.dist((u[1] * v[2], u[2] * v[0], u[0] * v[1]), (u[2] * v[1], u[0] * v[2], u[1] * v[0]))


def true_values(parameter, truth, model):
    """[(value, weight)] of the bridge for one parameter; empty where it has no counterpart. @param parameter  a [[parameter]] of model.toml"""
    if parameter["target"] == "spring_stiffness":
        own = {r["spring"]: float(r["stiffness_N_m"]) for r in table(model / "springs.csv") if r["group"] in parameter["of"]}
        return [(parameter["initial"] * float(r["stiffness_N_m"]) / own[r["spring"]], 1.0) for r in table(truth / "springs.csv") if own.get(r["spring"])]
    if parameter["target"] not in COLUMNS:
        return []
    volume = volumes(truth)
    # A zone's material is named after the one that it was made of: steel_foot_top_chord_1.
    return [(float(r[COLUMNS[parameter["target"]]]), volume[r["material"]]) for r in table(truth / "materials.csv")
            if volume.get(r["material"]) and any(r["material"] == name or r["material"].startswith(name + "_") for name in parameter["of"])]


def score_parameters(truth, model, updated):
    """@param truth  model folder of the bridge @param model  model folder before the update @param updated  parameters.csv of s6_updating
    @return rows of HEADER"""
    defined = {p["name"]: p for p in tomllib.loads((model / "model.toml").read_text(encoding="utf-8"))["parameter"]}
    rows = []
    for r in table(updated):
        parameter = defined[r["parameter"]]
        values = true_values(parameter, truth, model)
        before, after, lower, upper = (float(r[name]) for name in ("initial_value", "final_value", "lower", "upper"))
        row = {"parameter": r["parameter"], "unit": r["unit"], "initial_value": before, "updated_value": after, "lower": lower, "upper": upper}
        if values:
            mean = sum(value * weight for value, weight in values) / sum(weight for _, weight in values)
            errors = [100.0 * (value / mean - 1.0) for value in (before, after)]
            row |= {"true_value": mean, "true_least": min(v for v, _ in values), "true_largest": max(v for v, _ in values),
                    "true_within_bounds": int(lower <= mean <= upper), "error_before_pct": errors[0], "error_after_pct": errors[1],
                    "closer": int(abs(errors[1]) < abs(errors[0]))}
        rows.append(row)
    return rows


def write_parameters(rows, file):
    with open(file, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, HEADER, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: f"{value:.12g}" if isinstance(value, float) else value for name, value in row.items()} for row in rows)


def in_words(rows):
    known = [r for r in rows if "closer" in r]
    closer = sum(r["closer"] for r in known)
    outside = [r["parameter"] for r in known if not r["true_within_bounds"]]
    return (f"{closer} of {len(known)} updated parameters came closer to the bridge's own value"
            + (f"; of {', '.join(outside)} that value lies beyond the bounds" if outside else "")
            + (f"; {len(rows) - len(known)} have no counterpart there" if len(known) < len(rows) else ""))
