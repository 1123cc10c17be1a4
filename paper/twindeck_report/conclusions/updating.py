"""Rules for what sections 2.1 and 4 conclude: (whether it holds, None where no result decides, and the numbers)."""
from ..cells import number

MAC_POINTS = 5.0  # of an average MAC in per cent, what counts as the paper's: the spread between its own two averages, 65 and 69 %
ALMOST = 1.5  # [%] "almost perfect" in print is an error of 1.28 %
ALMOST_MAC = 0.95  # and a MAC of 0.99
MODULI = ("E_c1", "E_c2", "E_s", "E_s_stay_44")


def _claim(result, name):
    found = next((c for c in result.claims if c.name == name), None)
    return None if found is None or found.ours is None else found


def _chord_signs(study, result, _):
    found = [_claim(result, f"{deck}_bottom_chord_sign") for deck in ("foot", "cycle")]
    if None in found:
        return None, ""
    words = {1.0: "tension", -1.0: "compression"}
    return all(c.inside for c in found), ", ".join(f"{deck} deck in {words.get(c.ours, 'neither')}" for deck, c in zip(("foot", "cycle"), found))


def _mac_average(study, result, when):
    claim = _claim(result, f"mac_average_{when}_updating")
    return (None, "") if claim is None else (abs(claim.ours - number(claim.paper)) <= MAC_POINTS, f"{claim.ours:.0f} %")


def _inversions(study, result, _):
    """Pairs by shape whose numbers do not ascend together."""
    campaign = study.campaign()
    if "s4_refinement" not in campaign.steps() or not (campaign.results / "s4_refinement/pairs.csv").is_file():
        return None, ""
    pairs = campaign.step_csv("s4_refinement/pairs.csv", ["experimental_mode", "numerical_mode", "mac"], text=True)
    if not len(pairs) or (pairs["mac"] == "").any():  # by shapes alone
        return None, ""
    ascending = sorted(zip(pairs["experimental_mode"], pairs["numerical_mode"]), key=lambda pair: int(pair[0].rstrip("X")))
    numerical = [int(n.rstrip("N")) for _, n in ascending]
    crossed = sum(a > b for a, b in zip(numerical, numerical[1:]))
    return crossed > 0, f"{crossed} in {len(numerical)} pairs"


def _most_sensitive(study, result, _):
    """The nine that the paper keeps are the first nine by our score."""
    if "s5_sensitivity" not in study.steps():
        return None, ""
    table = study.step_csv("s5_sensitivity/selection.csv", ["parameter", "rank", "selected", "published"])
    own = table[table["published"] == 1].sort_values("rank")
    beyond = [f"{r['parameter']} {r['rank']:.0f}" for r in own.to_dict("records") if r["rank"] > len(own)]
    kept = int((own["selected"] == 1).sum())
    if own.empty:
        return None, ""
    return not beyond, f"{kept} of the {len(own)} are kept by our rule; ranks beyond {len(own)} of {len(table)}: {', '.join(beyond) or 'none'}"


def _first_mode(study, result, _):
    """Error of the first pair after updating, and where shapes are known its MAC."""
    if not (study.results / "tables/table_09.csv").is_file():
        return None, ""
    error = study.step_csv("tables/table_09.csv", ["error_pct"], text=True)["error_pct"].iloc[0]
    mac = None
    if (study.results / "tables/table_10.csv").is_file():
        mac = number(study.step_csv("tables/table_10.csv", ["MAC_1X"], text=True)["MAC_1X"].iloc[0])
    if number(error) is None:
        return None, ""
    holds = abs(number(error)) <= ALMOST and (mac is None or mac >= ALMOST_MAC)
    return holds, f"{number(error):+.2f} %" + ("" if mac is None else f", MAC {mac:.2f} on the virtual bridge")


def _stiffness_up(study, result, _):
    """Mean change of the four moduli above zero, of the two densities below."""
    if not (study.results / "tables/table_08.csv").is_file():
        return None, ""
    table = study.step_csv("tables/table_08.csv", ["parameter", "change_pct"], text=True).set_index("parameter")
    means = {column: [sum(values) / len(values) for names in (MODULI, ("rho_1", "rho_2"))
                      if (values := [number(table.at[n, column]) for n in names if n in table.index and number(table.at[n, column]) is not None])]
             for column in ("change_pct", "change_pct_paper") if column in table.columns}
    if len(means.get("change_pct", [])) < 2:
        return None, ""
    printed = means.get("change_pct_paper", [])
    own, theirs = means["change_pct"], f"; in print {printed[0]:+.1f} and {printed[1]:+.1f} %" if len(printed) == 2 else ""
    return own[0] > 0.0 > own[1], f"moduli {own[0]:+.1f} %, densities {own[1]:+.1f} % in the mean{theirs}"


RULES = {"chord signs": _chord_signs, "average MAC": _mac_average, "inversions": _inversions, "most sensitive": _most_sensitive,
         "first mode": _first_mode, "stiffness up": _stiffness_up}
