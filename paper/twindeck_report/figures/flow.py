"""The declared steps of a study, what each reads, and what its manifest says: for Fig. 1 and for the report."""
from dataclasses import dataclass

from ..manifests import read_manifest
from ..study import Study

# Every step there is: (in words, the paper's section, the steps it reads).
STEPS = {
    "s0_campaign": ("virtual test campaign", "3.1, 3.2", ()),
    "s1_model": ("preliminary FE model,\nprestress, modes", "2.2", ()),
    "s2_sensors": ("sensor setups, blind test", "3.1", ("s1_model",)),
    "s3_identification": ("modes from records", "3.2", ("s0_campaign",)),
    "s4_refinement": ("as-built changes,\npairing with measurement", "4.1", ("s1_model", "s3_identification")),
    "s5_sensitivity": ("sensitivities,\nselection of parameters", "4.2", ("s4_refinement",)),
    "s6_updating": ("bounded updating", "4.2", ("s4_refinement", "s5_sensitivity")),
    "s7_aerodynamics": ("aeroelastic stability", "5.1", ("s6_updating",)),
    "s8_validation": ("wind response\nagainst events", "5.2, 6", ("s7_aerodynamics",)),
    "s9_diagnosis": ("what is wrong, why, gain", "ours", ("s6_updating",)),
}
# The same in the words of a study of one's own, which has neither a preliminary model nor as-built changes.
OWN_WORDS = {"s1_model": "FE model, dead load,\nmodes", "s4_refinement": "pairing of modes\nwith measurement"}


@dataclass(frozen=True)
class FlowStep:
    token: str
    meaning: str
    section: str
    reads: tuple
    status: str  # converged | unconverged | not run
    seconds: float | None
    message: str
    commit: str


def flow(study: Study) -> list:
    """The steps that study.toml declares, in order."""
    declared = study.steps()
    found = []
    for token in declared:
        meaning, section, reads = STEPS.get(token, (token.partition("_")[2], "", ()))
        meaning = meaning if study.has_paper() else OWN_WORDS.get(token, meaning)
        manifest = read_manifest(study.results / token)
        if manifest is not None:
            study.used.add(study.results / token / "manifest.json")
        manifest = manifest or {}
        found.append(FlowStep(token, meaning, section, tuple(r for r in reads if r in declared), 
                              manifest.get("status", "not run"), manifest.get("seconds"), manifest.get("message", ""), str(manifest.get("commit", ""))))
    return found
