"""Fig. 4: the permanent monitoring system."""
from ..study import Study
from .layout_plan import draw_plan, draw_sensors, layout_of
from .mesh import read_mesh
from .style import plt

NAME = "fig_04"
CAPTION = ("Accelerometers M1 to M8 of the permanent system, all vertical. Places are assumed from what section 6 says of M1, M5 and M8; those of "
           "thermometers and anemometers are not known.")
NEEDS = ("s1_model", "s2_sensors")


def draw(study: Study):
    mesh, layout = read_mesh(study, "s1_model/model"), layout_of(study, "M")
    figure, axes = plt.subplots(figsize=(8.4, 3.9))
    figure.subplots_adjust(0.08, 0.12, 0.99, 0.99)
    draw_plan(axes, mesh)
    draw_sensors(axes, layout, names=True)
    axes.set_ylabel("Y (m)")
    return figure, layout
