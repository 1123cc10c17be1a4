"""Errors as an engineer reads them: frequencies in per cent of the measured ones and MAC, without and with the causes in the model. Modes that no fit
has seen where step 9 tells them (`gain.raw` of diagnosis.json, or frequencies marked as held out), else the fitted ones, which are said to be fitted."""
from dataclasses import dataclass
from statistics import stdev

from .heatmap import OWN
from .telling import Telling, Told

LEAST_GROWTH = 0.1  # [%] of the measured frequency: the last digit that the page shows

@dataclass(frozen=True)
class RawErrors:
    held_out: bool
    modes: int
    frequency: tuple  # (before, after) mean of the absolute errors [%]
    worse: bool  # by more than the standard error of the mean: step 9 claims no gain then
    mac: tuple | None  # (before, after) mean over the modes that have both; None where no shape was measured
    damping: tuple | None  # (before, after) as `frequency`, of the damping ratios
    damping_fitted: bool
    further_off: list  # of Told: modes whose frequency the causes move away from the measured one by more than its standard deviation
    gained: int = 0  # modes that have a counterpart in the model after alone
    lost: int = 0  # in the model before alone


def raw_errors(told: Telling | None) -> RawErrors | None:
    """None where there is no model with a cause in it, or no mode that has a counterpart in both."""
    if told is None or not told.after:
        return None
    both = [r for r in told.rows if r.before == r.before and r.after == r.after]
    rows = [r for r in both if r.held_out] or both
    if not rows:
        return None
    alike = [(r.mac_before, r.mac_after) for r in rows if r.mac_before == r.mac_before and r.mac_after == r.mac_after]
    growth = [abs(r.error("after")) - abs(r.error("before")) for r in rows]
    worse = _mean(growth) > (stdev(growth) / len(growth) ** 0.5 if len(growth) > 1 else 0.0)
    return RawErrors(rows[0].held_out, len(rows), tuple(_mean(abs(r.error(side)) for r in rows) for side in ("before", "after")), worse,
                     tuple(map(_mean, zip(*alike))) if alike else None, told.damping, not told.damping_held_out, sorted(filter(_further_off, rows), key=lambda r: -abs(r.error("after"))),
                     sum(r.before != r.before and r.after == r.after for r in told.rows), sum(r.before == r.before and r.after != r.after for r in told.rows))


def _further_off(row: Told) -> bool:
    growth = abs(row.error("after")) - abs(row.error("before"))
    return growth >= LEAST_GROWTH and not growth <= 100.0 * row.std / row.measured  # a deviation that is not known is NaN


def _mean(values) -> float:
    values = list(values)
    return sum(values) / len(values)


def in_words(raw: RawErrors, most: int | None = None) -> str:
    """The errors, and the modes that are further off than before, the worst first; `most` of them where there are many."""
    modes = f"{raw.modes} {'' if raw.held_out else 'fitted '}mode{'s' if raw.modes > 1 else ''}{' that no fit has seen' if raw.held_out else ''}"
    told = [f"Frequenc{'ies' if raw.modes > 1 else 'y'} of {modes} off by {_both(raw.frequency, '{:.2g} %')}"]
    if raw.mac:
        told.append(f"MAC {_both(raw.mac, '{:.2f}')}")
    if raw.damping:
        told.append(f"{'fitted ' if raw.held_out and raw.damping_fitted else ''}damping ratios off by {_both(raw.damping, '{:.2g} %')}")
    worse = "; ".join(map(_changed, raw.further_off[:most]))
    left_out = len(raw.further_off[most:]) if most else 0
    alone = [f"{n} mode{'s have' if n > 1 else ' has'} a counterpart in the model only {side}" for n, side in ((raw.gained, "after"), (raw.lost, "before")) if n]
    told += [", ".join(alone)] if alone else []
    return f"{'; '.join(told)}.{f' Further off than before: {worse}' if worse else ''}{f' and {left_out} more' if left_out else ''}{'.' if worse else ''}"


def _both(pair: tuple, form: str) -> str:
    return f"{form.format(pair[0])} before, {form.format(pair[1])} after"


def _changed(row: Told) -> str:
    name = row.mode if row.mode.startswith(OWN) else f"mode {row.mode}"
    return f"{name}{', ' if row.state else ''}{row.state.replace('_', ' ')} ({row.error('before'):+.1f} % to {row.error('after'):+.1f} %)"
