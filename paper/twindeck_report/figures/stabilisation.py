"""Stabilisation and cluster diagrams from tables of poles."""
from .style import ACCENT, GOOD, INK, PALE, WARN


def stable(poles):
    return (poles["stable_frequency"] == 1) & (poles["stable_damping"] == 1) & (poles["stable_shape"] == 1)


def draw_stabilisation(axes, poles, psd, band, label="order", own=None):
    """Poles over frequency and order: all three criteria met (filled), frequency alone (open), new (dot); the mean spectrum behind.
    @param own  which poles are those of the modes that are looked for; the other stable ones, mostly stays', are grey"""
    poles = poles[poles["frequency_Hz"].between(*band)]
    whole = stable(poles)
    part = (poles["stable_frequency"] == 1) & ~whole
    rest = ~whole & ~part
    axes.plot(poles[rest]["frequency_Hz"], poles[rest][label], ".", color=PALE, markersize=3, label="new")
    axes.plot(poles[part]["frequency_Hz"], poles[part][label], "o", color=WARN, markersize=3.2, markerfacecolor="none", markeredgewidth=0.7,
              label="frequency stable")
    if own is not None:
        other = whole & ~own.reindex(poles.index)
        axes.plot(poles[other]["frequency_Hz"], poles[other][label], "o", color="#8a94a0", markersize=3.2, label="stable, no mode of Table 4")
        whole = whole & ~other
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


def name_modes(axes, frequencies: dict, colour) -> None:
    """Names at the top edge with a line down: {name: frequency}."""
    for (name, f), place in zip(frequencies.items(), apart(list(frequencies.values()), 0.02 * (axes.get_xlim()[1] - axes.get_xlim()[0]), axes.get_xlim())):
        axes.axvline(f, color=colour, linewidth=0.7, alpha=0.6, zorder=0)
        axes.text(place, 1.0, name, transform=axes.get_xaxis_transform(), fontsize=8, ha="center", va="bottom", color=colour)


def draw_clusters(axes, poles, band, key, highest_damping, modes=None):
    """Frequency against damping: poles of clusters coloured, the rest grey. Medians are named in a row at the top.
    @param modes  the clusters that are modes; None: all. The others' poles are open and grey"""
    poles = poles[poles["frequency_Hz"].between(*band) & (poles["damping_ratio_pct"] < highest_damping)]
    rest = poles[poles[key].isna()]
    if modes is not None:
        none = poles[poles[key].notna() & ~poles[key].isin(modes)]
        axes.plot(none["frequency_Hz"], none["damping_ratio_pct"], "o", color="#8a94a0", markersize=3.2, markerfacecolor="none", markeredgewidth=0.7)
        poles = poles[poles[key].isin(modes)]
    axes.plot(rest["frequency_Hz"], rest["damping_ratio_pct"], ".", color=PALE, markersize=3)
    colours = (ACCENT, WARN, GOOD, "#8a5a00", "#5b3a8c", "#00707a")
    medians = []
    for i, (_, rows) in enumerate(poles[poles[key].notna()].groupby(key)):
        colour = colours[i % len(colours)]
        axes.plot(rows["frequency_Hz"], rows["damping_ratio_pct"], "o", color=colour, markersize=3.2, alpha=0.7)
        medians.append((rows["frequency_Hz"].median(), rows["damping_ratio_pct"].median(), colour))
    axes.set_xlim(*band)
    axes.set_ylim(0, 1.13 * highest_damping)  # the names stand above every pole
    medians.sort()
    for (f, z, colour), place in zip(medians, apart([f for f, *_ in medians], 0.022 * (band[1] - band[0]), band)):
        axes.plot(f, z, "+", color=INK, markersize=10, markeredgewidth=1.2)
        axes.plot([f, place], [z, 1.01 * highest_damping], color=colour, linewidth=0.5, alpha=0.5, zorder=0)
        axes.text(place, 1.015 * highest_damping, f"{f:.3f} Hz", fontsize=7, rotation=90, ha="center", va="bottom", color=colour)
    axes.set_xlabel("frequency (Hz)")
    axes.set_ylabel("damping ratio (%)")


def apart(places: list, least: float, band: tuple) -> list:
    """Sorted places moved as little as needed to lie at least `least` from each other: groups that touch spread about their mean."""
    groups = []
    for place in places:
        groups.append([place])
        while len(groups) > 1 and _spread(groups[-1], least)[0] - _spread(groups[-2], least)[-1] < least:
            last = groups.pop()
            groups[-1] += last
    return [min(max(p, band[0] + least / 2), band[1] - least / 2) for group in groups for p in _spread(group, least)]


def _spread(group: list, least: float) -> list:
    middle = sum(group) / len(group)
    return [middle + (i - (len(group) - 1) / 2) * least for i in range(len(group))]
