"""Fig. 3: the passive control system. (a) dampers in plan; (b), (c) schematics in place of the photographs of types B and C."""
import numpy as np
import pandas as pd

from ..errors import InputError
from ..study import Study
from .layout_plan import draw_plan
from .mesh import read_mesh
from .style import ACCENT, GOOD, INK, WARN, plt

NAME = "fig_03"
CAPTION = ("(a) Dampers in plan, drawn from the model's springs.csv: ring, acts vertically; arrow, acts along it. Their places are reconstructed (the "
           "paper's drawing is not available): the C dampers' because they bring Table 4 with dampers near. (b), (c) SCHEMATICS, not the paper's photographs: "
           "types A and B as spring and dashpot in series, C as a dashpot, with the constants of Table 1.")
NEEDS = ("s1_model",)
COLOURS = {"A": GOOD, "B": ACCENT, "C": WARN}


def draw(study: Study):
    mesh, dampers = read_mesh(study, "s1_model/model"), placed_dampers(study)
    figure = plt.figure(figsize=(10.4, 4.0))
    plan = figure.add_axes((0.055, 0.12, 0.60, 0.82))
    draw_plan(plan, mesh, 9.0)
    plan.set_ylabel("Y (m)")
    plan.set_title("(a)", loc="left")
    for row in dampers.itertuples():
        colour = COLOURS.get(row.damper[:1], INK)
        if abs(row.dz) > 0.9:
            plan.plot(row.x_m, row.y_m, "o", markerfacecolor="none", markeredgecolor=colour, markersize=9, markeredgewidth=1.6, zorder=3)
        else:
            plan.annotate("", (row.x_m + 6 * row.dx, row.y_m + 6 * row.dy), xytext=(row.x_m, row.y_m), zorder=3,
                          arrowprops={"arrowstyle": "<|-|>", "color": colour, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0})
        plan.annotate(row.damper, (row.x_m, row.y_m), xytext=_beside(row, dampers), textcoords="offset points", ha="center", va="center", fontsize=9,
                      color=colour, zorder=4)
    kinds = dampers.assign(type=dampers["damper"].str[:1]).drop_duplicates("type")
    for place, (_, row) in enumerate(kinds.iterrows()):
        axes = figure.add_axes((0.68, 0.66 - 0.3 * place, 0.3, 0.28))
        _schematic(axes, row, int((dampers["damper"].str[:1] == row["type"]).sum()))
    figure.text(0.68, 0.955, "(b), (c) schematic", fontsize=10)
    return figure, dampers


def placed_dampers(study: Study) -> pd.DataFrame:
    """damper, arrangement, constants, place and direction of every spring whose group begins with damper."""
    name = "s1_model/model/springs.csv"
    springs = study.step_csv(name, ["spring", "group", "node", "direction_x", "direction_y", "direction_z"])
    springs = springs[springs["group"].str.startswith("damper")].set_index("spring")
    nodes = study.step_csv("s1_model/model/nodes.csv", ["node", "x_m", "y_m", "z_m"]).set_index("node")
    constants = study.step_csv("s1_model/dampers.csv", ["damper", "damping_N_s_m", "stiffness_N_m", "arrangement"]).set_index("damper")
    if springs.empty:
        raise InputError(f"{study.results / name}: no spring whose group begins with damper")
    places = nodes.loc[springs["node"].astype(int)]
    table = constants.loc[springs.index, ["arrangement", "damping_N_s_m", "stiffness_N_m"]].reset_index()
    table.columns = ["damper", *table.columns[1:]]
    for column in ("x_m", "y_m", "z_m"):
        table[column] = places[column].to_numpy()
    for axis in "xyz":
        table[f"d{axis}"] = springs[f"direction_{axis}"].to_numpy()
    return table


def _beside(row, dampers):
    """Where the name goes [points]: away from the nearest other damper."""
    others = dampers[dampers["damper"] != row.damper]
    away = np.array([row.x_m, row.y_m]) - others[["x_m", "y_m"]].to_numpy()
    if not len(away):
        return 0, 13
    nearest = away[np.argmin(np.linalg.norm(away, axis=1))]
    if np.linalg.norm(nearest) > 12.0 or not np.linalg.norm(nearest):
        return (14, -4) if abs(row.dz) < 0.9 else (0, 13)
    return tuple(14 * nearest / np.linalg.norm(nearest))


def _schematic(axes, row, count):
    """Ground on the left, dashpot, spring (in series) or none, the deck on the right."""
    colour = COLOURS.get(row["type"], INK)
    axes.plot([0, 0], [-0.4, 0.4], color=INK, linewidth=1.2)
    for y in np.linspace(-0.4, 0.3, 5):
        axes.plot([-0.14, 0], [y, y + 0.12], color=INK, linewidth=0.7)
    series = row["arrangement"] == "series"
    end = 2.6 if series else 4.6
    middle = end / 2
    axes.plot([0, middle - 0.3], [0, 0], color=colour, linewidth=1.5)
    axes.plot([middle + 0.4, middle - 0.3, middle - 0.3, middle + 0.4], [0.26, 0.26, -0.26, -0.26], color=colour, linewidth=1.5)
    axes.plot([middle + 0.15, middle + 0.15], [-0.2, 0.2], color=colour, linewidth=2)
    axes.plot([middle + 0.15, end], [0, 0], color=colour, linewidth=1.5)
    if series:
        x = np.linspace(2.6, 4.2, 12)
        y = np.array([0, 0, *([0.2, -0.2] * 4), 0, 0])
        axes.plot(x, y, color=colour, linewidth=1.5)
        axes.plot([4.2, 4.6], [0, 0], color=colour, linewidth=1.5)
        axes.text(3.4, -0.36, f"k = {row['stiffness_N_m'] / 1e3:.1f} kN/m", ha="center", va="top", fontsize=8)
    axes.text(middle, -0.36, f"c = {row['damping_N_s_m'] / 1e3:.1f} kNs/m", ha="center", va="top", fontsize=8)
    axes.plot([4.6, 4.6], [-0.4, 0.4], color=INK, linewidth=3)
    axes.text(-0.1, 0.52, f"type {row['type']}, {count} units", fontsize=9, color=colour)
    axes.text(4.6, 0.5, "deck", fontsize=8, ha="center")
    axes.set_xlim(-0.4, 5.2)
    axes.set_ylim(-0.75, 0.75)
    axes.set_axis_off()
