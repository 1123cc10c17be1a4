"""Fig. 12: stabilisation diagram of the virtual campaign with dampers, ST1."""
from ..identified import WITH, folder_of
from ..study import Study
from .stabilisation import draw_stabilisation
from .style import plt

NAME = "fig_12"
CAPTION = "Stabilisation diagram of the virtual campaign with dampers, setup ST1, over the mean spectrum of its channels."
NEEDS = ("s3_identification",)
BAND = (0.5, 2.6)


def draw(study: Study):
    folder = folder_of(WITH)
    poles = study.step_csv(f"{folder}/poles.csv", ["setup", "order", "frequency_Hz", "stable_frequency", "stable_damping", "stable_shape"])
    psd = study.step_csv(f"{folder}/psd.csv", ["channel", "frequency_Hz", "psd_m2_s3"])
    poles = poles[(poles["setup"] == "ST1") & poles["frequency_Hz"].between(*BAND)]
    if "setup" in psd.columns:
        psd = psd[psd["setup"] == "ST1"]
    figure, axes = plt.subplots(figsize=(8.4, 4.4))
    figure.subplots_adjust(0.08, 0.11, 0.91, 0.93)
    draw_stabilisation(axes, poles, psd, BAND)
    figure.legend(*axes.get_legend_handles_labels(), frameon=False, fontsize=8, ncols=3, loc="upper center")
    return figure, poles
