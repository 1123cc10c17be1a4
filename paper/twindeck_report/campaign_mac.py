"""MAC between modes of a model and the modes identified from the campaign, over the channels at the decks (paper Eq. 2)."""
import numpy as np
import pandas as pd

from .errors import InputError
from .identified import STEP, WITHOUT, mac, shapes_of, without_dampers
from .study import Study

NEAR_M = 0.5  # a channel further from every node of the model is not compared


def mac_table(study: Study, step: str, numerical: list, experimental: list) -> pd.DataFrame:
    """Rows modes of the model in `step`, columns rows of Table 4 ("1X"); NaN for a mode that the campaign does not show.
    Identified shapes are complex: |phi_a^H phi_e|^2 in place of Eq. 2's real products."""
    found, rows = shapes_of(study, WITHOUT), without_dampers(study)
    model = _at_channels(study, step, found.index, numerical)
    table = pd.DataFrame(np.nan, index=numerical, columns=experimental)
    for name in experimental:
        row = int(name.rstrip("X"))
        if row in rows:
            shape = found[rows[row]]
            for mode in numerical:
                table.at[mode, name] = mac(shape, model[mode])
    return table


def _at_channels(study: Study, step: str, channels, modes: list) -> pd.DataFrame:
    """A model's modes as the channels see them: displacement of the nearest node along each channel's direction."""
    places = study.step_csv(f"{STEP}/features/channels.csv", ["channel", "x_m", "y_m", "z_m", "dx", "dy", "dz"]).set_index("channel")
    places = places.loc[places.index.intersection(channels)]
    nodes = study.step_csv(f"{step}/model/nodes.csv", ["node", "x_m", "y_m", "z_m"])
    points = nodes[["x_m", "y_m", "z_m"]].to_numpy(float)
    distances = np.linalg.norm(places[["x_m", "y_m", "z_m"]].to_numpy(float)[:, None, :] - points[None, :, :], axis=2)
    near = distances.min(axis=1) <= NEAR_M
    places, nearest = places[near], nodes["node"].to_numpy()[distances.argmin(axis=1)][near]
    shapes = study.step_csv(f"{step}/shapes.csv", ["mode", "point", "direction", "value"])
    shapes = shapes[shapes["point"].astype(str).isin({str(n) for n in nearest})]
    found = {}
    for mode in modes:
        own = shapes[shapes["mode"] == int(mode.rstrip("N"))]
        if own.empty:
            raise InputError(f"{study.results / step}/shapes.csv: no mode {mode} at the channels' nodes; compute more modes")
        table = own.assign(point=own["point"].astype(str)).pivot(index="point", columns="direction", values="value")
        moved = table.reindex(index=[str(n) for n in nearest], columns=["x", "y", "z"]).fillna(0.0).to_numpy()
        found[mode] = (moved * places[["dx", "dy", "dz"]].to_numpy(float)).sum(axis=1)
    return pd.DataFrame(found, index=places.index)
