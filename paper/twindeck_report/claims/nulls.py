"""Of each computed claim that is compared: which number of a table it says again, or else what stands in its place if nothing is
computed (its null)."""
from ..study import Study

REPEATS = {
    "preliminary_f10": "table_06 row 10 column f_N_Hz",
    "close_pair_lower": "table_02 row 6 column f_N_Hz",
    "close_pair_upper": "table_02 row 7 column f_N_Hz",
    "close_pair_first": "table_02 rows 6 and 7 column f_N_Hz",
    "close_pair_second": "table_02 rows 8 and 9 column f_N_Hz",
    "modes_identified": "table_04 column f_X_without_dampers_Hz",
    "first_mode_without_dampers": "table_04 row 1 column f_X_without_dampers_Hz",
    "resonance_NE8_mode_1": "table_05 row without_sleeves NE8 column f1_Hz",
    "resonance_NE7_mode_2": "table_05 row without_sleeves NE7 column f1_Hz",
    "galloping_speed_fig_20": "table_12 row A column V_cr_m_per_s",
    "critical_speed_least_model_A": "table_12 row A column V_cr_m_per_s",
    "critical_speed_largest_model_C": "table_12 row C column V_cr_m_per_s",
    "critical_speed_model_G": "table_12 row G column V_cr_m_per_s",
}

MODELS = ("orthogonal_wind", "cosine_rule", "cosine_and_skew", "wind_Y", "wind_Y_2", "wind_Y_3")


def _before_updating(study: Study) -> float | None:
    """Mean absolute error over the common pairs of a model that is not updated."""
    path = study.results / "s6_updating/summary.csv"
    if not path.is_file():
        return None
    table = study.step_csv("s6_updating/summary.csv", ["quantity", "value"]).set_index("quantity")["value"]
    name = "mean_abs_error_common_before_pct"
    return float(table[name]) if name in table.index else None


def _mean_ratio(study: Study) -> float:
    """Mean of the six printed ratios f_cr / f_1."""
    printed = study.read_csv(study.data / "paper" / "claims.csv", ["claim", "value"], text=True).set_index("claim")["value"]
    values = [float(printed[name]) for model in MODELS if (name := f"f_cr_over_f1_{model}") in printed.index]
    return sum(values) / len(values)


NULLS = {
    "foot_bottom_chord_sign": (0.0, "no force in the chord"),
    "cycle_bottom_chord_sign": (0.0, "no force in the chord"),
    "E_c2_on_bound": (0.0, "the unchanged parameter"),
    "E_s_on_bound": (0.0, "the unchanged parameter"),
    "E_s_stay_44_on_bound": (0.0, "the unchanged parameter"),
    "rho_2_on_bound": (0.0, "the unchanged parameter"),
    "mean_error_after_updating": (_before_updating, "the model before the updating"),
    **{f"f_cr_over_f1_{model}": (_mean_ratio, "one ratio for all six models") for model in MODELS},
}
