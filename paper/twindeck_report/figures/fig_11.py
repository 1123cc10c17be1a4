"""Fig. 11: cluster diagram of the virtual campaign without dampers, ST1."""
from ..identified import WITHOUT
from ..study import Study
from .identification import cluster_figure

NAME = "fig_11"
CAPTION = ("Cluster diagram of the virtual campaign without dampers, setup ST1: stable poles of all orders; coloured where they belong to a mode that "
           "was kept, crosses at the medians.")
NEEDS = ("s3_identification",)


def draw(study: Study):
    return cluster_figure(study, WITHOUT)
