"""Writes what the engineer has of a trial: the published model, as the study makes it, and the features of the test."""
import hidden
import numpy as np


INCH_m = 0.0254
DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")
COSINES = ("1,0,0", "0,1,0", "0,0,1")


def write_model(data, folder, bridge, joints=False):
    """folder/model, one for all trials. As the study has it each degree of freedom is a node of its own, without coordinates, because none are published.
    @param joints  name joints and directions with coordinates instead"""
    hidden.make_inputs.main(data, folder)
    if joints:
        text = "dof,node,direction,x_m,y_m,z_m\n"
        for dof, (joint, direction) in enumerate(zip(bridge.joint_of, bridge.direction)):
            text += f"{dof + 1},j{joint},{DIRECTIONS[direction]}," + ",".join(f"{INCH_m * x:.6g}" for x in bridge.place[joint]) + "\n"
        (folder / "model" / "dofs.csv").write_text(text, encoding="utf-8")
    return folder / "model"


def measurement(bridge, trial):
    """(condition, frequencies, shapes) of each condition, with noise."""
    random = np.random.default_rng([92, trial.seed, trial.number])
    for condition, _, temperature, acts in trial.conditions():
        found, shapes = hidden.measured_modes(bridge, trial.truth, trial.cause if acts else None, trial.channels, trial.modes, temperature)
        yield (
            condition,
            found * (1.0 + hidden.FREQUENCY * random.standard_normal(found.shape)),
            (shapes + trial.shape_deviation * random.standard_normal(shapes.shape)) * random.choice((-1.0, 1.0), len(found)),
        )


def write_features(folder, bridge, trial, joints=False):
    folder.mkdir(parents=True, exist_ok=True)
    rows = ["type,mode,channel,condition,value,std"]
    for condition, found, shapes in measurement(bridge, trial):
        for m, frequency in enumerate(found):
            rows.append(f"frequency_Hz,{m + 1},,{condition},{frequency:.12g},{hidden.FREQUENCY * frequency:.6g}")
            rows += [f"shape,{m + 1},{hidden.channel(dof)},{condition},{value:.12g},{trial.shape_deviation:.6g}" for dof, value in zip(trial.channels, shapes[:, m])]
    (folder / "rows.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    channels = "channel,point,dx,dy,dz\n" if joints else "channel,point\n"
    for dof in trial.channels:
        channels += f"{hidden.channel(dof)}," + (f"j{bridge.joint_of[dof]},{COSINES[bridge.direction[dof]]}\n" if joints else f"n{dof + 1}\n")
    (folder / "channels.csv").write_text(channels, encoding="utf-8")
    text = ""
    for condition, state, temperature, _ in trial.conditions():
        text += f"[{condition}]\n" + (f'state = "{state}"\n' if state else "") + (f"temperature_C = {temperature}\n" if temperature is not None else "") + "\n"
    (folder / "conditions.toml").write_text(text, encoding="utf-8")
