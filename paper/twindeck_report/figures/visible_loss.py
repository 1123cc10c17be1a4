"""Step 10: the smallest loss of thickness that a change of the measured frequencies reveals, on the plan of the bridge."""
import numpy as np

from ..study import Study
from .layout_plan import draw_plan
from .mesh import read_mesh
from .style import INK, plt

NAME = "visible_loss"
CAPTION = ("The smallest loss of thickness that two measurements of the frequencies reveal with the standard deviations of one measurement, 5 % false alarms and 5 % missed. "
           "Left: members by that loss, in per cent of the wall (of the radius of a rope); black: not seen before nine tenths of it are gone; grey: no corrosion was asked for. Right: the same "
           "in mm (full bars), and the loss from which it is told from losses of the other walls (outlines); beside it the years until then at the assumed rate.")
NEEDS = ("s10_reliability",)
FILES = ("s10_reliability/visible.csv",)  # written where the configuration names walls
DRAWS_MESH = True
MODEL = "s6_updating/model"
COLOURS = plt.cm.viridis_r
UNSEEN = "#1d1d1d"


def draw(study: Study):
    table = study.step_csv(FILES[0], ["wall", "section", "wall_thickness_m", "smallest_loss_m", "share_pct", "years", "located_loss_m"])
    elements = study.step_csv(f"{MODEL}/elements.csv", ["group", "section"]).dropna(subset=["section"])
    mesh = read_mesh(study, MODEL)
    figure, (plan, bars) = plt.subplots(1, 2, figsize=(11.5, 4.6), width_ratios=(2.2, 1))
    figure.subplots_adjust(0.05, 0.13, 0.95, 0.93, wspace=0.42)
    draw_plan(plan, mesh)
    plan.set_ylabel("Y (m)")
    largest = max(table["share_pct"].max(), 1e-9) if table["share_pct"].notna().any() else 1.0
    scale = plt.Normalize(0.0, largest)
    for row in table.to_dict("records"):
        colour = COLOURS(scale(row["share_pct"])) if row["share_pct"] == row["share_pct"] else UNSEEN
        groups = set(elements.loc[elements["section"] == row["section"], "group"])
        lines = mesh.lines[np.isin(mesh.groups, list(groups))]
        x, y = (np.hstack([mesh.points[lines][:, :, i], np.full((len(lines), 1), np.nan)]).ravel() for i in (0, 1))
        plan.plot(x, y, color=colour, linewidth=1.1, zorder=3)
        if len(lines) and np.ptp(mesh.points[lines][:, :, :2].reshape(-1, 2), axis=0).max() < 2.0:  # upright: a point in plan
            plan.plot(*mesh.points[lines][:, :, :2].reshape(-1, 2).mean(axis=0), "s", color=colour, markersize=6, zorder=4)
    bar = figure.colorbar(plt.cm.ScalarMappable(scale, COLOURS), ax=plan, fraction=0.025, pad=0.02)
    bar.set_label("smallest visible loss (% of the wall)")
    walls = table.drop_duplicates("wall").reset_index(drop=True)
    for i, row in enumerate(walls.to_dict("records")):
        seen = row["smallest_loss_m"] == row["smallest_loss_m"]
        bars.barh(i, 1e3 * (row["smallest_loss_m"] if seen else row["wall_thickness_m"]), color=COLOURS(scale(row["share_pct"])) if seen else UNSEEN, height=0.55)
        if row["located_loss_m"] == row["located_loss_m"]:
            bars.barh(i, 1e3 * row["located_loss_m"], fill=False, edgecolor=INK, height=0.72, linewidth=0.9)
        bars.annotate(f"year {row['years']:.0f}" if seen else "not seen", (bars.get_xlim()[1], i), fontsize=7, va="center", xytext=(1.02, i), textcoords=("axes fraction", "data"))
    bars.set_yticks(range(len(walls)), [named(table[table["wall"] == wall]["section"]) for wall in walls["wall"]], fontsize=7)
    bars.set_ylim(max(len(walls), 2) - 0.4, -0.6)
    bars.set_xlabel("loss of one surface (mm)")
    plan.set_title("by corroding wall", loc="left")
    return figure, table


def named(sections, between="\n") -> str:
    names = [name.replace("_", " ") for name in sections]
    return names[0] if len(names) == 1 else f"{names[0]}{between}and {len(names) - 1} more"
