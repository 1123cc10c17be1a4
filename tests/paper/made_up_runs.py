"""Made-up results folders for comparing two runs: numbers that are known because they are written here."""
import hashlib
import json

import made_up_study

MODES = ["mode", "frequency_Hz", "frequency_std_Hz", "damping_ratio_pct", "damping_ratio_std_pct"]
PARAMETERS = ["parameter", "unit", "initial_value", "final_value", "change_pct", "lower", "upper", "bound"]
PAIRS = ["stage", "experimental_mode", "numerical_mode", "measured_Hz", "computed_Hz", "error_pct", "mac", "pairing"]
CRITICAL = ["set", "model", "dampers", "structural_damping_pct", "mode", "V_cr_m_s", "f_cr_Hz", "status"]
# Three shapes at three channels, orthogonal, and a fourth that is none of them
SHAPES = {1: (1.0, 0.5, 0.0), 2: (-0.5, 1.0, 0.0), 3: (0.0, 0.0, 1.0)}


def write_step(folder, step, tables, config="", inputs=None, seed=1, version="0.1.0", warnings=(), root=None, texts=None):
    """A finished step: `tables` as {file: (header, rows)}, `texts` as {file: text}, and a manifest that fits them."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, (header, rows) in tables.items():
        made_up_study.write_rows(folder / name, header, rows)
    for name, text in (texts or {}).items():
        (folder / name).write_text(text, encoding="utf-8")
    outputs = {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in (*tables, *(texts or {}))}
    manifest = {"format": "twindeck-manifest-1", "step": step, "status": "converged", "message": "", "warnings": list(warnings), "seed": seed,
                "version": version, "commit": "0" * 40, "libraries": {"Eigen": "3.4.0"}, "config_toml": config,
                "command_line": [f"build/bin/{step}", "--out", f"{root or folder.parent}/{step}"], "inputs": inputs or {}, "outputs": outputs}
    (folder / "manifest.json").write_text(json.dumps(manifest), encoding="utf-8")
    return folder


def shape_rows(shapes):
    return [[mode, f"P{i}", "z", value] for mode, shape in shapes.items() for i, value in enumerate(shape, 1)]


def identified(folder, frequencies, shapes, config="blocks = 20\nband.highest = 8  # Hz\n", **more):
    """Step 3 with modes at `frequencies`, 5 mHz and 0.1 % of standard deviation, 1 % of damping."""
    modes = [[mode, f, 0.005, 1.0, 0.1] for mode, f in enumerate(frequencies, 1)]
    return write_step(folder / "s3_identification", "s3_identification",
                      {"modes.csv": (MODES, modes), "shapes.csv": (["mode", "point", "direction", "value"], shape_rows(shapes))}, config, **more)


def identified_in(folder, conditions):
    """Step 3 with one mode in each of `conditions`, {name: frequency}, the first one's in modes.csv, as poles.csv says."""
    first = next(iter(conditions))
    tables = {"modes.csv" if c == first else f"conditions/{c}/modes.csv": (MODES, [[1, f, 0.005, 1.0, 0.1]]) for c, f in conditions.items()}
    for name in tables:
        (folder / "s3_identification" / name).parent.mkdir(parents=True, exist_ok=True)
    return write_step(folder / "s3_identification", "s3_identification", tables | {"poles.csv": (["setup", "order", "condition"], [["S1", 2, first]])})


def updated(folder, parameters, computed=2.0, **more):
    """Step 6 with `parameters` as {name: final value} between 0 and 2, and one pair."""
    return write_step(folder / "s6_updating", "s6_updating",
                      {"parameters.csv": (PARAMETERS, [[name, "-", 1, value, 100 * (value - 1), 0, 2, "upper" if value == 2 else "none"]
                                                       for name, value in parameters.items()]),
                       "comparison.csv": (PAIRS, [["after", "1X", "1N", 2.0, computed, 50 * (computed - 2.0), 0.99, "mac"]])}, **more)


def in_wind(folder, speeds):
    """Step 7 with `speeds` as {(model, structural damping in per cent): critical speed}, dampers off."""
    rows = [["standin", model, "off", damping, 1, speed, 0.7, "unstable"] for (model, damping), speed in speeds.items()]
    return write_step(folder / "s7_aerodynamics", "s7_aerodynamics", {"critical.csv": (CRITICAL, rows)})


def diagnosed(folder, told):
    """Step 9 with a diagnosis.json."""
    return write_step(folder / "s9_diagnosis", "s9_diagnosis", {}, texts={"diagnosis.json": json.dumps(told)})
