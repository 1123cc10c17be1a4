"""The section on reliability: the question, its answer in sentences, pictures, and step 10's tables, folded."""
import numpy as np

from ..figures import fragility, reliability_years, visible_loss
from ..study import Study
from .pieces import image, six

PICTURES = {module.NAME: (title, module.CAPTION) for module, title in (
    (fragility, "Fragility in wind"), (reliability_years, "Importance, and the years"), (visible_loss, "What monitoring would see"))}
TABLES = {"critical": "Critical speeds with their intervals", "crossings": "Limits in a given mean wind", "importance": "What the critical speed hangs on", "years": "Over the years",
          "visible": "What monitoring would see", "rare": "Rare events by two methods", "annual": "A year under the wind law", "random": "Random inputs"}
LIMITS = {"comfort_vertical": "the vertical comfort limit", "comfort_lateral": "the lateral comfort limit", "stay_slack": "the force at which a stay goes slack",
          "damper_stroke": "a damper's stroke"}
EVEN = 0.5


def reliability(study: Study) -> dict | None:
    """{question, answers, pictures, tables}; None where the study has no step 10."""
    if "s10_reliability" not in study.steps() or not (study.results / "s10_reliability/fragility.csv").is_file():
        return None
    curves, critical = fragility.tables(study)
    last = curves["years"].max()
    later = f", today and after {last:g} years" if last > 0 else ""
    pictures = [{"name": name, "title": title, "caption": caption, "png": image(study, name)} for name, (title, caption) in PICTURES.items()]
    return {"question": f"In which wind does the bridge become uncomfortable, and in which unstable{later}?",
            "answers": [*_comfort(curves), *_stability(critical, curves), *_visible(study)],
            "pictures": [picture for picture in pictures if picture["png"]],
            "tables": [{"title": title, **_table(study, name)} for name, title in TABLES.items() if (study.results / f"s10_reliability/{name}.csv").is_file()]}


def _comfort(curves) -> list:
    """One sentence a limit: the mean wind in which it is exceeded within the duration as often as not."""
    told = []
    for state, words in LIMITS.items():
        rows = curves[curves["limit_state"] == state]
        parts = []
        for (case, years), curve in rows.groupby(["case", "years"], sort=False):
            parts.append(f"{_even(curve.sort_values('speed_m_s'))} {case}{f', year {years:g}' if rows['years'].nunique() > 1 else ''}")
        if parts:
            told.append(f"Mean wind in which {words} is exceeded with probability {EVEN:g}: {'; '.join(parts)}.")
    return told


def _even(curve) -> str:
    speed, probability = curve["speed_m_s"].to_numpy(float), curve["probability"].to_numpy(float)
    above = np.flatnonzero(probability >= EVEN)
    if not len(above):
        return f"above {speed[-1]:g} m/s"
    k = above[0]
    if k == 0:
        return f"below {speed[0]:g} m/s"
    share = (EVEN - probability[k - 1]) / (probability[k] - probability[k - 1])
    return f"{speed[k - 1] + share * (speed[k] - speed[k - 1]):.1f} m/s"


def _stability(critical, curves) -> list:
    parts = []
    model = curves[curves["limit_state"] != "stability"]["model"]
    rows = critical[critical["model"] == model.iloc[0]] if len(model) else critical
    for row in rows.to_dict("records"):
        year = f", year {row['years']:g}" if rows["years"].nunique() > 1 else ""
        if row["speed_m_s"] != row["speed_m_s"]:
            parts.append(f"none found {row['case']}{year}")
        else:
            parts.append(f"{row['speed_m_s']:.1f} m/s ({row['low_m_s']:.1f} to {row['high_m_s']:.1f}) {row['case']}{year}")
    return [f"Critical speed, with its 5 to 95 % interval: {'; '.join(parts)}."] if parts else []


def _visible(study: Study) -> list:
    if not (study.results / visible_loss.FILES[0]).is_file():
        return []
    walls = study.step_csv(visible_loss.FILES[0]).drop_duplicates("wall")
    seen = walls[walls["smallest_loss_m"].notna()].sort_values("share_pct")
    if seen.empty:
        return ["No loss of thickness would be seen in the frequencies before nine tenths of the wall are gone."]
    first, unseen = seen.iloc[0], len(walls) - len(seen)
    rest = f" {unseen} of {len(walls)} walls would be gone before the frequencies tell." if unseen else ""
    return [f"Monitoring of the frequencies would first see {first['section'].replace('_', ' ')}: from a loss of {1e3 * first['smallest_loss_m']:.2f} mm ({first['share_pct']:.0f} % of the wall) on, "
            f"in year {first['years']:.0f} at the assumed rate.{rest}"]


def _table(study: Study, name: str) -> dict:
    table = study.step_csv(f"s10_reliability/{name}.csv")
    table = table.loc[:, [c for c in table.columns if table[c].notna().any()]].astype(object)
    return {"head": [c.replace("_", " ") for c in table.columns],
            "rows": [["" if v != v else six(v) for v in row] for row in table.itertuples(index=False)]}
