"""Fig. 5: shapes of modes 1 and 2 of the preliminary model."""
import numpy as np
import pandas as pd
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap

from ..study import Study
from .layout_plan import DECKS, MARGIN
from .mesh import displacements, read_mesh
from .style import INK, PALE, plt

NAME = "fig_05"
CAPTION = ("Modes 1 and 2 of the preliminary model: undeformed in grey, deformed coloured by the size of the displacement "
           "(largest = 1). Above from the side and above, below the vertical motion over the plan.")
NEEDS = ("s1_model",)
DRAWS_MESH = True
MODES = (1, 2)
AZIMUTH, ELEVATION = 24.0, 24.0  # of the view, in degrees
SIZES = ListedColormap(plt.cm.plasma_r(np.linspace(0.08, 0.93, 256)))  # the palest end would not be seen
LARGEST = 0.08  # drawn displacement over the largest extent of the bridge


def draw(study: Study):
    mesh = read_mesh(study, "s1_model/model")
    frequencies = study.step_csv("s1_model/modes.csv", ["mode", "frequency_Hz"]).set_index("mode")["frequency_Hz"]
    shapes = {mode: displacements(study, "s1_model/shapes.csv", mode, mesh) for mode in MODES}
    figure, axes = plt.subplots(2, 2, figsize=(10.4, 5.6), height_ratios=(1.45, 1))
    figure.subplots_adjust(0.05, 0.085, 0.93, 0.94, hspace=0.04, wspace=0.08)
    for (space, plan), mode in zip(axes.T, MODES):
        moved = _deformed(space, mesh, shapes[mode])
        space.set_title(f"Mode {mode}N: {frequencies[mode]:.3f} Hz", fontsize=11)
        bar = _plan(plan, mesh, shapes[mode])
        plan.set_xlabel("X (m)")
    axes[1, 0].set_ylabel("Y (m)")
    colours = figure.add_axes((0.945, 0.1, 0.009, 0.26))
    figure.colorbar(bar, cax=colours).outline.set_visible(False)
    colours.set_title("vertical", fontsize=8)
    colours.tick_params(labelsize=8)
    sizes = figure.add_axes((0.945, 0.5, 0.009, 0.36))
    figure.colorbar(moved, cax=sizes).outline.set_visible(False)
    sizes.set_title("size", fontsize=8)
    sizes.tick_params(labelsize=8)
    data = pd.concat([_data(mesh, mode, shapes[mode]) for mode in MODES], ignore_index=True)
    return figure, data


def view(points):
    """Parallel projection, seen from -Y turned by AZIMUTH and from ELEVATION above: (n x 3) -> (n x 2)."""
    azimuth, elevation = np.radians(AZIMUTH), np.radians(ELEVATION)
    along = points @ np.array([np.cos(azimuth), -np.sin(azimuth), 0.0])
    away = points @ np.array([np.sin(azimuth), np.cos(azimuth), 0.0])
    return np.column_stack([along, points[:, 2] * np.cos(elevation) + away * np.sin(elevation)])


def _deformed(axes, mesh, shape):
    """Rest shape light, deformed shape coloured by the size of its displacement."""
    moved = mesh.points + LARGEST * np.ptp(mesh.points, axis=0).max() * shape / np.abs(shape).max()
    axes.add_collection(LineCollection(view(mesh.points)[mesh.lines], colors=PALE, linewidths=0.35))
    size = np.linalg.norm(shape, axis=1)
    share = size[mesh.lines].mean(axis=1) / size.max()
    order = np.argsort(share, kind="stable")  # what moves most lies on top
    drawn = LineCollection(view(moved)[mesh.lines[order]], array=share[order], cmap=SIZES, norm=plt.Normalize(0.0, 1.0), linewidths=0.55)
    axes.add_collection(drawn)
    axes.autoscale_view()
    axes.margins(0.02)
    axes.set_aspect("equal")
    axes.set_axis_off()
    return drawn


def _plan(axes, mesh, shape):
    """Plan: vertical motion, up red and down blue."""
    axes.plot(*_pairs(mesh.points[mesh.lines]), color=PALE, linewidth=0.25, zorder=1)
    vertical = shape[:, 2] / np.abs(shape).max()
    order = np.argsort(np.abs(vertical), kind="stable")
    picture = axes.scatter(mesh.points[order, 0], mesh.points[order, 1], c=vertical[order], cmap="RdBu_r", vmin=-1, vmax=1, s=5,
                           linewidths=0, zorder=2, rasterized=True)
    axes.set_aspect("equal")
    lower, upper = mesh.extent(*DECKS)
    axes.set_xlim(lower[0] - MARGIN, upper[0] + MARGIN)
    axes.set_ylim(lower[1] - MARGIN, upper[1] + MARGIN)
    axes.tick_params(labelsize=8)
    axes.spines["left"].set_color(INK)
    return picture


def _pairs(lines):
    """x and y of many lines as two rows, with gaps between them."""
    gap = np.full((len(lines), 1), np.nan)
    return [np.hstack([lines[:, :, i], gap]).ravel() for i in (0, 1)]


def _data(mesh, mode, shape):
    return pd.DataFrame({"mode": mode, "node": mesh.ids, "x_m": mesh.points[:, 0], "y_m": mesh.points[:, 1],
                         "z_m": mesh.points[:, 2], "shape_x": shape[:, 0], "shape_y": shape[:, 1], "shape_z": shape[:, 2]})
