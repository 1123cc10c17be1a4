"""One module a figure: `NAME`, `CAPTION`, `NEEDS` (steps of the study, or files of its data, without which it is skipped), `FILES` (of steps, the same) where a step writes them on request, and `draw(study)`, which gives the
matplotlib figure and the plotted data."""
from . import (calibration_trade, damping_identified, diagnosis, fig_01, fig_02, fig_03, fig_04, fig_05, fig_06, fig_07, fig_08, fig_09, fig_10, fig_11, fig_12,
                   fig_13, fig_14, fig_15, fig_16, fig_17, fig_18, fig_19, fig_20, fig_21, fragility, identification_scoring, reliability_years, sensitivity_map, updating_history, visible_loss)

FIGURES = (fig_01, fig_02, fig_03, fig_04, fig_05, fig_06, fig_07, fig_08, fig_09, fig_10, fig_11, fig_12, fig_13, fig_14, fig_15, fig_16,
           fig_17, fig_18, fig_19, fig_20, fig_21, identification_scoring, damping_identified, sensitivity_map, updating_history, diagnosis,
           calibration_trade, fragility, reliability_years, visible_loss)

# Figures that say something of any structure; the others follow the paper's own.
OF_ANY_STUDY = ("fig_05", "sensitivity_map", "updating_history", "diagnosis", "fragility", "reliability_years", "visible_loss")


def figures_of(study) -> list:
    """The figures of a study's declared steps. A model made of matrices has no mesh to draw."""
    matrices = (study.results / "s1_model/model/dofs.csv").is_file()
    return [figure for figure in FIGURES if all(study.has(need) or (study.data / need).is_file() for need in figure.NEEDS)
            and all(study.path_of(file).is_file() for file in getattr(figure, "FILES", ()))
            and (study.has_paper() or figure.NAME in OF_ANY_STUDY) and not (matrices and getattr(figure, "DRAWS_MESH", False))]
