"""Claims of section 3: test design, blind test, identified modes, stays."""
from ..identified import WITH, WITHOUT, modes_of, with_dampers, without_dampers
from ..study import Study
from .results import COUNT, exact, from_table, relative, rounding, setting, table

AS_SET = "A setting of the step, carried over from the paper."
FITTED = "As in Table 2: section sizes of ours were fitted to the preliminary frequencies."


def _preliminary(*modes):
    """Mean of some preliminary frequencies."""
    def pick(rows):
        found = rows[rows["mode"].isin(modes)]["frequency_Hz"]
        return found.mean() if len(found) == len(modes) else None
    return from_table("s1_model/modes.csv", ["mode", "frequency_Hz"], pick)


def _frame(study: Study):
    """Samples of a frame: duration x rate over downsampling and frames."""
    parts = [setting("s2_sensors", f"blind.{key}")(study) for key in ("duration", "rate", "downsample", "frames")]
    return None if None in parts else parts[0] * parts[1] / parts[2] / parts[3]


def _identified(study: Study, condition: str):
    if not study.has("s3_identification"):
        return None
    rows = without_dampers(study) if condition == WITHOUT else with_dampers(study)
    return float(modes_of(study, condition).at[rows[1], "frequency_Hz"]) if 1 in rows else None


def _rows_found(study: Study):
    return float(len(without_dampers(study))) if study.has("s3_identification") else None


def _resonance(stay: str, row: int):
    """First frequency of a stay without sleeves over that of a mode of the bridge without dampers."""
    def compute(study: Study):
        stays = table(study, "s3_identification/stays.csv", ["stay", "condition", "harmonic", "frequency_Hz"])
        rows = without_dampers(study) if stays is not None else {}
        if row not in rows:
            return None
        own = stays[(stays["stay"] == stay) & (stays["condition"] == "without_sleeves") & (stays["harmonic"] == 1)]["frequency_Hz"]
        return float(own.iloc[0] / modes_of(study, WITHOUT).at[rows[row], "frequency_Hz"]) if len(own) else None
    return compute


def _stays(rows):
    return rows["stay"].nunique()


RECOVERED = "Both frequencies are recovered from the virtual campaign (Tables 4 and 5: 1.0 and 1.2 %)."
VIRTUAL_DAMPERS = "Places and friction of the dampers are ours: shown beside the paper's."
BLIND = ("s2_sensors/blind_test.csv", ["setup", "mode", "found"])

COMPUTED = {
    "automac_modes": (setting("s2_sensors", "n_modes"), exact, AS_SET),
    "experimental_setups": (setting("s2_sensors", "blind.setups"), exact, COUNT),
    "channels_per_setup": (setting("s2_sensors", "channels"), exact, AS_SET),
    "blind_duration": (setting("s2_sensors", "blind.duration"), exact, AS_SET + " '8,000 sample length' is read as seconds: only then are frames as long "
                       "as printed."),
    "blind_modes": (setting("s2_sensors", "n_modes"), exact, AS_SET),
    "blind_sampling_rate": (setting("s2_sensors", "blind.rate"), exact, AS_SET),
    "blind_downsampling": (setting("s2_sensors", "blind.downsample"), exact, AS_SET),
    "blind_frames": (setting("s2_sensors", "blind.frames"), exact, AS_SET),
    "blind_frame_samples": (_frame, relative(0.1), "'About 6,000': ours follows from duration, rate, downsampling and frames."),
    "blind_lowest_order": (setting("s2_sensors", "blind.minimum_order"), exact, AS_SET),
    "blind_highest_order": (setting("s2_sensors", "blind.maximum_order"), exact, AS_SET),
    "stable_frequency": (setting("s2_sensors", "stable.frequency", 100.0), rounding, AS_SET),
    "stable_damping": (setting("s2_sensors", "stable.damping", 100.0), rounding, AS_SET),
    "stable_mac": (setting("s2_sensors", "stable.mac"), rounding, AS_SET),
    "blind_modes_found": (from_table(*BLIND, lambda rows: rows[rows["found"] == 1]["mode"].nunique()), None,
                          "Modes of the preliminary model that at least one setup shows; signals and setups are ours."),
    "close_pair_lower": (_preliminary(6), relative(0.05), FITTED),
    "close_pair_upper": (_preliminary(7), relative(0.05), FITTED),
    "close_pair_first": (_preliminary(6, 7), relative(0.05), FITTED + " Mean of modes 6 and 7."),
    "close_pair_second": (_preliminary(8, 9), relative(0.05), FITTED + " Mean of modes 8 and 9."),
    "test_setups": (setting("s3_identification", "setups"), exact, AS_SET),
    "test_sampling_rate": (setting("s0_campaign", "logger.rate"), exact, AS_SET),
    "cleaning_mac": (setting("s3_identification", "cleaning.mac"), rounding, AS_SET),
    "cleaning_recursion": (setting("s3_identification", "cleaning.recursion"), exact, AS_SET),
    "modes_identified": (_rows_found, exact, "Rows of Table 4 that the virtual campaign without dampers gives back, within 3 % of the printed frequency."),
    "first_mode_without_dampers": (lambda study: _identified(study, WITHOUT), relative(0.01), "As in Table 4 without dampers."),
    "first_mode_with_dampers": (lambda study: _identified(study, WITH), None, VIRTUAL_DAMPERS),
    "stays_identified": (from_table("s3_identification/stays.csv", ["stay"], _stays), exact, COUNT),
    "resonance_NE8_mode_1": (_resonance("NE8", 1), relative(0.022), RECOVERED),
    "resonance_NE7_mode_2": (_resonance("NE7", 2), relative(0.022), RECOVERED),
}
