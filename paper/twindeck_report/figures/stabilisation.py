"""Stabilisation and cluster diagrams from tables of poles."""
from .style import ACCENT, GOOD, INK, PALE, WARN


def stable(poles):
    return (poles["stable_frequency"] == 1) & (poles["stable_damping"] == 1) & (poles["stable_shape"] == 1)


def draw_stabilisation(axes, poles, psd, band, label="order"):
    """Poles over frequency and order: all three criteria met (filled), frequency alone (open), new (dot); the mean spectrum behind."""
    poles = poles[poles["frequency_Hz"].between(*band)]
    whole = stable(poles)
    part = (poles["stable_frequency"] == 1) & ~whole
    rest = ~whole & ~part
    axes.plot(poles[rest]["frequency_Hz"], poles[rest][label], ".", color=PALE, markersize=3, label="new")
    axes.plot(poles[part]["frequency_Hz"], poles[part][label], "o", color=WARN, markersize=3.2, markerfacecolor="none", markeredgewidth=0.7,
              label="frequency stable")
    axes.plot(poles[whole]["frequency_Hz"], poles[whole][label], "o", color=ACCENT, markersize=3.2, label="frequency, damping, shape stable")
    if psd is not None:
        behind = axes.twinx()
        mean = psd[psd["frequency_Hz"].between(*band)].groupby("frequency_Hz")["psd_m2_s3"].mean()
        behind.semilogy(mean.index, mean, color="#8a94a0", linewidth=0.9, zorder=0)
        behind.set_ylabel("mean spectrum (m²/s³)", fontsize=8)
        behind.tick_params(labelsize=7)
        behind.spines["right"].set_visible(True)
        axes.set_zorder(behind.get_zorder() + 1)
        axes.patch.set_visible(False)
    axes.set_xlim(*band)
    axes.set_xlabel("frequency (Hz)")
    axes.set_ylabel("model order")


def draw_clusters(axes, poles, band, key, highest_damping):
    """Frequency against damping: poles of clusters coloured, the rest grey."""
    poles = poles[poles["frequency_Hz"].between(*band) & (poles["damping_ratio_pct"] < highest_damping)]
    rest = poles[poles[key].isna()]
    axes.plot(rest["frequency_Hz"], rest["damping_ratio_pct"], ".", color=PALE, markersize=3)
    colours = (ACCENT, WARN, GOOD, "#8a5a00", "#5b3a8c", "#00707a")
    for i, (_, rows) in enumerate(poles[poles[key].notna()].groupby(key)):
        axes.plot(rows["frequency_Hz"], rows["damping_ratio_pct"], "o", color=colours[i % len(colours)], markersize=3.2, alpha=0.7)
        f, z = rows["frequency_Hz"].median(), rows["damping_ratio_pct"].median()
        axes.plot(f, z, "+", color=INK, markersize=10, markeredgewidth=1.2)
        axes.annotate(f"{f:.3f} Hz", (f, z), xytext=(4, 6), textcoords="offset points", fontsize=7)
    axes.set_xlim(*band)
    axes.set_ylim(0, highest_damping)
    axes.set_xlabel("frequency (Hz)")
    axes.set_ylabel("damping ratio (%)")


