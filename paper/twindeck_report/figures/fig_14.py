"""Fig. 14: the first identified mode without and with dampers."""
import numpy as np
import pandas as pd

from ..errors import InputError
from ..identified import STEP, WITH, WITHOUT, mac, modes_of, shapes_of, with_dampers, without_dampers
from ..study import Study
from .layout_plan import draw_plan
from .mesh import read_mesh
from .style import WARN, ACCENT, plt

NAME = "fig_14"
CAPTION = ("First identified mode of the virtual campaign without and with dampers: vertical motion at the sensors (largest = 1) as bars over the plan, up "
           "in blue and down in red. The paper's frequencies are 0.75 and 0.92 Hz.")
NEEDS = ("s1_model", "s3_identification")


def draw(study: Study):
    mesh = read_mesh(study, "s1_model/model")
    channels = study.step_csv(f"{STEP}/features/channels.csv", ["channel", "x_m", "y_m", "dz"]).set_index("channel")
    figure, both = plt.subplots(1, 2, figsize=(10.4, 3.6), sharey=True)
    figure.subplots_adjust(0.055, 0.12, 0.995, 0.86, wspace=0.03)
    chosen, kept = [], []
    for axes, condition, rows, words in zip(both, (WITHOUT, WITH), (without_dampers(study), with_dampers(study)), ("without dampers", "with dampers")):
        draw_plan(axes, mesh, 16.0)
        if 1 not in rows:
            if condition == WITHOUT:
                raise InputError(f"{study.results / STEP}/modes.csv: no mode near the first of Table 4")
            axes.set_title("mode 1 was not found with dampers", loc="left")
            continue
        shape = shapes_of(study, condition)[rows[1]]
        chosen.append(shape)
        vertical = shape[channels["dz"].reindex(shape.index).abs() > 0.9].dropna()
        vertical = _real(vertical if len(chosen) == 1 else _turned(vertical, chosen[0]))
        places = channels.loc[vertical.index]
        # A bar of 20 m on the plan is the largest component.
        for (name, value), x, y in zip(vertical.items(), places["x_m"], places["y_m"]):
            colour = ACCENT if value > 0 else WARN
            axes.plot([x, x], [y, y + 20 * value], color=colour, linewidth=2)
            axes.plot(x, y + 20 * value, "o", color=colour, markersize=4)
            kept.append({"condition": condition, "channel": name, "x_m": x, "y_m": y, "vertical": value})
        axes.set_title(f"mode 1 {words}: {modes_of(study, condition).at[rows[1], 'frequency_Hz']:.3f} Hz", loc="left")
    if len(chosen) == 2:
        figure.suptitle(f"MAC of the two {mac(*chosen):.2f}", fontsize=9)
    both[0].set_ylabel("Y (m)")
    return figure, pd.DataFrame(kept)


def _turned(shape, reference):
    """By the phase that makes it most like the reference: up is up in both."""
    common = shape.index.intersection(reference.dropna().index)
    product = np.vdot(reference[common].to_numpy(complex), shape[common].to_numpy(complex))
    return shape * (abs(product) / product if product != 0 else 1.0)


def _real(shape):
    values = shape.to_numpy(complex).real
    return pd.Series(values / np.abs(values).max(), index=shape.index)
