"""Fig. 9: cluster diagram of the blind test, ST1, zoom on the close modes."""
from ..study import Study
from .stabilisation import draw_clusters, stable
from .style import INK, plt

NAME = "fig_09"
CAPTION = ("Cluster diagram of the blind test with setup ST1: stable poles of all ten frames and orders in the range of the coupled modes. Coloured: poles "
           "of shapes with an index of recursion above 5 (Eq. 4) that are modes of the model; open: clusters that are none; crosses: medians; dotted: "
           "frequencies of the preliminary model.")
NEEDS = ("s2_sensors",)
BAND = (1.4, 1.8)


def draw(study: Study):
    poles = study.step_csv("s2_sensors/blind_poles.csv",
                           ["setup", "frame", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping", "stable_shape", "cluster"])
    poles = poles[(poles["setup"] == "ST1") & stable(poles) & poles["frequency_Hz"].between(*BAND)]
    truth = study.step_csv("s2_sensors/blind_test.csv", ["setup", "frequency_Hz", "found", "identified_frequency_Hz"])
    found = truth[(truth["setup"] == "ST1") & truth["frequency_Hz"].notna() & (truth["found"] == 1)]["identified_frequency_Hz"]
    medians = poles[poles["cluster"].notna()].groupby("cluster")["frequency_Hz"].median()
    modes = {(medians - f).abs().idxmin() for f in found if len(medians) and BAND[0] < f < BAND[1]}
    figure, axes = plt.subplots(figsize=(7.2, 4.2))
    figure.subplots_adjust(0.09, 0.12, 0.98, 0.97)
    draw_clusters(axes, poles, BAND, "cluster", 3.0, modes)
    for line in truth["frequency_Hz"].dropna().unique():
        if BAND[0] < line < BAND[1]:
            axes.axvline(line, color=INK, linewidth=0.7, linestyle=(0, (1, 3)))
    return figure, poles
