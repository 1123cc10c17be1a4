"""One module a figure: `NAME`, `CAPTION`, `NEEDS` (step files without which it is skipped) and `draw(study)`, which gives the
matplotlib figure and the plotted data."""
from . import fig_01, fig_05, sensitivity_map, updating_history

FIGURES = (fig_01, fig_05, sensitivity_map, updating_history)
