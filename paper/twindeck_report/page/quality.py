"""Data quality of every channel of every record: what step 3 measured in them (features/quality.csv), and what of it is odd."""
from ..study import Study

FILE = "s3_identification/features/quality.csv"
COLUMNS = ["setup", "record", "channel", "samples", "missing", "longest_gap", "clipped", "rms", "drift_rms", "dead"]
LEAST_CLIPPED = 1e-3  # [-] share of the samples; a few samples at the largest value also stand in sound records
LEAST_DRIFT = 1.0  # [-] change of the fitted line over the record, in RMS of the motion: as large as the motion itself
LEAST_LAG = 5.0  # in its own standard deviations, which are themselves estimates: where modes mix, so do phases
LEAST_TURN_DEG = 2.0  # [deg] phase that a lag makes at the highest identified mode; below it no shape is the worse for it
SI_UNITS = {"acceleration": "m/s²", "velocity": "m/s", "displacement": "m", "force": "N", "strain": "-", "rotation": "rad", "": "m/s²"}
WITHOUT_SCALE = ("V", "mV", "counts", "count")
NAMED = 4  # channels that one warning names


def quality(study: Study) -> dict | None:
    """{rows: one a channel and record, odd ones first; odd: how many}; None where step 3 wrote none."""
    table = _table(study)
    if table is None:
        return None
    highest, units = _highest_mode(study), _units(study)
    rows = [{"setup": str(r["setup"]), "record": _text(r["record"]), "channel": str(r["channel"]), "samples": int(r["samples"]),
             "missing": _share(r["missing"], r), "gap": int(r["longest_gap"]) or "", "clipped": _share(r["clipped"], r), "rms": f"{r['rms']:.3g}",
             "unit": units.get(str(r["channel"]), ""), "drift": f"{round(r['drift_rms'], 2) + 0.0:+.2f}", "lag_ms": _lag(r), "odd": _odd(r, highest)}
            for r in table.to_dict("records")]
    return {"rows": sorted(rows, key=lambda r: -len(r["odd"])), "odd": sum(bool(r["odd"]) for r in rows)}


def flaws(study: Study) -> list:
    """[(sentence, whether a channel is dead)], one a kind of flaw, with the channels that have it."""
    table = _table(study)
    if table is None:
        return []
    highest, found = _highest_mode(study), {}
    for row in table.to_dict("records"):
        for kind, _ in _odd(row, highest):
            found.setdefault(kind, []).append(f"{row['channel']} ({row['setup']})")
    words = []
    for kind, channels in found.items():
        channels = list(dict.fromkeys(channels))
        more = f" and {len(channels) - NAMED} more" if len(channels) > NAMED else ""
        words.append((f"records: {kind}: {', '.join(channels[:NAMED])}{more}", kind == "dead"))
    return words


def _odd(row: dict, highest_Hz: float) -> list:
    """[(kind, words)] of one channel of one record."""
    if _truthy(row["dead"]):
        return [("dead", "dead: it does not move at all")]
    reason = row.get("left_out")
    found = [("left out", f"left out: {reason}")] if isinstance(reason, str) and reason else []
    if row["missing"] > 0:
        found.append(("samples missing", f"{_share(row['missing'], row)} % missing, longest gap {int(row['longest_gap'])} samples"))
    if row["clipped"] > LEAST_CLIPPED * row["samples"]:
        found.append(("clipped", f"{_share(row['clipped'], row)} % of the samples clipped"))
    if abs(row["drift_rms"]) > LEAST_DRIFT:
        found.append(("drifting", f"drifts by {abs(row['drift_rms']):.1f} times its RMS"))
    lag, std = row.get("lag_s"), row.get("lag_std_s")
    if lag == lag and std == std and lag is not None and std is not None and abs(lag) > LEAST_LAG * std \
            and 360.0 * abs(lag) * highest_Hz > LEAST_TURN_DEG:
        found.append(("clock off", f"clock {1e3 * abs(lag):.3g} ms {'behind' if lag > 0 else 'ahead of'} the first channel's"))
    return found


def _table(study: Study):
    if "s3_identification" not in study.steps() or not (study.results / FILE).is_file():
        return None
    return study.step_csv(FILE, COLUMNS)


def _highest_mode(study: Study) -> float:
    if not (study.results / "s3_identification/modes.csv").is_file():
        return 0.0
    frequencies = study.step_csv("s3_identification/modes.csv", ["frequency_Hz"])["frequency_Hz"]
    return float(frequencies.max()) if len(frequencies) else 0.0


def _units(study: Study) -> dict:
    """Units of the RMS values. Step 3 writes them in SI units, whatever unit the logger recorded (channels.csv `unit`); what was recorded without a
    scale (volts, counts) keeps its own."""
    if not (study.results / "s3_identification/channels.csv").is_file():
        return {}
    table = study.step_csv("s3_identification/channels.csv", ["channel"]).to_dict("records")
    return {str(r["channel"]): _text(r.get("unit", "")) if _text(r.get("unit", "")) in WITHOUT_SCALE else SI_UNITS.get(_text(r.get("quantity", "acceleration")), "")
            for r in table}


def _lag(row: dict) -> str:
    lag, std = row.get("lag_s"), row.get("lag_std_s")
    if lag is None or lag != lag:
        return ""
    return f"{round(1e3 * lag, 2) + 0.0:.2f}" + (f" ± {1e3 * std:.2f}" if std is not None and std == std else "")


def _share(count, row: dict) -> str:
    return f"{100.0 * count / row['samples']:.3g}" if count and row["samples"] else "0"


def _text(value) -> str:
    return "" if value != value else str(value)


def _truthy(value) -> bool:
    return value == value and bool(int(value))
