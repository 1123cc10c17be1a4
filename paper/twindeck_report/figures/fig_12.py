"""Fig. 12: stabilisation diagram of the virtual campaign with dampers, ST1."""
from ..identified import WITH
from ..study import Study
from .identification import stabilisation_figure

NAME = "fig_12"
CAPTION = ("Stabilisation diagram of the virtual campaign with dampers, setup ST1, over the mean spectrum of its channels.")
NEEDS = ("s3_identification",)


def draw(study: Study):
    return stabilisation_figure(study, WITH)
