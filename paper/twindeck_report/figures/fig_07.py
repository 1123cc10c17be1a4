"""Fig. 7: Welch spectra of the blind test's signals, ST1 against DC1."""
import pandas as pd

from ..study import Study
from .style import ACCENT, INK, PALE, plt

NAME = "fig_07"
CAPTION = ("Welch power spectral densities of the simulated accelerations in setups ST1 and DC1, every channel in grey and their mean in blue; dotted: "
           "frequencies of the preliminary model. The paper's close pairs lie at 1.518 and 1.546 Hz and at 1.666 and 1.702 Hz.")
NEEDS = ("s2_sensors",)
BAND = (0.5, 2.2)


def draw(study: Study):
    spectra = study.step_csv("s2_sensors/blind_psd.csv", ["setup", "channel", "frequency_Hz", "psd_m2_s3"])
    truth = study.step_csv("s2_sensors/blind_test.csv", ["setup", "mode", "frequency_Hz"])
    lines = truth[(truth["setup"] == truth["setup"].iloc[0]) & truth["frequency_Hz"].notna()]["frequency_Hz"]
    spectra = spectra[spectra["setup"].isin(["ST1", "DC1"]) & spectra["frequency_Hz"].between(*BAND)]
    figure, both = plt.subplots(1, 2, figsize=(10.4, 3.8), sharey=True)
    figure.subplots_adjust(0.07, 0.13, 0.99, 0.92, wspace=0.05)
    for axes, setup in zip(both, ("ST1", "DC1")):
        table = spectra[spectra["setup"] == setup].pivot(index="frequency_Hz", columns="channel", values="psd_m2_s3")
        axes.semilogy(table.index, table, color=PALE, linewidth=0.5)
        axes.semilogy(table.index, table.mean(axis=1), color=ACCENT, linewidth=1.3)
        for line in lines:
            axes.axvline(line, color=INK, linewidth=0.6, linestyle=(0, (1, 3)))
        axes.set_title(setup, loc="left")
        axes.set_xlabel("frequency (Hz)")
        axes.set_xlim(*BAND)
    both[0].set_ylabel("m²/s³ (modal loads of 1 N²/kg/Hz)", fontsize=8)
    return figure, pd.DataFrame(spectra)
