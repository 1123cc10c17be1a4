"""Errors as an engineer reads them: frequencies in per cent of the measured ones and MAC, without and with the causes in the model. Modes that no fit
has seen where step 9 tells them (`gain.raw` of diagnosis.json, or frequencies marked as held out), else the fitted ones, which are said to be fitted."""
from dataclasses import dataclass

from .telling import Telling, Told

LEAST_GROWTH = 0.1  # [%] of the measured frequency: the last digit that the page shows

@dataclass(frozen=True)
class RawErrors:
    held_out: bool
    modes: int
    frequency: tuple  # (before, after) mean of the absolute errors [%]
    mac: tuple | None  # (before, after) mean over the modes that have both; None where no shape was measured
    damping: tuple | None  # (before, after) as `frequency`, of the damping ratios that were fitted
    further_off: list  # of Told: modes whose frequency the causes move away from the measured one by more than its standard deviation

    @property
    def worse(self) -> bool:
        return self.frequency[1] >= self.frequency[0]


def raw_errors(told: Telling | None) -> RawErrors | None:
    """None where there is no model with a cause in it."""
    if told is None or not told.after:
        return None
    rows = [r for r in told.rows if r.held_out] or told.rows
    alike = [(r.mac_before, r.mac_after) for r in rows if r.mac_before == r.mac_before and r.mac_after == r.mac_after]
    return RawErrors(rows[0].held_out, len(rows), tuple(_mean(abs(r.error(side)) for r in rows) for side in ("before", "after")),
                     tuple(map(_mean, zip(*alike))) if alike else None, told.damping, sorted(filter(_further_off, rows), key=lambda r: -abs(r.error("after"))))


def _further_off(row: Told) -> bool:
    growth = abs(row.error("after")) - abs(row.error("before"))
    return growth >= LEAST_GROWTH and not growth <= 100.0 * row.std / row.measured  # a deviation that is not known is NaN


def _mean(values) -> float:
    values = list(values)
    return sum(values) / len(values)


def in_words(raw: RawErrors, most: int | None = None) -> str:
    """Both errors, and the modes that are further off than before, the worst first; `most` of them where there are many."""
    told = f"Frequenc{'ies' if raw.modes > 1 else 'y'} of {raw.modes} {'' if raw.held_out else 'fitted '}mode{'s' if raw.modes > 1 else ''}{' that no fit has seen' if raw.held_out else ''}: {raw.frequency[0]:.2g} % off before, {raw.frequency[1]:.2g} % after"
    told += f"; MAC {raw.mac[0]:.2f} before, {raw.mac[1]:.2f} after" if raw.mac else ""
    told += f"; {'fitted ' if raw.held_out else ''}damping ratios {raw.damping[0]:.2g} % off before, {raw.damping[1]:.2g} % after." if raw.damping else "."
    if raw.further_off:
        modes = [f"mode {r.mode}{', ' + r.state.replace('_', ' ') if r.state else ''} ({r.error('before'):+.1f} % to {r.error('after'):+.1f} %)" for r in raw.further_off[:most]]
        told += f" Further off than before: {'; '.join(modes)}{f' and {len(raw.further_off) - len(modes)} more' if len(modes) < len(raw.further_off) else ''}."
    return told
