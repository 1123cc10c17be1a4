"""A made-up diagnosis and its score, as step 9 and the scorer write them. Nothing here is a result of the bridge."""
import hashlib
import json

import made_up_study

SENTENCES = {"what": "The frequency of mode 1 (windy) is measured as 0.748 Hz, the model fitted within its bounds has 0.69 Hz: 3.4 standard deviations.",
             "why": "The dampers C1 and C2 do not move below 434 N each.", "how_sure": "The cause has probability 0.87.",
             "how_much_better": "On 12 values that no fit has seen the misfit goes from 2.00 to 1.50 standard deviations, 25 % less (90 % interval 8 to 40 %).",
             "next": "The modes with dampers at two or more amplitudes."}


def parameter(name, unit, value, low, high):
    return {"name": name, "unit": unit, "value": value, "low": low, "high": high, "level": 0.9, "one_sided": ""}


def diagnosis(**changes):
    told = {"schema": 2, "verdict": "named", "message": SENTENCES["why"], "sentences": dict(SENTENCES),
            "detection": {"log_odds": 53.2, "threshold": 2.94, "probability": 0.99},
            "residual_test": {"statistic": 120.0, "dof": 118, "p_value": 0.4, "block_p_value": 0.5, "stage": "after extension", "blocks": []},
            "account": [],
            "effects": [{"cause": "fric", "location": "dampers:C1,C2", "cluster": ["fric@dampers:C1,C2", "mass@node:725"], "probability": 0.87,
                         "log_odds": 53.2, "split_by": "the modes with dampers at two amplitudes",
                         "parameters": [parameter("Fc_N", "N", 434.0, 181.0, 608.0), parameter("k_lock_N_m", "N/m", 5.4e6, 4.7e6, 6.4e6)],
                         "state": "", "place": {"words": "the dampers C1 and C2", "x_m": None, "y_m": None, "z_m": None},
                         "rivals": [{"id": "mass@node:725", "words": "mass that the model does not have (the deck at x = 34 m)", "probability": 0.11,
                                     "parameters": [parameter("mass_kg", "kg", 800.0, 600.0, 1100.0)]}],
                         "sentence": SENTENCES["why"], "remedy": "Go and look."}],
            "localisation": [{"location": "node:725", "score": 4.2, "words": "the deck at x = 34 m (node 725)"}],
            "gain": {"held_out": "windy", "rows": 12, "before": 2.0, "after": 1.5, "reduction_pct": 25.0, "interval_pct": [8.0, 40.0], "level": 0.9},
            "measure_next": ["The modes with dampers at two or more amplitudes.", "Cannot be asked with these rows: crowd (no condition with people)."],
            "model_parameters": [{"name": "E_s", "unit": "Pa", "before": {"value": 2.1e11, "low": 2.05e11, "high": 2.16e11},
                                  "after": {"value": 2.04e11, "low": 2.0e11, "high": 2.09e11}, "level": 0.9}],
            "full_model": {"frequency_Hz": [], "reduced_Hz": [], "largest_deviation_pct": 0.0}, "parameters_on_bounds": [], "seconds": 1.0,
            "extended_model": "extended_model/"}
    return told | changes


def bar_stays(*stays):
    """The cause that step 9 finds without the catalogue, with a force a stay."""
    return {"cause": "barstays", "location": "global", "cluster": ["barstays@global"], "probability": 0.999, "log_odds": 14.5, "split_by": "", "state": "",
            "parameters": [parameter("modes_measured", "", 39.0, 39.0, 39.0), *(parameter(f"force_{s}_N", "N", 4e5, 3e5, 5e5) for s in stays)],
            "place": {"words": "the whole structure", "x_m": None, "y_m": None, "z_m": None}, "rivals": [],
            "sentence": f"Stays modelled as bars do not vibrate: {', '.join(stays)} swing with the deck. As cables they raise the modes explained from 27 to 33 of 39 measured",
            "remedy": "Go and look."}


def write_diagnosis(folder, told):
    """A finished folder of step 9."""
    made_up_study.write_rows(folder / "residuals.csv",
                             ["type", "mode", "channel", "condition", "held_out", "value", "std", "before", "after", "residual_before", "residual_after",
                              "beyond_before", "beyond_after"],
                             [["frequency_Hz", "1", "", "windy", 0, 0.748, 0.017, 0.69, 0.74, 3.4, 0.4, 0, 0],
                              ["frequency_Hz", "2", "", "windy", 1, 1.1, 0.02, 1.09, 1.1, 0.5, 0.1, 0, 0]])
    made_up_study.write_rows(folder / "hypotheses.csv", ["cause", "location", "log_odds", "screen", "signature_sigma", "status"],
                             [["fric", "dampers:C1,C2", 53.2, 110.0, 10.0, "fitted"], ["mass", "node:725", 51.1, 108.0, 10.0, "fitted"],
                              ["mass", "node:7", "", 2.0, 1.0, "screened"], ["wake", "", "", "", "", "not visible: no wind"]])
    made_up_study.write_rows(folder / "misfit.csv", ["by", "name", "rows", "mean_square_before", "mean_square_after"],
                             [["type", "frequency_Hz", 2, 5.9, 0.1]])
    (folder / "diagnosis.json").write_text(json.dumps(told), encoding="utf-8")
    made_up_study.write_manifest(folder)


def score_of(folder, **changes):
    """As tests/steps/diagnosis_score.py writes it for the diagnosis in `folder`."""
    return {"schema": 1, "diagnosis_sha256": hashlib.sha256((folder / "diagnosis.json").read_bytes()).hexdigest(), "scored": True, "verdict": "named",
            "hidden": [{"what": "Friction: the dampers C1 and C2 stand still below 500 N each.", "causes": ["fric"], "location": "dampers:C1,C2",
                        "answer": "in the set", "probability": 0.87,
                        "sizes": [{"name": "Fc_N", "words": "force at which each begins to slide", "unit": "N", "truth": 500.0, "value": 434.0, "low": 181.0,
                                   "high": 608.0, "inside": True},
                                  {"name": "k_lock_N_m", "words": "stiffness of each while it is held", "unit": "N/m", "truth": 1e7, "value": 5.4e6,
                                   "low": 4.7e6, "high": 6.4e6, "inside": False}]},
                       {"what": "The stays S1 and S2 vibrate.", "causes": ["barstays"], "location": "global", "answer": "missed", "probability": None,
                        "sizes": []}],
            "not_hidden": [], "also": "Hidden too: another mesh.",
            "parameters": {"words": "1 of 1 updated parameters came closer to the bridge's own value; 1 have no counterpart there",
                           "rows": [{"parameter": "E_s", "unit": "Pa", "initial_value": 210e9, "updated_value": 200e9, "lower": 199e9, "upper": 221e9,
                                     "true_value": 190e9, "true_least": 150e9, "true_largest": 300e9, "true_within_bounds": 0, "error_before_pct": 10.526,
                                     "error_after_pct": 5.263, "closer": 1},
                                    {"parameter": "C", "unit": "-", "initial_value": 1.0, "updated_value": 1.1, "lower": 0.9, "upper": 1.1}]}} | changes


def add_virtual(workflow, results, told=None):
    """A virtual campaign beside a made-up study, diagnosed and scored. @return its results folder"""
    beside = workflow.with_name(workflow.name + "_virtual")
    beside.mkdir()
    (beside / "study.toml").write_text('title = "Made-up bridge, virtual campaign"\nseed = 1\nmeasured = "virtual"\nsteps = ["s9_diagnosis"]\n', encoding="utf-8")
    folder = results.with_name(results.name + "_virtual")
    write_diagnosis(folder / "s9_diagnosis", told or diagnosis())
    (folder / "score").mkdir()
    (folder / "score/score.json").write_text(json.dumps(score_of(folder / "s9_diagnosis")), encoding="utf-8")
    return folder
