"""One look for all figures, and bytes that do not change from run to run."""
import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402

INK, PALE, ACCENT, WARN, GOOD = "#1d2733", "#c3cad3", "#0b5fa5", "#b3261e", "#2e7d4f"

plt.rcParams.update({
    "font.family": "DejaVu Sans", "font.size": 9, "axes.edgecolor": INK, "axes.labelcolor": INK, "text.color": INK,
    "xtick.color": INK, "ytick.color": INK, "axes.spines.top": False, "axes.spines.right": False, "axes.titlesize": 10,
    "figure.dpi": 100, "savefig.dpi": 180, "pdf.fonttype": 42, "svg.hashsalt": "twindeck",
})


def save(figure, stem) -> list:
    """stem.pdf and stem.png, without dates. Returns the files."""
    figure.savefig(stem.with_suffix(".pdf"), metadata={"CreationDate": None})
    figure.savefig(stem.with_suffix(".png"), metadata={"Software": None})
    plt.close(figure)
    return [stem.with_suffix(".pdf"), stem.with_suffix(".png")]
