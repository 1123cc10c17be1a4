"""The modes of step 3 against those of the truth: what is missed, spurious or doubled, and whether deviations tell the errors.

A truth's mode counts where it stands above the noise (losses.seen). A measured mode is one of them where its frequency lies within 3 % and its shape has a MAC
of at least 0.8, one to one. Of close modes the subspace counts too: the part of a shape that the truth's modes within 3 % span together.
"""
import frame
import losses
import numpy as np
from scipy.optimize import linear_sum_assignment

NEAR, LEAST_MAC = 0.03, 0.8
MODE_COLUMNS = (
    "seed", "case", "pattern", "draw", "state", "frequency_Hz", "std_Hz", "truth_Hz", "errors_in_std", "mac", "subspace", "shape_chi2_dof",
    "imaginary_rms_pct", "imaginary_std_pct", "seen_in_truth",
)


def kept(modes, measured):
    """(index of the truth's mode or -1) for each measured mode."""
    out = np.full(len(measured), -1)
    if not measured or not len(modes.frequencies_Hz):
        return out
    mac = (np.array([m.shape for m in measured]) @ modes.shapes) ** 2
    gap = np.abs(np.log(np.array([m.frequency_Hz for m in measured])[:, None] / modes.frequencies_Hz[None, :]))
    good = (mac >= LEAST_MAC) & (gap < NEAR)
    for i, j in zip(*linear_sum_assignment(np.where(good, gap - 10.0, 0.0))):
        if good[i, j]:
            out[i] = j
    return out


def every_mode(case, pattern):
    """All modes of the truth below the loads' limit, seen or not."""
    found = frame.modes(case, frame.PATTERNS[pattern])
    inside = found.frequencies_Hz < losses.HIGHEST_HZ
    shapes = frame.at_sensors(found.floors)[:, inside]
    return losses.Seen(found.frequencies_Hz[inside], shapes / np.linalg.norm(shapes, axis=0), np.zeros(inside.sum()))


def mode_rows(case, pattern, measured):
    """A row a measured mode; `truth_Hz` is empty where the truth has none."""
    truth, above = every_mode(case, pattern), losses.seen(case, frame.PATTERNS[pattern])
    for mode, j in zip(measured, kept(truth, measured)):
        near = np.abs(np.log(truth.frequencies_Hz / mode.frequency_Hz)) < NEAR
        span = np.linalg.qr(truth.shapes[:, near])[0] if near.any() else np.zeros((len(mode.shape), 0))
        row = {
            "frequency_Hz": f"{mode.frequency_Hz:.4f}", "std_Hz": f"{mode.frequency_std_Hz:.4f}",
            "mac": f"{max((truth.shapes.T @ mode.shape) ** 2):.3f}", "subspace": f"{np.sum((span.T @ mode.shape) ** 2):.3f}",
            "imaginary_rms_pct": f"{100.0 * np.sqrt(np.mean(mode.imaginary**2)):.2f}",
            "imaginary_std_pct": f"{100.0 * np.sqrt(np.mean(mode.imaginary_std**2)):.2f}",
        }
        if j >= 0:
            shape = truth.shapes[:, j] * np.sign(truth.shapes[:, j] @ mode.shape)
            row |= {
                "truth_Hz": f"{truth.frequencies_Hz[j]:.4f}",
                "errors_in_std": f"{(mode.frequency_Hz - truth.frequencies_Hz[j]) / mode.frequency_std_Hz:.2f}",
                "shape_chi2_dof": f"{np.sum(((mode.shape - shape) / mode.shape_std) ** 2) / (len(shape) - 1):.2f}",
                "seen_in_truth": int(np.min(np.abs(above.frequencies_Hz - truth.frequencies_Hz[j])) < 1e-9),
            }
        yield row


def counts(case, pattern, before, after):
    """Spurious and missed modes of both states as text: frequencies in Hz."""
    spurious, missed = [], []
    for state, damage, measured in (("b", 0, before), ("a", pattern, after)):
        truth, above = every_mode(case, damage), losses.seen(case, frame.PATTERNS[damage])
        partner = kept(truth, measured)
        spurious += [f"{state}{mode.frequency_Hz:.2f}" for mode, j in zip(measured, partner) if j < 0]
        found = truth.frequencies_Hz[partner[partner >= 0]]
        missed += [f"{state}{f:.2f}" for f in above.frequencies_Hz if not np.any(np.abs(found - f) < 1e-9)]
    return {"modes_before": len(before), "modes_after": len(after), "spurious": " ".join(spurious), "missed": " ".join(missed)}
