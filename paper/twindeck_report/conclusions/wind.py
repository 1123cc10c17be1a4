"""Rules for what sections 2.1, 5, 6 and 7 conclude of the bridge in wind: (whether it holds, None where no result decides, and the numbers)."""
from ..ladder import as_assumed, critical_speeds
from ..statements import design_speed, least_damping

RUNS = ("NS1", "NS2", "NS3")  # the paper's deployments of Table 13
WIND_Y = ("G", "H", "I")  # models of Table 11 with wind along Y
SAME_SPEED = 0.005 / 26.50  # [-] half the last printed digit of the speeds of G and I
CENTRE = 0.1  # [-] of a deck's length: the centre reaches so far to either side of the middle


def _galloping(study, result, _):
    speeds = critical_speeds(study)
    return (None, "") if "A" not in speeds.index else (True, f"{speeds['A']:.2f} m/s")


def _least_damping(study, result, _):
    speed = design_speed(study) if "s7_aerodynamics" in study.steps() else None
    least = least_damping(study, speed) if speed else []
    if not len(least):
        return None, ""
    low = least[least < 2.0]
    found = f"least {least.min():.2f} % in mode {least.idxmin()}"
    return not len(low), found + (f", {len(low)} of {len(least)} modes below 2 %" if len(low) else "")


def _comfort(study, result, direction):
    if "s8_validation" not in study.steps():
        return None, ""
    table = study.step_csv("s8_validation/comfort.csv", ["event", "run", "direction", "peak_m_s2", "limit_m_s2"])
    own = table[(table["direction"] == direction) & table["run"].isin(RUNS)]
    if own.empty:
        return None, ""
    above = int((~(own["peak_m_s2"] <= own["limit_m_s2"])).sum())  # an unstable bridge has no peak and is not within
    return above == 0, f"largest mean peak {own['peak_m_s2'].max():.3f} m/s², {above} of {len(own)} cases above the limit"


def _spread(study, result, _):
    said = []
    for name, words in (("standin", "the shaped set"), ("quasi_steady", "quasi-steady derivatives")):
        speeds = critical_speeds(study, name)
        speeds = speeds[speeds.index.isin(list("ACDGHI"))]
        if len(speeds):
            said.append(f"{speeds.min():.1f} to {speeds.max():.1f} m/s with {words}")
    return (True if said else None), ", ".join(said)


def _wind_along_y(study, result, _):
    """Each model with wind along Y has a higher critical speed than A, wind across the decks."""
    speeds = critical_speeds(study)
    if not {"A", *WIND_Y} <= set(speeds.index):
        return None, ""
    return bool(speeds[list(WIND_Y)].min() > speeds["A"]), ", ".join(f"{m} {speeds[m]:.2f}" for m in ("A", *WIND_Y)) + " m/s"


def _static_part(study, result, _):
    """G and I differ in their static part alone: their critical speeds are the same to the printed digits."""
    speeds = critical_speeds(study)
    if not {"G", "I"} <= set(speeds.index):
        return None, ""
    return bool(abs(speeds["G"] / speeds["I"] - 1.0) <= SAME_SPEED), f"G {speeds['G']:.2f}, I {speeds['I']:.2f} m/s"


def _galloping_deck(study, result, deck):
    """The deck that moves most in the unstable motion of model A."""
    if "s7_aerodynamics" not in study.steps():
        return None, ""
    table = study.step_csv("s7_aerodynamics/critical.csv")
    if not {"deck", "deck_share"} <= set(table.columns):
        return None, ""
    own = as_assumed(table, "standin").set_index("model")
    if "A" not in own.index or not isinstance(own.at["A", "deck"], str):
        return None, ""
    return own.at["A", "deck"] == deck, f"{100 * own.at['A', 'deck_share']:.0f} % of mode {own.at['A', 'mode']:.0f}'s motion is the {own.at['A', 'deck']} deck's"


def _static_centre(study, result, _):
    """The largest difference of the static displacements by the rules of G and H lies at the centre of a deck."""
    if "s7_aerodynamics" not in study.steps() or not (study.results / "s7_aerodynamics/static.csv").is_file():
        return None, ""
    table = study.step_csv("s7_aerodynamics/static.csv", ["set", "model", "deck", "node", "station_m", "x_m", "y_m", "z_m"])
    places = {m: own.set_index(["deck", "node"]) for m, own in table[table["set"] == "standin"].groupby("model")}
    if not {"G", "H"} <= set(places):
        return None, ""
    moved = ["x_m", "y_m", "z_m"]
    apart = ((places["G"][moved] - places["H"][moved]) ** 2).sum(axis=1)
    if not apart.max() > 0.0:
        return None, ""
    deck, node = apart.idxmax()
    stations = places["G"].loc[deck]["station_m"]
    part = (stations[node] - stations.min()) / (stations.max() - stations.min())
    return bool(abs(part - 0.5) <= CENTRE), f"at {100 * part:.0f} % of the {deck} deck's length"


def _ramps(study, result, _):
    """Cells of Table 13 at the accelerometers by the access ramps that are overestimated."""
    tables = [t for t in (_errors(study, event) for event in ("August", "April")) if t is not None]
    errors = [e for t in tables for e in t[t["channel"].isin(["M1", "M8"])]["error_pct"]]
    return (None, "") if not errors else (all(e > 0 for e in errors), f"{sum(e > 0 for e in errors)} of {len(errors)} cells")


def _errors(study, event):
    if "s8_validation" not in study.steps():
        return None
    table = study.campaign().step_csv("s8_validation/rms.csv", ["event", "run", "channel", "direction", "error_pct"])
    table = table[(table["event"] == event) & (table["direction"] == "z") & table["run"].isin(RUNS) & table["error_pct"].notna()]
    return table if len(table) else None


def _august(study, result, _):
    table = _errors(study, "August")
    if table is None:
        return None, ""
    apart = table["channel"].isin(["M1", "M8"]) | ((table["channel"] == "M7") & (table["run"] == "NS2"))
    largest = table[~apart]["error_pct"].abs().max()
    return bool(largest < 26.0), f"{largest:.0f} %"


def _april(study, result, _):
    table = _errors(study, "April")
    if table is None:
        return None, ""
    over = int((table["error_pct"] > 0).sum())
    return over == len(table), f"{over} of {len(table)} cells"


def _event_of_2009(study, result, printed):
    """The least of the two simulated events has less wind than any reading of the 28 m/s at the mast's top: what it gives is a lower bound."""
    claim = next((c for c in result.claims if c.name == "event_2009_12_25_acceleration"), None)
    if claim is None or claim.ours is None:
        return None, ""
    return (False if claim.ours > float(printed) else None), f"{claim.ours:.2f} m/s² at 16.46 m/s"


def _static_wind(study, result, _):
    claims = {c.name: c for c in result.claims}
    if any(claims.get(name) is None or claims[name].ours is None for name in ("eq_7_displacement", "eq_7_rotation")):
        return None, ""
    return True, f"{claims['eq_7_displacement'].ours:.2f} mm and {claims['eq_7_rotation'].ours:.3f} degrees"


def _statement(study, result, name):
    """A statement of section 6 that step 8 decided on the events of the virtual bridge."""
    own = next((s for s in result.statements if s.statement == name), None)
    return (None, "") if own is None else (own.holds, own.found)


def _hybrid(study, result, _):
    """Mean size of the errors of both events, with the hybrid deployment and with the others."""
    if "s8_validation" not in study.steps():
        return None, ""
    table = study.campaign().step_csv("s8_validation/rms.csv", ["run", "direction", "error_pct"])
    table = table[(table["direction"] == "z") & table["error_pct"].notna()]
    means = table["error_pct"].abs().groupby(table["run"]).mean()
    if "hybrid" not in means.index or len(means) < 2:
        return None, ""
    return bool(means["hybrid"] <= means.min()), ", ".join(f"{run} {value:.1f} %" for run, value in means.items())


RULES = {"galloping": _galloping, "least damping": _least_damping, "comfort": _comfort, "spread of critical speeds": _spread,
         "August": _august, "April": _april, "event of 2009": _event_of_2009, "static wind": _static_wind, "statement": _statement,
         "hybrid": _hybrid, "wind along Y": _wind_along_y, "static part": _static_part, "galloping deck": _galloping_deck,
         "static centre": _static_centre, "ramps": _ramps}
