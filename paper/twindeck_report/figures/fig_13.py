"""Fig. 13: cluster diagram of the virtual campaign with dampers, ST1."""
from ..identified import WITH, folder_of
from ..study import Study
from .stabilisation import draw_clusters, stable
from .style import plt

NAME = "fig_13"
CAPTION = ("Cluster diagram of the virtual campaign with dampers, setup ST1: stable poles of all orders; coloured where they belong to a mode that was kept, crosses "
           "at the medians.")
NEEDS = ("s3_identification",)
BAND = (0.5, 2.6)


def draw(study: Study):
    poles = study.step_csv(f"{folder_of(WITH)}/poles.csv",
                           ["setup", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping", "stable_shape", "mode"])
    poles = poles[(poles["setup"] == "ST1") & stable(poles) & poles["frequency_Hz"].between(*BAND)]
    figure, axes = plt.subplots(figsize=(8.4, 4.4))
    figure.subplots_adjust(0.08, 0.11, 0.98, 0.97)
    draw_clusters(axes, poles, BAND, "mode", 5.0)
    return figure, poles
