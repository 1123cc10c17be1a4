"""The section on reliability: the question, its answer in sentences, pictures, and step 10's tables, folded."""
import numpy as np

from ..figures import fragility, reliability_years, visible_loss
from ..study import Study
from .pieces import image, six

PICTURES = {module.NAME: (title, module.CAPTION) for module, title in (
    (fragility, "Fragility in wind"), (reliability_years, "Importance, and the years"), (visible_loss, "What monitoring would see"))}
TABLES = {"critical": "Critical speeds with their intervals", "crossings": "Limits in a given mean wind", "importance": "What the critical speed hangs on", "years": "Over the years",
          "visible": "What monitoring would see", "rare": "Rare events by two methods", "annual": "A year under the wind law", "random": "Random inputs"}
LIMITS = {"comfort_vertical": "vertical comfort", "comfort_lateral": "lateral comfort", "stay_slack": "a stay goes slack", "damper_stroke": "a damper's stroke"}
UNSTABLE = "instability (5 to 95 %)"
EVEN = 0.5


def reliability(study: Study) -> dict | None:
    """{question, winds, answers, pictures, tables}; None where the study has no step 10."""
    if "s10_reliability" not in study.steps() or not (study.results / "s10_reliability/fragility.csv").is_file():
        return None
    curves, critical = fragility.tables(study)
    last = curves["years"].max()
    later = f", today and after {last:g} years" if last > 0 else ""
    pictures = [{"name": name, "title": title, "caption": caption, "png": image(study, name)} for name, (title, caption) in PICTURES.items()]
    return {"question": f"In which wind does the bridge become uncomfortable, and in which unstable{later}?",
            "winds": _winds({**_comfort(curves), **_stability(critical, curves)}), "answers": _visible(study),
            "pictures": [picture for picture in pictures if picture["png"]],
            "tables": [{"title": title, **_table(study, name)} for name, title in TABLES.items() if (study.results / f"s10_reliability/{name}.csv").is_file()]}


def _winds(found: dict) -> dict:
    """{head, rows}: a row a case and year, a column a limit. `found`: limit -> {case and year: wind in words}."""
    cases = list(dict.fromkeys(case for column in found.values() for case in column))
    return {"head": list(found), "rows": [(case, [column.get(case, "–") for column in found.values()]) for case in cases]}


def _case(case: str, year: float, several: bool) -> str:
    return f"{case}, year {year:g}" if several else case


def _comfort(curves) -> dict:
    """The mean wind in which a limit is exceeded within the duration as often as not."""
    told = {}
    for state, words in LIMITS.items():
        rows = curves[curves["limit_state"] == state]
        column = {_case(case, years, rows["years"].nunique() > 1): _even(curve.sort_values("speed_m_s"))
                  for (case, years), curve in rows.groupby(["case", "years"], sort=False)}
        if column:
            told[words] = column
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


def _stability(critical, curves) -> dict:
    """The critical speed with its interval, by the model that the limits are of."""
    model = curves[curves["limit_state"] != "stability"]["model"]
    rows = critical[critical["model"] == model.iloc[0]] if len(model) else critical
    column = {_case(r["case"], r["years"], rows["years"].nunique() > 1): "none found" if r["speed_m_s"] != r["speed_m_s"] else
              f"{r['speed_m_s']:.1f} m/s ({r['low_m_s']:.1f} to {r['high_m_s']:.1f})" for r in rows.to_dict("records")}
    return {UNSTABLE: column} if column else {}


def _visible(study: Study) -> list:
    if not (study.results / visible_loss.FILES[0]).is_file():
        return []
    table = study.step_csv(visible_loss.FILES[0])
    walls = table.drop_duplicates("wall")
    seen = walls[walls["smallest_loss_m"].notna()].sort_values("years")
    if seen.empty:
        return ["No loss of thickness would be seen in the frequencies before nine tenths of the wall are gone."]
    first, unseen = seen.iloc[0], len(walls) - len(seen)
    rest = f" {unseen} of {len(walls)} walls would be gone before the frequencies tell." if unseen else ""
    return [f"Monitoring of the frequencies would first see the corrosion of {visible_loss.named(table[table['wall'] == first['wall']]['section'], ' ')}: from a loss of {1e3 * first['smallest_loss_m']:.2f} mm ({first['share_pct']:.0f} % of the wall) on, "
            f"in year {first['years']:.0f} at the assumed rate.{rest}"]


def _table(study: Study, name: str) -> dict:
    table = study.step_csv(f"s10_reliability/{name}.csv")
    table = table.loc[:, [c for c in table.columns if table[c].notna().any()]].astype(object)
    return {"head": [c.replace("_", " ") for c in table.columns],
            "rows": [["" if v != v else six(v) for v in row] for row in table.itertuples(index=False)]}
