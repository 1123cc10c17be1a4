"""Stabilisation diagrams with the numbers behind each pole: one panel a setup and condition."""
import numpy as np

from ..study import Study

MOST_SPECTRUM = 900  # samples of the spectrum that is drawn behind the poles


def pole_data(study: Study) -> dict | None:
    if "s3_identification" not in study.steps():
        return None
    panels, modes = [], {}
    folders = ["s3_identification"] + sorted(
        f"s3_identification/conditions/{p.name}"
        for p in (study.results / "s3_identification/conditions").glob("*")
        if p.is_dir()
    )
    for folder in folders:
        if not (study.results / folder / "poles.csv").is_file():
            continue
        poles = study.step_csv(
            f"{folder}/poles.csv",
            ["setup", "order", "frequency_Hz", "damping_ratio_pct", "stable_frequency", "stable_damping", "stable_shape"],
        )
        spectra = (
            study.step_csv(f"{folder}/singular_values.csv")
            if (study.results / folder / "singular_values.csv").is_file()
            else None
        )
        if "condition" not in poles:
            poles = poles.assign(condition=folder.rpartition("/")[2])
        for (setup, condition), rows in poles.groupby(["setup", "condition"], sort=False):
            low, high = rows["frequency_Hz"].quantile([0.002, 0.998])
            panels.append(
                {
                    "setup": str(setup),
                    "condition": str(condition).replace("_", " "),
                    "band": [round(0.95 * low, 4), round(1.02 * high, 4)],
                    "poles": [_pole(r) for r in rows.to_dict("records")],
                    "spectrum": _spectrum(spectra, setup, 0.95 * low, 1.02 * high),
                }
            )
            modes.setdefault(str(condition).replace("_", " "), _modes(study, folder))
    return {"panels": panels, "modes": modes} if panels else None


def _pole(row: dict) -> list:
    """Order, frequency, damping ratio, criteria met (1 frequency, 2 damping, 4 shape), mode or nothing."""
    met = int(row["stable_frequency"]) + 2 * int(row["stable_damping"]) + 4 * int(row["stable_shape"])
    mode = row.get("mode")
    return [
        int(row["order"]),
        row["frequency_Hz"],  # all digits: the picker's file names a pole by them
        row["damping_ratio_pct"],
        met,
        None if mode is None or mode != mode else int(mode),
    ]


def _spectrum(table, setup, low: float, high: float):
    """First singular value over the band; of neighbours the largest is kept, so that no peak is lost."""
    if table is None:
        return []
    rows = table[(table["setup"].astype(str) == str(setup)) & table["frequency_Hz"].between(low, high) & (table["sv1"] > 0)]
    step = max(1, int(np.ceil(len(rows) / MOST_SPECTRUM)))
    f, s = rows["frequency_Hz"].to_numpy(), rows["sv1"].to_numpy()
    blocks = (slice(i, i + step) for i in range(0, len(rows), step))
    return [[round(float(f[b][s[b].argmax()]), 4), float(f"{s[b].max():.3g}")] for b in blocks]


def _modes(study: Study, folder: str) -> list:
    if not (study.results / folder / "modes.csv").is_file():
        return []
    rows = study.step_csv(f"{folder}/modes.csv", ["mode", "frequency_Hz"]).to_dict("records")
    return [[int(r["mode"]), float(f"{r['frequency_Hz']:.6g}")] for r in rows]
