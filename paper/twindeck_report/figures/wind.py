"""What the figures of step 7 share: the aerodynamic nodes, and the note that the aerodynamic data are synthetic."""
import numpy as np
import pandas as pd

from ..study import Study

SYNTHETIC = "Aerodynamic data are synthetic, not those of the wind tunnel."
NODE_COLUMNS = ["deck", "node", "station_m", "x_m", "y_m", "yaw_deg", "angle_of_attack_deg", "chord_m", "length_m",
                "oblique_chord_m", "oblique_length_m"]


def nodes(study: Study) -> pd.DataFrame:
    return study.step_csv("s7_aerodynamics/nodes.csv", NODE_COLUMNS)


def tangents(deck: pd.DataFrame) -> np.ndarray:
    """Unit vectors along a deck at its nodes, from their neighbours (n x 2)."""
    along = np.gradient(deck[["x_m", "y_m"]].to_numpy(), axis=0)
    return along / np.linalg.norm(along, axis=1, keepdims=True)
