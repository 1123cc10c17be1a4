"""Fig. 14: the first identified mode without and with dampers."""
import numpy as np
import pandas as pd
from matplotlib.collections import LineCollection

from ..errors import InputError
from ..identified import STEP, WITH, WITHOUT, mac, modes_of, shapes_of, with_dampers, without_dampers
from ..study import Study
from .fig_05 import view
from .layout_plan import DECKS
from .mesh import read_mesh
from .style import ACCENT, INK, PALE, plt

NAME = "fig_14"
CAPTION = ("First identified mode of the virtual campaign without and with dampers: the decks at rest in grey, and what the sensors along each edge move, "
           "vertically and radially (the largest is drawn as 8 m). The paper's frequencies are 0.75 and 0.92 Hz.")
NEEDS = ("s1_model", "s3_identification")
DRAWN_M = 8.0  # of the largest component
PLACES = ["x_m", "y_m", "z_m"]
DIRECTIONS = ["dx", "dy", "dz"]


def draw(study: Study):
    mesh = read_mesh(study, "s1_model/model")
    channels = study.step_csv(f"{STEP}/features/channels.csv", ["channel", "point", *PLACES, *DIRECTIONS]).set_index("channel")
    figure, both = plt.subplots(1, 2, figsize=(10.4, 2.5))
    figure.subplots_adjust(0.01, 0.01, 0.99, 0.9, wspace=0.02)
    chosen, kept = [], []
    for axes, condition, rows, words in zip(both, (WITHOUT, WITH), (without_dampers(study), with_dampers(study)), ("without dampers", "with dampers")):
        axes.add_collection(LineCollection(view(mesh.points)[mesh.part(*DECKS)], colors=PALE, linewidths=0.35))
        axes.autoscale_view()
        axes.set_aspect("equal")
        axes.set_axis_off()
        if 1 not in rows:
            if condition == WITHOUT:
                raise InputError(f"{study.path_of(STEP)}/modes.csv: no mode near the first of Table 4")
            axes.set_title("mode 1 was not found with dampers", loc="left")
            continue
        shape = shapes_of(study, condition)[rows[1]].dropna()
        chosen.append(shape)
        motion = _motion(_real(shape if len(chosen) == 1 else _turned(shape, chosen[0])), channels)
        for _, edge in motion.groupby("edge"):
            edge = edge.sort_values("station")
            rest, moved = view(edge[PLACES].to_numpy()), view(edge[PLACES].to_numpy() + DRAWN_M * edge[["u_x", "u_y", "u_z"]].to_numpy())
            axes.add_collection(LineCollection(np.stack([rest, moved], axis=1), colors=PALE, linewidths=0.8))
            axes.plot(*moved.T, color=ACCENT, linewidth=1.4, marker="o", markersize=2.5)
            axes.plot(*rest.T, color=INK, linewidth=0.6)
        axes.margins(0.03)
        kept.append(motion.assign(condition=condition))
        axes.set_title(f"mode 1 {words}: {modes_of(study, condition).at[rows[1], 'frequency_Hz']:.3f} Hz", loc="left")
    if len(chosen) == 2:
        both[1].set_title(f"{both[1].get_title(loc='left')}; MAC with the other {mac(*chosen):.2f}", loc="left")
    return figure, pd.concat(kept, ignore_index=True)


def _motion(shape, channels) -> pd.DataFrame:
    """Displacement of each point of the decks, from its channels. Points are named by deck, edge and station: FO-57.8."""
    found = channels.loc[channels.index.intersection(shape.index)]
    found = found.assign(**{f"u_{axis}": shape[found.index] * found[f"d{axis}"] for axis in "xyz"})
    points = found.groupby("point").agg({**dict.fromkeys(PLACES, "first"), "u_x": "sum", "u_y": "sum", "u_z": "sum"}).reset_index()
    name = points["point"].str.extract(r"^([A-Z]+)([-+]?[0-9.]+)$")
    return points.assign(edge=name[0], station=name[1].astype(float)).dropna(subset=["edge"])


def _turned(shape, reference):
    """By the phase that makes it most like the reference: up is up in both."""
    common = shape.index.intersection(reference.dropna().index)
    product = np.vdot(reference[common].to_numpy(complex), shape[common].to_numpy(complex))
    return shape * (abs(product) / product if product != 0 else 1.0)


def _real(shape):
    values = shape.to_numpy(complex).real
    return pd.Series(values / np.abs(values).max(), index=shape.index)
