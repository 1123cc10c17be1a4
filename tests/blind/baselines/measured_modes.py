"""Modes of a features folder, paired with those of a model by shape: what the baselines read."""
import csv
import dataclasses

import numpy as np
from scipy.optimize import linear_sum_assignment

LEAST_MAC = 0.6  # [-] a measured mode less alike than this to every free mode of the model is left out


@dataclasses.dataclass
class Mode:
    frequency_Hz: float
    frequency_std_Hz: float
    shape: np.ndarray      # real, unit norm, in the order of `channels`
    shape_std: np.ndarray
    imaginary: np.ndarray  # what is left of the shape across its best real form, same norm
    imaginary_std: np.ndarray


def read_modes(rows_csv, channels):
    """condition -> list of modes by frequency. Complex shapes are turned to their best real form; modes that lack a channel are left out."""
    found = {}
    with open(rows_csv, newline="", encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            if row["type"] in ("frequency_Hz", "shape", "shape_imag"):
                mode = found.setdefault(row["condition"], {}).setdefault(row["mode"], {})
                mode[row["type"], row["channel"]] = (float(row["value"]), float(row["std"]))
    return {condition: sorted(of_condition(modes, channels), key=lambda m: m.frequency_Hz) for condition, modes in found.items()}


def of_condition(modes, channels):
    for mode in modes.values():
        if any(("shape", channel) not in mode for channel in channels) or ("frequency_Hz", "") not in mode:
            continue
        real = np.array([mode["shape", channel] for channel in channels])
        imaginary = np.array([mode.get(("shape_imag", channel), (0.0, 0.0)) for channel in channels])
        shape = real[:, 0] + 1j * imaginary[:, 0]
        shape = shape * np.exp(-0.5j * np.angle(np.sum(shape**2)))
        size = np.linalg.norm(shape.real)
        yield Mode(*mode["frequency_Hz", ""], shape.real / size, real[:, 1] / size, shape.imag / size, imaginary[:, 1] / size)


def pairs_by_shape(modes, shapes):
    """measured mode -> model mode, one to one, with the largest sum of MAC. @param shapes  (channels x model modes)"""
    unit = shapes / np.maximum(np.linalg.norm(shapes, axis=0), 1e-300)
    mac = (np.array([mode.shape for mode in modes]) @ unit) ** 2
    return {i: j for i, j in zip(*linear_sum_assignment(-mac)) if mac[i, j] >= LEAST_MAC}
