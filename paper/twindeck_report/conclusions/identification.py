"""Rules for what section 3 concludes: (whether it holds, None where no result decides, and the numbers)."""
from ..cells import number
from ..identified import WITH, WITHOUT, modes_of, shapes_of, mac, with_dampers, without_dampers

HIGH = "with_dampers_high"  # the windy day, on which dampers slide
CLOSE_PAIR = (6, 7)  # preliminary modes "coupled at about 1.50 Hz"
COUPLES = (CLOSE_PAIR, (8, 9))  # "the couples of eigenmodes at about 1.50 and 1.70 Hz" of Table 2
SIMILAR = (0.02, 0.9)  # [-] of a frequency, a MAC: the criterion of stabilisation for frequencies, and shapes that are one mode's
CHANGE = 0.05  # [-] of a frequency: more is a change, less is none; the paper's first mode changes by 0.23, its second by 0.014


def _scores(study, result, _):
    """The decoupled setups have the least scores of the six in print."""
    campaign = study.campaign()
    if "s2_sensors" not in campaign.steps():
        return None, ""
    scores = campaign.step_csv("s2_sensors/setups.csv", ["setup", "R_k"]).set_index("setup")["R_k"]
    six = scores[scores.index.isin(study.paper_table(3)["abbreviation"])]
    decoupled = six[six.index.str.startswith("DC")]
    others = six.drop(decoupled.index)
    if decoupled.empty or others.empty:
        return None, ""
    return bool(decoupled.max() < others.min()), f"{', '.join(f'{name} {value:.3f}' for name, value in six.sort_values().items())}"


def _blind(study):
    campaign = study.campaign()
    if "s2_sensors" not in campaign.steps():
        return None
    table = campaign.step_csv("s2_sensors/blind_test.csv", ["setup", "mode", "frequency_Hz", "found"])
    table = table[table["frequency_Hz"].notna()]  # the others are spurious
    return table.assign(mode=table["mode"].astype(int)) if len(table) else None


def _blind_test(study, result, _):
    """Each setup shows all modes of the model."""
    table = _blind(study)
    if table is None:
        return None, ""
    never = {setup: sorted(own[own["found"] != 1]["mode"]) for setup, own in table.groupby("setup", sort=False)}
    missed = [f"{setup} misses {_modes(modes)}" for setup, modes in never.items() if modes]
    whole = sum(not modes for modes in never.values())
    return not missed, f"{whole} of {len(never)} setups show all; " + "; ".join(missed) if missed else f"all {len(never)} setups show all"


def _couples(study, result, _):
    """Each setup finds both modes of both couples."""
    table = _blind(study)
    if table is None or not {m for couple in COUPLES for m in couple} <= set(table["mode"]):
        return None, ""
    found = {setup: set(own[own["found"] == 1]["mode"]) for setup, own in table.groupby("setup", sort=False)}
    merged = [f"{setup} misses {_modes(sorted(missing))}" for setup, modes in found.items()
              if (missing := {m for couple in COUPLES for m in couple} - modes)]
    return not merged, "; ".join(merged) if merged else f"all {len(found)} setups find both modes of both couples"


def _free_decays(study, result, _):
    """Each mode of the free decays, by ERA, is like an ambient one of its condition, by SSI, in frequency and shape."""
    campaign = study.campaign()
    if "s3_identification" not in campaign.steps() or not (campaign.results / "s3_identification/decays.csv").is_file():
        return None, ""
    table = campaign.step_csv("s3_identification/decays.csv", ["condition", "setup", "mode", "frequency_Hz", "ambient_frequency_Hz", "mac"])
    if table.empty:
        return None, ""
    apart = (table["frequency_Hz"] / table["ambient_frequency_Hz"] - 1.0).abs()
    alike = (apart < SIMILAR[0]) & (table["mac"] > SIMILAR[1])  # a mode without an ambient one is not alike
    return bool(alike.all()), f"{int(alike.sum())} of {len(table)} modes of free decays within {100 * SIMILAR[0]:.0f} % and above a MAC of {SIMILAR[1]}"


def _modes(modes) -> str:
    return f"mode {modes[0]}" if len(modes) == 1 else "modes " + ", ".join(map(str, modes[:-1])) + f" and {modes[-1]}"


def _two_peaks(study, result, _):
    """Depth of the valley between the close pair's peaks of the mean spectrum: the lower peak over the valley, DC1 against ST1."""
    table = _blind(study)
    if table is None:
        return None, ""
    lines = table.drop_duplicates("mode").set_index("mode")["frequency_Hz"]
    if not set(CLOSE_PAIR) <= set(lines.index):
        return None, ""
    spectra = study.campaign().step_csv("s2_sensors/blind_psd.csv", ["setup", "frequency_Hz", "psd_m2_s3"])
    depth = {setup: _depth(own.groupby("frequency_Hz")["psd_m2_s3"].mean(), *(float(lines[m]) for m in CLOSE_PAIR))
             for setup, own in spectra[spectra["setup"].isin(["ST1", "DC1"])].groupby("setup")}
    if len(depth) < 2:
        return None, ""
    words = ", ".join(f"{setup} {value:.1f}" if value > 1.0 else f"{setup} none" for setup, value in sorted(depth.items()))
    return depth["DC1"] > max(1.0, depth["ST1"]), f"lower peak over valley: {words}"


def _depth(mean, low: float, high: float) -> float:
    """Each peak is looked for within half the pair's distance; 1 where there are not two peaks."""
    half = 0.5 * (high - low)
    first, second = (mean[(mean.index >= f - half) & (mean.index <= f + half)] for f in (low, high))
    between = mean[(mean.index >= first.idxmax()) & (mean.index <= second.idxmax())]
    return float(min(first.max(), second.max()) / between.min()) if len(between) else 1.0


def _ten_modes(study, result, _):
    campaign = study.campaign()
    if "s3_identification" not in campaign.steps():
        return None, ""
    without, with_ = len(without_dampers(campaign)), len(with_dampers(campaign))
    return without == 10 and with_ == 10, f"{without} rows of Table 4 without dampers, {with_} with them"


def _damping(study, result, _):
    """With dampers the mean damping ratio is at least twice that without: in print 3.45 against 1.33 %."""
    means = _means_of_table_4(study, "zeta_{}_dampers_pct")
    if means is None:
        return None, ""
    return means[1] >= 2.0 * means[0], f"{means[1]:.2f} against {means[0]:.2f} %"


def _means_of_table_4(study, column):
    if not (study.results / "tables/table_04.csv").is_file():
        return None
    table = study.step_csv("tables/table_04.csv", [column.format("without"), column.format("with")], text=True)
    found = [[number(v) for v in table[column.format(case)] if number(v) is not None] for case in ("without", "with")]
    return [sum(values) / len(values) for values in found] if all(found) else None


def _first_mode_changes_most(study, result, _):
    """By the largest part of all rows, and by more than CHANGE."""
    if not (study.results / "tables/table_04.csv").is_file():
        return None, ""
    table = study.step_csv("tables/table_04.csv", ["mode", "f_X_without_dampers_Hz", "f_X_with_dampers_Hz"], text=True)
    change = {row["mode"]: number(row["f_X_with_dampers_Hz"]) / number(row["f_X_without_dampers_Hz"]) - 1.0 for row in table.to_dict("records")
              if number(row["f_X_with_dampers_Hz"]) and number(row["f_X_without_dampers_Hz"])}
    if "1" not in change:
        return None, ""
    most = max(change, key=lambda m: abs(change[m]))
    return most == "1" and change["1"] > CHANGE, f"mode 1 by {100 * change['1']:+.0f} %, mode {most} most, by {100 * change[most]:+.0f} %"


def _threshold(study, result, _):
    """Mode 1 without dampers, with dampers at a low and at a high level of vibration: stiffened while they are held, as without them while they
    slide. At the high level it is the found mode whose shape is most like mode 1's without dampers."""
    campaign = study.campaign()
    if "s3_identification" not in campaign.steps() or not (campaign.results / f"s3_identification/conditions/{HIGH}/modes.csv").is_file():
        return None, ""
    rows, held = without_dampers(campaign), with_dampers(campaign)
    if 1 not in rows or 1 not in held:
        return None, ""
    shape, sliding = shapes_of(campaign, WITHOUT)[rows[1]], shapes_of(campaign, HIGH)
    likest = max(sliding.columns, key=lambda mode: mac(shape, sliding[mode]))
    f = [float(modes_of(campaign, WITHOUT).at[rows[1], "frequency_Hz"]), float(modes_of(campaign, WITH).at[held[1], "frequency_Hz"]),
         float(modes_of(campaign, HIGH).at[likest, "frequency_Hz"])]
    holds = f[1] / f[0] - 1.0 > CHANGE and abs(f[2] / f[0] - 1.0) < CHANGE
    return holds, f"mode 1 at {f[0]:.3f} Hz without dampers, {f[1]:.3f} Hz at the low level, {f[2]:.3f} Hz at the high one"


def _resonance(study, result, _):
    claims = {c.name: c for c in result.claims}
    found = [claims[name] for name in ("resonance_NE8_mode_1", "resonance_NE7_mode_2") if name in claims and claims[name].ours is not None]
    return (None, "") if len(found) < 2 else (all(c.inside for c in found), " and ".join(f"{c.ours:.3f}" for c in found))


RULES = {"scores": _scores, "blind test": _blind_test, "couples": _couples, "free decays": _free_decays, "two peaks": _two_peaks, "ten modes": _ten_modes, "damping": _damping,
         "first mode changes most": _first_mode_changes_most, "threshold": _threshold, "resonance": _resonance}
