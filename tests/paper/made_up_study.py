"""A made-up study in a temporary folder: paper tables with invented numbers, step results that lie close to them, and the
repository's own rules (tolerances.toml, orders.toml). Nothing here is a result of the bridge."""
import csv
import hashlib
import json
import shutil
from pathlib import Path

import numpy as np

import made_up_bridge
import made_up_campaign

REPOSITORY = Path(__file__).resolve().parents[2]
RULES = REPOSITORY / "data" / "ponte_del_mare"
STEPS = ["s1_model", "s2_sensors", "s3_identification", "s4_refinement", "s5_sensitivity", "s6_updating", "s7_aerodynamics", "s8_validation"]

MEASURED = [0.8, 1.1, 1.2, 1.3, 1.5, 1.6, 1.8, 1.9, 2.4, 2.5]
SOFT = [0.92, 0.95, 0.96, 0.92, 0.98, 1.01, 0.90, 0.93, 0.75, 0.84]  # preliminary / measured
REFINED = [0.93, 0.94, 0.94, 0.91, 0.99, 1.01, 0.99, 1.16, 0.85, 0.99]
UPDATED = [0.987, 0.984, 0.977, 0.95, 1.01, 1.02, 1.012, 1.008]
PARTNERS = ["1N", "2N", "3N", "4N", "5N", "6N", "8N", "10N", "9N", "12N"]
KEPT = [0, 1, 2, 3, 4, 5, 6, 9]  # Table 9's pairs out of Table 7's, then 11X-13N
PARAMETERS = [  # name, the paper's unit, initial, half range, change in percent
    ("E_c1", "MPa", 35000, 0.15, 9.5), ("E_c2", "MPa", 16000, 0.15, -15), ("E_s", "MPa", 210000, 0.05, 5),
    ("E_s_stay_44", "MPa", 165000, 0.05, -5), ("rho_1", "kg/m3", 1500, 0.3, -24), ("rho_2", "kg/m3", 2500, 0.3, -30),
    ("C_c", "-", 25.4, 0.15, 9.9), ("C_pB", "-", 5.06, 0.15, 4.1), ("C_pD", "-", 1.15, 0.15, -0.4)]
CRITICAL = [("A", "20.00"), ("C", "23.00"), ("D", "21.80"), ("G", "21.50"), ("H", "22.40"), ("I", "21.50")]
QUASI_STEADY = {"A": 20.0, "C": 23.5, "D": 17.0, "G": 16.0, "H": 21.0, "I": 16.0}
RULES_OF_11 = {  # statics, power of cos in the looked-up velocity, powers of 1/cos on the block, axes
    "A": ("normal", 0, (0, 0, 0), "deck"), "C": ("cosine", 1, (0, 0, 0), "deck"), "D": ("cosine", 1, (2, 2, 2), "deck"),
    "G": ("cosine", 1, (2, 2, 2), "wind"), "H": ("oblique_strip", 1, (0, 0, 0), "wind"), "I": ("oblique_strip", 1, (2, 2, 2), "wind")}
OTHERS = ["E_s_stay_60", "E_s_stay_75", "k", "C_pC", "C_pE", "C_pF"]


def write_rows(path, header, rows):
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="", encoding="utf-8") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def read_rows(path):
    with path.open(newline="", encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def make_study(root, paper=None):
    """A complete study under `root`: data/, workflow/, results/ with the steps' outputs and manifests, no tables yet.
    `paper`: a folder with table_NN.csv to take instead of the invented ones."""
    root = Path(root)
    data, workflow, results = root / "data", root / "workflow", root / "results"
    (data / "paper").mkdir(parents=True)
    if paper:
        for table in Path(paper).glob("table_*.csv"):
            shutil.copy(table, data / "paper")
    else:
        write_paper(data / "paper")
    for name in ("tolerances.toml", "orders.toml", "errata.toml", "conclusions.toml"):
        shutil.copy(RULES / name, data / name)
    (data / "known_deviations.toml").write_text("", encoding="utf-8")  # the real study's do not excuse made-up numbers
    workflow.mkdir()
    (workflow / "study.toml").write_text('title = "Made-up bridge"\nseed = 1\nmeasured = "published"\nsteps = '
                                         + json.dumps(STEPS) + "\n", encoding="utf-8")
    write_features(data)
    write_steps(data / "paper", results)
    for step in STEPS:
        write_manifest(results / step)
    return data, workflow, results


def write_paper(folder):
    write_rows(folder / "table_01.csv",
               ["damper", "type", "units_text", "units_count", "damping_constant_kNs_per_m", "spring_stiffness_kN_per_m",
                "spring_tolerance_pct"],
               [["A", "Elastic-viscous", "2", "2", "100.0", "120.5", "5"], ["B", "Elastic-viscous", "2", "2", "300.0", "120.5", "5"],
                ["C", "Viscous", "2+2", "4", "700.2", "", ""]])
    soft = [m * s for m, s in zip(MEASURED, SOFT)]
    write_rows(folder / "table_02.csv", ["mode", "f_N_Hz"], [[i + 1, f"{f:.3f}"] for i, f in enumerate(soft[:9])])
    write_rows(folder / "table_04.csv",
               ["mode", "f_X_without_dampers_Hz", "zeta_without_dampers_pct", "f_X_with_dampers_Hz", "zeta_with_dampers_pct"],
               [[i + 1, f"{f:.3f}", "1.10", f"{1.05 * f:.2f}", "3.20"] for i, f in enumerate(MEASURED)])
    made_up_campaign.write_paper(write_rows, folder)
    pair = ["experimental_mode", "numerical_mode", "f_X_Hz", "f_N_Hz", "error_pct"]

    def numbers(measured, ratio, digits):
        return [f"{measured:.3f}", f"{measured * ratio:.3f}", f"{100 * (ratio - 1):.{digits}f}"]

    write_rows(folder / "table_06.csv", ["mode", *pair[2:]],
               [[i + 1, *numbers(m, r, 1)] for i, (m, r) in enumerate(zip(MEASURED, SOFT))])
    write_rows(folder / "table_07.csv", pair,
               [[f"{i + 1}X", PARTNERS[i], *numbers(m, r, 1)] for i, (m, r) in enumerate(zip(MEASURED, REFINED))])
    write_rows(folder / "table_08.csv", ["parameter", "unit", "initial_value", "final_value", "change_pct"],
               [[n, u, f"{v}", f"{v * (1 + c / 100):.2f}", f"{c:.2f}"] for n, u, v, _, c in PARAMETERS])
    write_rows(folder / "table_09.csv", pair,
               [[f"{i + 1}X", PARTNERS[i], *numbers(MEASURED[i], r, 2)] for i, r in zip(KEPT, UPDATED)]
               + [["11X", "13N", *numbers(2.7, 0.996, 2)]])

    names = [f"MAC_{i + 1}X" for i in KEPT] + ["MAC_11X"]
    write_rows(folder / "table_10.csv", ["numerical_mode", *names],
               [[partner, *("0.90" if i == j else "0.05" for j in range(len(names)))] for i, partner in enumerate([PARTNERS[k] for k in KEPT] + ["13N"])])
    shutil.copy(RULES / "paper" / "table_11.csv", folder)  # words without numbers
    write_rows(folder / "table_12.csv", ["ns", "group", "description", "V_cr_m_per_s", "f_cr_Hz"],
               [[ns, "made up", "", speed, "0.7900"] for ns, speed in CRITICAL])
    runs = [f"{run}_{event}_err_pct" for run in ("NS1_normal_wind", "NS2_cosine_and_skew", "NS3_windY_NS2") for event in ("August", "April")]
    write_rows(folder / "table_13.csv", ["accelerometer", *runs], [[f"M{m}", *(f"{m - 4.5 + 0.1 * i:.2f}" for i in range(6))] for m in range(1, 9)])
    shutil.copy(RULES / "paper" / "table_14.csv", folder)  # words, and angles that are the deck's
    write_rows(folder / "claims.csv", ["claim", "value", "unit", "source", "kind", "why_not"],
               [["preliminary_f10", f"{soft[9]:.3f}", "Hz", "made up", "calibrated", ""], ["degrees_of_freedom", "500", "-", "made up", "virtual", ""],
                ["foot_bottom_chord_sign", "-1", "-", "made up", "predicted", ""],
                ["return_period", "100", "years", "made up", "unavailable", "A made-up reason."]])


def write_features(data):
    frequencies = [r["f_X_without_dampers_Hz"] for r in read_rows(data / "paper" / "table_04.csv")]
    write_rows(data / "features" / "rows.csv", ["type", "mode", "channel", "condition", "value", "std"],
               [["frequency_Hz", i + 1, "", "no_dampers", f, 0.005] for i, f in enumerate(frequencies)])


def write_steps(paper, results):
    """Step outputs whose numbers are the paper's, moved by at most 0.4 %."""
    scatter = [1.003, 0.998, 1.002, 0.997, 1.004, 1.001, 0.999, 1.002, 0.998, 1.001, 1.003, 1.0, 0.999, 1.002, 1.001]
    initial = read_rows(paper / "table_06.csv")
    preliminary = [float(r["f_N_Hz"]) * s for r, s in zip(initial, scatter)]
    preliminary += [preliminary[-1] + 0.1 * (i + 1) for i in range(5)]
    write_rows(results / "s1_model/modes.csv",
               ["mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"],
               [[i + 1, repr(f), "", "", ""] for i, f in enumerate(preliminary)])
    write_rows(results / "s1_model/summary.csv", ["quantity", "value", "unit"], [["degrees_of_freedom", 258, "-"]])
    dampers = []
    for row in read_rows(paper / "table_01.csv"):
        viscous = row["spring_stiffness_kN_per_m"] == ""
        for i in range(int(row["units_count"])):
            dampers.append([f"{row['damper']}{i + 1}", f"damper_{row['damper']}", float(row["damping_constant_kNs_per_m"]) * 1e3,
                            "" if viscous else float(row["spring_stiffness_kN_per_m"]) * 1e3, "viscous" if viscous else "series"])
    write_rows(results / "s1_model/dampers.csv", ["damper", "group", "damping_N_s_m", "stiffness_N_m", "arrangement"], dampers)

    write_model(results / "s1_model")
    made_up_bridge.write_members(write_rows, results / "s1_model")
    made_up_bridge.write_dampers(write_rows, results / "s1_model/model", [d[0] for d in dampers])
    as_built = {int(partner.removesuffix("N")): m * r for partner, m, r in zip(PARTNERS, MEASURED, REFINED)}
    for step in ("s4_refinement", "s6_updating"):
        write_model(results / step)
        write_rows(results / step / "modes.csv", ["mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"],
                   [[n, as_built.get(n, 1.2 + 0.1 * n), "", "", ""] for n in range(1, 16)])

    header = ["stage", "experimental_mode", "numerical_mode", "measured_Hz", "computed_Hz", "error_pct", "mac", "pairing"]

    def compared(stage, rows, pairing):
        for row, s in zip(rows, scatter):
            measured, ours = float(row["f_X_Hz"]), float(row["f_N_Hz"]) * s
            label = row.get("experimental_mode") or f"{row['mode']}X"
            partner = row.get("numerical_mode") or f"{row['mode']}N"
            yield [stage, label, partner, measured, repr(ours), repr(100 * (ours / measured - 1)), "", pairing]

    refined, updated = read_rows(paper / "table_07.csv"), read_rows(paper / "table_09.csv")
    write_rows(results / "s4_refinement/comparison.csv", header,
               [*compared("initial", initial, "order"), *compared("refined", refined, "published")])
    before = [r for r in refined if r["experimental_mode"] in {u["experimental_mode"] for u in updated}]
    write_rows(results / "s6_updating/comparison.csv", header,
               [*compared("before", before, "published"), *compared("after", updated, "published")])
    write_rows(results / "s6_updating/costs.csv", ["point", "cost"], [["start", 0.010], ["published", 0.006], ["optimum", 0.004]])
    write_rows(results / "s6_updating/leave_one_out.csv",
               ["experimental_mode", "numerical_mode", "measured_Hz", "before_Hz", "fitted_Hz", "predicted_Hz", "error_before_pct", "error_fitted_pct",
                "error_predicted_pct", "parameters_on_bounds", "followed_mac", "converged"],
               [[r["experimental_mode"], r["numerical_mode"], r["f_X_Hz"], "1", "1", "1", "-6.0", "2.0", "-3.0" if i else "7.0", "4", "0.99", "1"]
                for i, r in enumerate(updated)])
    write_sensitivity(results / "s5_sensitivity")
    write_updating(paper, results / "s6_updating")
    made_up_campaign.write_sensors(write_rows, results / "s2_sensors")
    made_up_campaign.write_identification(write_rows, read_rows, paper, results / "s3_identification")
    write_aerodynamics(paper, results / "s7_aerodynamics")
    write_validation(paper, results / "s8_validation")


def write_model(folder):
    """A straight strip of shells on two rows of nodes with a stay, and half waves as modes."""
    n = 21
    nodes = [[i + 1, 5.0 * (i // 2), 3.0 * (i % 2), 10.0] for i in range(2 * n)] + [[2 * n + 1, 50.0, 1.5, 40.0]]
    blank = [""] * 4
    elements = [[k + 1, "shell", "", "slab", "concrete", "slab", 2 * k + 1, 2 * k + 3, 2 * k + 4, 2 * k + 2] for k in range(n - 1)]
    elements += [[n + i, "stay", name, "stay_44", "steel", "stay", n + i, 2 * n + 1, *blank[:2]] for i, name in enumerate(("NE1", "NW1"))]
    write_rows(folder / "model/nodes.csv", ["node", "x_m", "y_m", "z_m"], nodes)
    write_rows(folder / "model/elements.csv",
               ["element", "type", "name", "group", "material", "section", "node1", "node2", "node3", "node4"], elements)
    write_rows(folder / "shapes.csv", ["mode", "point", "direction", "value"],
               [[mode, node, d, np.sin(mode * np.pi * x / 100.0) if d == "z" and z < 40 else 0.0]
                for mode in range(1, 16) for node, x, _, z in nodes for d in "xyz"])


def write_sensitivity(folder):
    names = [p[0] for p in PARAMETERS] + OTHERS
    relative = np.random.default_rng(7).uniform(0.0, 0.4, (15, len(names)))
    relative[:, [4, 5]] *= -1.0
    relative[:, 6:] *= 0.02
    write_rows(folder / "sensitivity.csv",
               ["mode", "parameter", "unit", "exact_Hz_per_unit", "relative", "richardson_Hz_per_unit", "forward_eq6_Hz_per_unit",
                "forward_truncation_Hz_per_unit"],
               [[m + 1, n, "-", 0, relative[m, j], 0, 0, 0] for m in range(15) for j, n in enumerate(names)])
    values = np.linalg.svd(relative[:, :9], compute_uv=False)
    write_rows(folder / "singular_values.csv", ["index", "value", "relative", "identifiable"],
               [[i + 1, v, v / values[0], int(i < 6)] for i, v in enumerate(values)])
    write_rows(folder / "identifiability.csv", ["parameter", "identifiable", "resolution"],
               [[p[0], int(i < 6), 0.9 if i < 6 else 0.1] for i, p in enumerate(PARAMETERS)])
    write_rows(folder / "selection.csv", ["parameter", "unit", "score", "rank", "selected", "published", "reason"],
               [[n, "-", 1.0 - 0.05 * j, j + 1, int(j < 9), int(j < 9), ""] for j, n in enumerate(names)])


def write_updating(paper, folder):
    printed = {r["parameter"]: r for r in read_rows(paper / "table_08.csv")}
    rows, history = [], []
    for name, unit, _, half, _ in PARAMETERS:
        factor = 1e6 if unit == "MPa" else 1.0
        start, change = float(printed[name]["initial_value"]) * factor, float(printed[name]["change_pct"])
        final = start * (1 + change / 100)
        bound = "lower" if change <= -100 * half + 1e-9 else "upper" if change >= 100 * half - 1e-9 else "none"
        rows.append([name, "Pa" if unit == "MPa" else unit, start, final, change, start * (1 - half), start * (1 + half), bound])
    write_rows(folder / "parameters.csv",
               ["parameter", "unit", "initial_value", "final_value", "change_pct", "lower", "upper", "bound"], rows)
    for start in (0, 1):
        for i in range(8):
            part = (1 - 0.5**i) if start == 0 else 0.6 * (1 - 0.6**i)
            history.append([start, 0, i, 0.006 * 0.5**i + 0.004 + 0.001 * start, 0.1 * 0.3**i, 0.1 * 0.5**i, 2.0 if i < 3 else 1.0]
                           + [1 + part * row[4] / 100 for row in rows])
    names = [row[0] for row in rows]
    write_rows(folder / "history.csv",
               ["start", "outer", "iteration", "cost", "projected_gradient", "step_norm", "trust_radius", *names], history)
    write_rows(folder / "starts.csv",
               ["start", "cost", "projected_gradient_relative", "iterations", "converged", "optimum", "message", *names],
               [[s, history[8 * s + 7][3], 1e-8, 8, 1, s + 1, "converged", *history[8 * s + 7][7:]] for s in (0, 1)])


def write_aerodynamics(paper, folder):
    """A straight deck in yawed wind: critical speeds 0.2 % above the paper's, one smooth curve for everything else."""
    critical = ["set", "model", "group", "description", "dampers", "structural_damping_pct", "mode", "V_cr_m_s", "f_cr_Hz", "ratio_to_A",
                "f_cr_over_f1", "theta_rms_deg", "exponent", "V_divergence_m_s", "status"]
    printed = read_rows(paper / "table_12.csv")
    rest = [1.0, 0.98, 30.0, 3.5, 300.0, "unstable"]
    rows = [["standin", r["ns"], r["group"], r["description"], "off", 0.5, 1, 1.002 * float(r["V_cr_m_per_s"]), float(r["f_cr_Hz"]), *rest]
            for r in printed]
    rows += [["standin", "A", "made up", "", "off", 1.1, 1, 44.0, 0.79, *rest],
             ["standin", "A", "made up", "", "on", 0.5, "", "", "", "", "", "", "", 300.0, "stable"]]
    rows += [["quasi_steady", ns, "made up", "", "off", 0.5, 1, speed, 0.79, *rest] for ns, speed in QUASI_STEADY.items()]
    write_rows(folder / "critical.csv", critical, rows)
    words = {r["ns"]: r for r in read_rows(paper / "table_11.csv")}
    write_rows(folder / "rules.csv",
               ["deployment", "deck", "beyond_deg", "model", "group", "description", "statics", "lookup_cos_power",
                "block_inverse_cos_power_force", "block_inverse_cos_power_cross", "block_inverse_cos_power_moment", "axes"],
               [[ns, "", "", ns, words[ns]["group"], f"NS #{words[ns]['ns_number_in_table12']}", statics, power, *block, axes]
                for ns, (statics, power, block, axes) in RULES_OF_11.items()])
    write_rows(folder / "nodes.csv",
               ["deck", "node", "station_m", "x_m", "y_m", "z_m", "yaw_deg", "angle_of_attack_deg", "chord_m", "length_m", "oblique_chord_m",
                "oblique_length_m"],
               [[deck, i + 1, 5.0 * i, 5.0 * i, y, 10.0, 30.0, 0.1 * i, 4.0, 5.0, 4.0 / 0.866, 5.0 * 0.866]
                for deck, y in (("foot", 20.0), ("cycle", 0.0)) for i in range(6)])
    write_rows(folder / "damping.csv",
               ["set", "model", "dampers", "structural_damping_pct", "mode", "V_m_s", "frequency_Hz", "damping_ratio_pct"],
               [[name, "A", dampers, xi, mode, v, 0.8 * mode, xi + (2 if dampers == "on" else 0) - (0.025 * v if mode == 1 else 0)]
                for name in ("standin", "quasi_steady") for dampers, xi in (("off", 0.5), ("off", 1.1), ("on", 0.5))
                for mode in (1, 2) for v in range(1, 41)])
    write_rows(folder / "galloping.csv", ["set", "deck", "angle_of_attack_deg", "V_over_fB", "h1", "den_hartog"],
               [[name, "foot", angle, v, -0.1 * v, -1.0] for name in ("standin", "quasi_steady") for angle in (-2.0, 0.0, 2.0) for v in (1, 5, 10)])
    write_rows(folder / "polars.csv", ["set", "deck", "angle_of_attack_deg", "C_D", "C_L", "C_M"],
               [[name, "foot", angle, 0.2, -0.1 * angle, 0.0] for name in ("standin", "quasi_steady") for angle in (-5.0, 0.0, 5.0)])
    write_rows(folder / "summary.csv", ["quantity", "value", "unit"], [["still_air_frequency_1", 0.8, "Hz"], ["design_speed", 40.0, "m/s"]])


def write_validation(paper, folder):
    """Errors that are not the paper's, zones that are."""
    write_rows(folder / "rms.csv", ["event", "run", "model", "channel", "direction", "rms_m_s2", "seed_deviation_m_s2", "measured_rms_m_s2",
                                    "error_pct", "error_low_pct", "error_high_pct"],
               [[event, run, "A", f"M{m}", axis, 0.1, 0.005, 0.1, 2.0 * m, 2.0 * m - 1.0, 2.0 * m + 1.0] for event in ("August", "April")
                for run in ("NS1", "NS2", "NS3") for m in range(1, 9) for axis in "xyz"])
    write_rows(folder / "comfort.csv", ["event", "run", "direction", "deck", "peak_m_s2", "limit_m_s2", "verdict"],
               [["August", "NS1", "vertical", "foot", 0.5, 0.7, "within"], ["April", "NS1", "vertical", "foot", 0.6, 0.7, "within"],
                ["April", "NS1", "lateral", "cycle", 0.2, 0.1, "exceeded"]])
    write_rows(folder / "statements.csv", ["statement", "found", "verdict"], [["Something is so", "3 of 4 cells", "miss"]])
    zones = [[r["deck"], r["theta_from_deg"], r["theta_to_deg"], "end" if "cos" in r["static_polar"] else "middle",
              *(("D", "cosine", 1, 2) if "cos" in r["static_polar"] else ("A", "normal", 0, 0))] for r in read_rows(paper / "table_14.csv")]
    write_rows(folder / "hybrid.csv", ["deck", "theta_from_deg", "theta_to_deg", "zone", "model", "statics", "lookup_cos_power",
                                       "block_inverse_cos_power"], zones)
    write_rows(folder / "hybrid_nodes.csv", ["deck", "node", "station_m", "x_m", "y_m", "yaw_deg", "model", "static_factor", "block_factor"],
               [[deck, i + 1, 20.0 * i - 50.0, 20.0 * i - 50.0, y, 20.0 * i - 50.0, "A" if 0 < i < 5 else "D", 1.0, 1.0]
                for deck, y in (("foot", 20.0), ("cycle", 0.0)) for i in range(6)])


def write_manifest(folder, inputs=()):
    """As the steps write it (src/io/manifest.cpp), with the parts that the report package reads. `inputs`: files that it was made from."""
    outputs = {p.relative_to(folder).as_posix(): hashlib.sha256(p.read_bytes()).hexdigest()
               for p in sorted(folder.rglob("*")) if p.is_file() and p.name != "manifest.json"}
    (folder / "manifest.json").write_text(json.dumps({
        "format": "twindeck-manifest-1", "step": folder.name, "status": "converged", "message": "", "seed": 1, "threads": 1,
        "seconds": 1.5, "version": "0.1.0", "commit": "0000000", "libraries": {}, "command_line": [folder.name],
        "config_toml": "", "inputs": {str(p): hashlib.sha256(Path(p).read_bytes()).hexdigest() for p in inputs}, "outputs": outputs}, indent=1), encoding="utf-8")
