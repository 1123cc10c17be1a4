"""Fig. 8: stabilisation diagram of the blind test, ST1."""
from ..study import Study
from .stabilisation import draw_stabilisation
from .style import plt

NAME = "fig_08"
CAPTION = ("Stabilisation diagram of the blind test with setup ST1, first of ten frames, orders 10 to 20 (criteria of section 3.1: frequency 2 %, damping "
           "1 %, MAC 0.95), over the mean spectrum.")
NEEDS = ("s2_sensors",)


def draw(study: Study):
    poles = study.step_csv("s2_sensors/blind_poles.csv", ["setup", "frame", "order", "frequency_Hz", "stable_frequency", "stable_damping", "stable_shape"])
    poles = poles[(poles["setup"] == "ST1") & (poles["frame"] == 1)]
    psd = study.step_csv("s2_sensors/blind_psd.csv", ["setup", "frequency_Hz", "psd_m2_s3"])
    figure, axes = plt.subplots(figsize=(8.4, 4.0))
    figure.subplots_adjust(0.08, 0.12, 0.91, 0.93)
    draw_stabilisation(axes, poles, psd[psd["setup"] == "ST1"], (0.5, 2.2))
    figure.legend(*axes.get_legend_handles_labels(), frameon=False, fontsize=8, ncols=3, loc="upper center")
    return figure, poles
