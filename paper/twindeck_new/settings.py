"""Configurations of the steps that fit the records: the band in which the structure moves, decimation, block length and orders, number of modes."""
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from .errors import InputError

STANDS_OUT = 10.0  # times the median of its surroundings: the first singular value of broad noise stays within a factor of three
SURROUNDINGS = 101  # lines of the spectrum on which that median is taken, wide against a peak and narrow against the band
ALONE = 8  # lines either way in which a peak is the highest: the window of the spectrum spreads one over about four
COMMON = re.compile(r"up to ([0-9.]+) Hz, above which the sensors show no common motion")  # step 3's own line
KEPT_BAND = 0.4  # of the rate that is left: the highest mode lies below it, so that the low-pass of the decimation does not bend it
PERIODS = 2.0  # of the lowest mode that a block covers at least
BLOCK_ROWS, ORDERS, BLOCKS = (15, 120), (30, 120), (5, 20)  # smallest and largest: below, close modes merge; above, time grows without gain
ORDERS_A_MODE = 8  # model orders for each peak: twice two for the mode, as much for what is not one
BLOCK_PERIODS = 100.0  # of the lowest mode in a block for standard deviations: fewer, and a block has no spectrum of its own


@dataclass(frozen=True)
class Settings:
    peaks_Hz: list
    decimation: int
    block_rows: int
    maximum_order: int
    blocks: int
    by_step: bool = False  # step 3 chooses decimation and block length itself

    @property
    def modes(self) -> int:
        return max(4, len(self.peaks_Hz))


def chosen(bin_folder: Path, campaign: Path, rate_Hz: float, samples: int) -> Settings:
    """From the spectra of step 3 itself, run once at small orders. @throws InputError  with the step's line where it refuses the records"""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "s3_identification"
        run = subprocess.run([str(bin_folder / "s3_identification"), "--campaign", str(campaign), "--out", str(out), "--accept-unconverged",
                              "--set", "maximum_order=8", "minimum_order=4", "block_rows=8", "blocks=2", "largest_clipping=1", "longest_gap=1000000"],
                             capture_output=True, text=True, check=False)
        if run.returncode not in (0, 1):
            raise InputError((run.stderr.strip().splitlines() or ["step 3 refuses the records"])[-1])
        table = pd.read_csv(out / "singular_values.csv")
    peaks = sorted({round(f, 6) for _, part in table.groupby("setup") for f in peaks_of(part["frequency_Hz"].to_numpy(), part["sv1"].to_numpy())})
    own = subprocess.run([str(bin_folder / "s3_identification"), "--print-config"], capture_output=True, text=True, check=False).stdout
    common = [float(found[1]) for found in COMMON.finditer(run.stdout + run.stderr)]
    return from_peaks([p for p in peaks if not common or p <= max(common)], rate_Hz, samples, max(common, default=0.0), re.search(r"^block_rows *= *0$", own, flags=re.M) is not None)


def peaks_of(frequency, values) -> list:
    """Local maxima of the first singular value that stand out of their surroundings."""
    found = []
    half = SURROUNDINGS // 2
    for i in range(2, len(values) - 2):
        if values[i] == max(values[max(0, i - ALONE):i + ALONE + 1]) and values[i] > STANDS_OUT * np.median(values[max(1, i - half):i + half + 1]):
            found.append(float(frequency[i]))
    return found


def from_peaks(peaks: list, rate_Hz: float, samples: int, common_Hz: float = 0.0, by_step: bool = False) -> Settings:
    """`common_Hz`: up to where the sensors move together, 0 where step 3 did not tell."""
    lowest, highest = (peaks[0], peaks[-1]) if peaks else (0.05 * rate_Hz, KEPT_BAND * rate_Hz)
    decimation = max(1, int(KEPT_BAND * rate_Hz / max(common_Hz, highest)))
    rate = rate_Hz / decimation
    return Settings(peaks, decimation, _within(np.ceil(PERIODS * rate / lowest), BLOCK_ROWS), 2 * _within(ORDERS_A_MODE * len(peaks) / 2, (ORDERS[0] // 2, ORDERS[1] // 2)),
                    _within(samples / rate_Hz * lowest / BLOCK_PERIODS, BLOCKS), by_step)


def _within(value: float, limits: tuple) -> int:
    return int(min(limits[1], max(limits[0], value)))
