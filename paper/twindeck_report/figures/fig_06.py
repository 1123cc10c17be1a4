"""Fig. 6: setups ST1 and DC1."""
import pandas as pd

from ..study import Study
from .layout_plan import draw_plan, draw_sensors, layout_of, legend
from .mesh import read_mesh
from .style import plt

NAME = "fig_06"
CAPTION = ("Setups String 1 and Dec 1, 16 channels each. String 1 is laid out by us on a line along each deck; Dec 1 is, of 500 setups drawn freely "
           "from the same points, the one that decouples the first ten modes of the preliminary model best (R_k in Table 3).")
NEEDS = ("s1_model", "s2_sensors")


def draw(study: Study):
    mesh = read_mesh(study, "s1_model/model")
    scores = study.step_csv("s2_sensors/setups.csv", ["setup", "R_k"]).set_index("setup")["R_k"]
    figure, both = plt.subplots(1, 2, figsize=(10.4, 2.9), sharey=True)
    figure.subplots_adjust(0.055, 0.15, 0.995, 0.92, wspace=0.03)
    kept = []
    for axes, setup in zip(both, ("ST1", "DC1")):
        kept.append(layout_of(study, setup))
        draw_plan(axes, mesh)
        draw_sensors(axes, kept[-1])
        axes.set_title(f"{setup}: R_k = {scores[setup]:.4f}", loc="left")
    both[0].set_ylabel("Y (m)")
    legend(both[1])
    return figure, pd.concat(kept, ignore_index=True)
