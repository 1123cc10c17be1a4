"""What step 1 found out about its own model: pulls of the stays beside those measured on site, and what other meshes change."""
from ..study import Study

SHOWN_MODES = 13  # as many as the paper compares


def pulls(study: Study) -> list:
    """One row a stay; empty where the model has none."""
    if not (study.results / "s1_model/stays.csv").is_file():
        return []
    table = study.step_csv("s1_model/stays.csv", ["stay", "length_m", "pull_N", "site_pull_N", "stress_Pa"])
    measured = table["site_pull_N"].notna()
    table["site_kN"] = (table["site_pull_N"] / 1e3).map(lambda v: f"{v:.0f}").where(measured, "")
    table["deviation_pct"] = (100 * (table["pull_N"] / table["site_pull_N"] - 1)).map(lambda v: f"{v:+.1f}").where(measured, "")
    return [{"stay": r["stay"], "length_m": f"{r['length_m']:.2f}", "pull_kN": f"{r['pull_N'] / 1e3:.0f}", "site_kN": r["site_kN"],
             "deviation_pct": r["deviation_pct"], "stress_MPa": f"{r['stress_Pa'] / 1e6:.0f}"} for r in table.to_dict("records")]


def convergence(study: Study) -> list:
    """One row a mesh: its degrees of freedom and, in per cent, by how much each frequency differs from the study's own mesh."""
    if not (study.results / "s1_model/mesh_convergence.csv").is_file():
        return []
    table = study.step_csv("s1_model/mesh_convergence.csv", ["mesh", "degrees_of_freedom", "mode", "change_pct"])
    table["mesh"] = table["mesh"].fillna("")
    rows = []
    for mesh, part in table[table["mode"] <= SHOWN_MODES].groupby("mesh", sort=False):
        changes = part.sort_values("mode")["change_pct"]
        rows.append({"mesh": mesh or "the study's", "dofs": int(part["degrees_of_freedom"].iloc[0]),
                     "changes": ["" if change != change else f"{change:+.2f}" for change in changes] if mesh else ["0"] * len(changes)})
    return rows
