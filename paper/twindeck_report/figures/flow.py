"""The declared steps of a study, what each has read and how it ended, as its manifest says: for Fig. 1 and for the report."""
from dataclasses import dataclass
from pathlib import PurePath

from ..manifests import read_manifest
from ..study import Study

# Every step there is: (in words, the paper's section, the number of the paper's Fig. 1 that it stands for).
STEPS = {
    "s0_campaign": ("virtual test campaign", "3.1, 3.2", ""),
    "s1_model": ("preliminary FE model,\nprestress, modes", "2.2", "1"),
    "s2_sensors": ("sensor setups, blind test", "3.1", "2"),
    "s3_identification": ("modes from records", "3.2", "3"),
    "s4_refinement": ("as-built changes,\npairing with measurement", "4.1", "4"),
    "s5_sensitivity": ("sensitivities,\nselection of parameters", "4.2", "5"),
    "s6_updating": ("bounded updating", "4.2", "6"),
    "s7_aerodynamics": ("aeroelastic stability", "5.1", "7"),
    "s8_validation": ("wind response\nagainst events", "5.2, 6", "8"),
    "s9_diagnosis": ("what is wrong, why, gain", "ours", ""),
    "s10_reliability": ("reliability in wind,\nover years", "ours", ""),
}
# The same in the words of a study of one's own, which has neither a preliminary model nor as-built changes.
OWN_WORDS = {"s1_model": "FE model, dead load,\nmodes", "s4_refinement": "pairing of modes\nwith measurement"}


@dataclass(frozen=True)
class FlowStep:
    token: str
    meaning: str
    section: str
    reads: tuple  # steps of the same study whose files its manifest lists
    status: str  # converged | unconverged | not run
    seconds: float | None
    message: str
    commit: str
    elsewhere: tuple = ()  # (study, step) of other studies whose files it lists
    paper_step: str = ""  # of the paper's Fig. 1


def flow(study: Study) -> list:
    """The steps that study.toml declares, in order, and what each has read by the manifest of its last run."""
    declared = study.steps()
    found = []
    for token in declared:
        meaning, section, number = STEPS.get(token, (token.partition("_")[2], "", ""))
        meaning = meaning if study.has_paper() else OWN_WORDS.get(token, meaning)
        manifest = read_manifest(study.results / token)
        if manifest is not None:
            study.used.add(study.results / token / "manifest.json")
        manifest = manifest or {}
        read = sorted({step for name in manifest.get("inputs", {}) if (step := _step_of(name))})
        found.append(FlowStep(token, meaning, section, tuple(s for folder, s in read if folder == study.results.name and s in declared and s != token),
                              manifest.get("status", "not run"), manifest.get("seconds"), manifest.get("message", ""), str(manifest.get("commit", "")),
                              tuple((folder, s) for folder, s in read if folder != study.results.name), number))
    return found


def _step_of(name: str) -> tuple | None:
    """(study, step) whose folder a file lies in."""
    parts = PurePath(name).parts
    at = next((i for i, part in enumerate(parts[1:-1], 1) if part in STEPS), None)
    return None if at is None else (parts[at - 1], parts[at])
