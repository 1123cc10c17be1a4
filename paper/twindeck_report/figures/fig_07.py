"""Fig. 7: Welch spectra of the blind test's signals, ST1 against DC1."""
import pandas as pd

from ..study import Study
from .style import ACCENT, GOOD, PALE, WARN, plt

NAME = "fig_07"
CAPTION = ("Welch power spectral densities of the simulated accelerations in setups ST1 and DC1 about the two close pairs, every channel in grey and their "
           "mean in blue. Lines: modes of the preliminary model, green where the blind test of that setup finds them, red and dashed where it never "
           "does. The paper's pairs lie at 1.518 and 1.546 Hz and at 1.666 and 1.702 Hz.")
NEEDS = ("s2_sensors",)
BAND = (1.45, 1.75)


def draw(study: Study):
    spectra = study.step_csv("s2_sensors/blind_psd.csv", ["setup", "channel", "frequency_Hz", "psd_m2_s3"])
    truth = study.step_csv("s2_sensors/blind_test.csv", ["setup", "mode", "frequency_Hz", "found"])
    truth = truth[truth["frequency_Hz"].between(*BAND)]
    spectra = spectra[spectra["setup"].isin(["ST1", "DC1"]) & spectra["frequency_Hz"].between(*BAND)]
    figure, both = plt.subplots(1, 2, figsize=(10.4, 3.8), sharey=True)
    figure.subplots_adjust(0.07, 0.13, 0.99, 0.88, wspace=0.09)
    for axes, setup in zip(both, ("ST1", "DC1")):
        table = spectra[spectra["setup"] == setup].pivot(index="frequency_Hz", columns="channel", values="psd_m2_s3")
        axes.semilogy(table.index, table, color=PALE, linewidth=0.5)
        axes.semilogy(table.index, table.mean(axis=1), color=ACCENT, linewidth=1.3)
        for row in truth[truth["setup"] == setup].to_dict("records"):
            found = row["found"] == 1
            axes.axvline(row["frequency_Hz"], color=GOOD if found else WARN, linewidth=1.0, linestyle="-" if found else (0, (4, 3)))
            axes.text(row["frequency_Hz"], 1.0, f"{row['mode']}{'' if found else ' missed'}", transform=axes.get_xaxis_transform(), fontsize=8, ha="center" if found else "right",
                      va="bottom", color=GOOD if found else WARN)
        axes.set_title(setup, loc="left", pad=16)
        axes.set_xlabel("frequency (Hz)")
        axes.set_xlim(*BAND)
    both[0].set_ylabel("m²/s³ (modal loads of 1 N²/kg/Hz)", fontsize=8)
    return figure, pd.DataFrame(spectra)
