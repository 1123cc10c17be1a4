"""Stabilisation and cluster diagrams of the virtual campaign, setup ST1: Figures 10 and 11 without dampers, 12 and 13 with them."""
from ..identified import WITHOUT, folder_of, modes_of, with_dampers, without_dampers
from ..study import Study
from .stabilisation import draw_clusters, draw_stabilisation, name_modes, stable
from .style import ACCENT, plt

SETUP, BAND = "ST1", (0.5, 2.6)  # the paper's setup, and the band of its first ten modes [Hz]
COLUMNS = ["setup", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping", "stable_shape", "mode"]


def stabilisation_figure(study: Study, condition: str):
    poles = poles_of(study, condition)
    psd = study.step_csv(f"{folder_of(condition)}/psd.csv", ["channel", "frequency_Hz", "psd_m2_s3"])
    if "setup" in psd.columns:
        psd = psd[psd["setup"] == SETUP]
    figure, axes = plt.subplots(figsize=(8.4, 4.4))
    figure.subplots_adjust(0.08, 0.11, 0.91, 0.88)
    rows = without_dampers(study) if condition == WITHOUT else with_dampers(study)
    own = poles["mode"].isin(rows.values())
    draw_stabilisation(axes, poles, psd, BAND, own=own)
    found = modes_of(study, condition)["frequency_Hz"]
    name_modes(axes, {str(row): float(found[mode]) for row, mode in sorted(rows.items(), key=lambda pair: found[pair[1]])}, ACCENT)
    figure.legend(*axes.get_legend_handles_labels(), frameon=False, fontsize=8, ncols=4, loc="upper center")
    return figure, poles


def cluster_figure(study: Study, condition: str):
    poles = poles_of(study, condition)
    poles = poles[stable(poles)]
    figure, axes = plt.subplots(figsize=(8.4, 4.4))
    figure.subplots_adjust(0.08, 0.11, 0.98, 0.97)
    draw_clusters(axes, poles, BAND, "mode", 5.0)
    return figure, poles


def poles_of(study: Study, condition: str):
    poles = study.step_csv(f"{folder_of(condition)}/poles.csv", COLUMNS)
    return poles[(poles["setup"] == SETUP) & poles["frequency_Hz"].between(*BAND)]
