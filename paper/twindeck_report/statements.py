"""What the paper says of the bridge in wind in words (sections 5.1 and 6), hit or missed by ours. Aerodynamic data, the dampers' places
and the measured side of the wind events are synthetic or reconstructed, so a miss is a finding and fails nothing."""
from dataclasses import dataclass

import pandas as pd

from .study import Study


@dataclass(frozen=True)
class Statement:
    statement: str
    source: str  # where the paper says it
    found: str  # the numbers that decide
    holds: bool

    @property
    def verdict(self) -> str:
        return "hit" if self.holds else "miss"


def check_statements(study: Study) -> list:
    """Empty for studies without steps 7 and 8."""
    steps = study.steps()
    found = []
    if "s7_aerodynamics" in steps:
        found += _stability(study)
    if "s8_validation" in steps:
        found += _comfort(study) + _section_6(study)
    return found


def _stability(study: Study) -> list:
    speed = design_speed(study)
    if speed is None:
        return []
    critical = study.step_csv("s7_aerodynamics/critical.csv",
                              ["set", "model", "dampers", "structural_damping_pct", "V_cr_m_s", "theta_rms_deg", "exponent"])
    critical = critical[critical["set"] == "standin"]
    bare = critical[(critical["dampers"] == "off") & (critical["model"] == "A")].sort_values("structural_damping_pct")
    rows = []
    for row in bare.to_dict("records"):
        assumed = row["structural_damping_pct"] == bare["structural_damping_pct"].min()
        text = f"{row['V_cr_m_s']:.2f} m/s" if row["V_cr_m_s"] == row["V_cr_m_s"] else "stable at every speed computed"
        rows.append(Statement(f"Without dampers and with {row['structural_damping_pct']:g} % structural damping"
                              f"{'' if assumed else ' (identified, not assumed)'} mode 1 gallops below the design wind of {speed:g} m/s",
                              "section 5.1, Fig. 20" if assumed else "not in the paper: its own Table 4 in place of 0.5 %",
                              text, bool(row["V_cr_m_s"] < speed)))
    for row in critical[critical["dampers"] == "on"].to_dict("records"):
        stable = not row["V_cr_m_s"] < speed
        rows.append(Statement(f"With dampers there is no instability up to {speed:g} m/s", "section 5.1",
                              "none found" if row["V_cr_m_s"] != row["V_cr_m_s"] else f"{row['V_cr_m_s']:.2f} m/s", stable))
    least = least_damping(study, speed)
    if len(least):
        low = least[least < 2.0]
        rows.append(Statement(f"With dampers every mode has well above 2 % up to {speed:g} m/s", "section 5.1",
                              f"{len(least) - len(low)} of {len(least)} modes; least " +
                              ", ".join(f"mode {mode}: {value:.2f} %" for mode, value in (low if len(low) else least).items()),
                              not len(low)))
    return rows


def design_speed(study: Study):
    """The design wind that step 7 was run for, None where it was not written."""
    table = study.step_csv("s7_aerodynamics/summary.csv", ["quantity", "value"]).set_index("quantity")["value"]
    return float(table["design_speed"]) if "design_speed" in table.index else None


def least_damping(study: Study, up_to: float) -> pd.Series:
    """Least total damping of each followed mode of the damped bridge up to a speed, stand-in set [%]."""
    table = study.step_csv("s7_aerodynamics/damping.csv", ["set", "dampers", "mode", "V_m_s", "damping_ratio_pct"])
    table = table[(table["set"] == "standin") & (table["dampers"] == "on") & (table["V_m_s"] <= up_to)]
    return table.groupby("mode")["damping_ratio_pct"].min()


def _comfort(study: Study) -> list:
    table = study.step_csv("s8_validation/comfort.csv", ["event", "run", "direction", "deck", "peak_m_s2", "limit_m_s2", "verdict"])
    rows = []
    for direction, words in (("vertical", "Vertical accelerations of the damped bridge stay within the comfort limit"),
                             ("lateral", "Lock-in is avoided: lateral accelerations of the damped bridge stay within the comfort limit")):
        part = table[table["direction"] == direction]
        if len(part):
            worst = part.loc[part["peak_m_s2"].idxmax()]
            within = int((part["verdict"] == "within").sum())
            rows.append(Statement(f"{words} of {worst['limit_m_s2']:g} m/s²", "section 5.1, EN 1990 A2.4.3.2",
                                  f"{within} of {len(part)} cases; largest mean peak {worst['peak_m_s2']:.2f} m/s² ({worst['event']}, "
                                  f"{worst['run']}, {worst['deck']} deck)", within == len(part)))
    return rows


def _section_6(study: Study) -> list:
    table = study.campaign().step_csv("s8_validation/statements.csv", ["statement", "found", "verdict"], text=True)
    return [Statement(row["statement"], "section 6", row["found"], row["verdict"] == "hit") for row in table.to_dict("records")]


def critical_rows(study: Study) -> list:
    """Every critical speed with what explains it: its mode, where that moves and how its h1* grows."""
    if "s7_aerodynamics" not in study.steps():
        return []
    table = study.step_csv("s7_aerodynamics/critical.csv",
                           ["set", "model", "dampers", "structural_damping_pct", "mode", "V_cr_m_s", "f_cr_Hz", "ratio_to_A",
                            "f_cr_over_f1", "theta_rms_deg", "exponent", "V_divergence_m_s", "status"])
    digits = {"mode": 0, "V_cr_m_s": 2, "f_cr_Hz": 4, "ratio_to_A": 3, "f_cr_over_f1": 3, "theta_rms_deg": 1, "exponent": 2,
              "V_divergence_m_s": 0, "structural_damping_pct": 2}
    return [{name: (f"{value:.{digits[name]}f}" if value == value else "") if name in digits else value for name, value in row.items()}
            for row in table.to_dict("records")]


def ranges_of_table_13(study: Study) -> list:
    """Errors of Table 13: mean over the seeds, the interval of that mean, and how far one seed alone may be off."""
    if "s8_validation" not in study.steps():
        return []
    table = study.campaign().step_csv("s8_validation/rms.csv", ["event", "run", "model", "channel", "direction", "rms_m_s2", "seed_deviation_m_s2",
                                                    "measured_rms_m_s2", "error_pct", "error_low_pct", "error_high_pct"])
    table = table[(table["direction"] == "z") & table["error_pct"].notna()]
    cells = {}
    for row in table.to_dict("records"):
        one = 100.0 * row["seed_deviation_m_s2"] / row["measured_rms_m_s2"]
        cells[(row["channel"], row["event"], row["run"])] = (f"{row['error_pct']:+.0f} [{row['error_low_pct']:+.0f}, "
                                                              f"{row['error_high_pct']:+.0f}], ±{one:.0f}")
    columns = sorted({key[1:] for key in cells})
    return [{"channel": channel, "cells": {" ".join(c): cells.get((channel, *c), "") for c in columns}}
            for channel in sorted({key[0] for key in cells})]
