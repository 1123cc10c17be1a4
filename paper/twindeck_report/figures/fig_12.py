"""Fig. 12: stabilisation diagram of the virtual campaign with dampers, ST1."""
from ..identified import WITH
from ..study import Study
from .identification import stabilisation_figure

NAME = "fig_12"
CAPTION = ("Stabilisation diagram of the virtual campaign with dampers, setup ST1, over the mean spectrum of its channels. Lines and numbers: the modes of Table 4 "
           "that are found, from all setups; grey: other stable poles, most of them of stays.")
NEEDS = ("s3_identification",)


def draw(study: Study):
    return stabilisation_figure(study, WITH)
