"""Where a study keeps what, and reading its CSV and TOML files with errors that name file and mend."""
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from .errors import InputError


@dataclass
class Study:
    """Paths of one study, all relative to where the command was given (the repository root)."""

    name: str
    results: Path  # results/<study>: step folders, tables/, figures/, report/
    data: Path  # data/<study>: paper/, tolerances.toml, known_deviations.toml, errata.toml, orders.toml, ratchet_baseline.csv
    workflow: Path  # workflows/<study>: study.toml, one config a step
    used: set = field(default_factory=set)  # every file read so far: the inputs of a manifest

    def read_csv(self, path: Path, columns=(), text=False) -> pd.DataFrame:
        """A CSV file with at least `columns`. An empty cell is NaN and every other text stays text, so that a channel may be called NA; `text`
        keeps every cell as printed."""
        if not path.is_file():
            raise InputError(f"{path}: missing; {self._mend(path)}")
        try:
            frame = pd.read_csv(path, dtype=str if text else None, keep_default_na=False, na_values=[] if text else [""], encoding="utf-8")
        except (ValueError, UnicodeDecodeError) as problem:
            raise InputError(f"{path}: not a readable CSV file ({problem})") from problem
        lacking = [c for c in columns if c not in frame.columns]
        if lacking:
            raise InputError(f"{path}: no column {', '.join(lacking)}; found {', '.join(frame.columns)}")
        self.used.add(path)
        return frame

    def step_csv(self, name: str, columns=(), text=False) -> pd.DataFrame:
        """A step's output, e.g. step_csv("s1_model/modes.csv")."""
        return self.read_csv(self.path_of(name), columns, text)

    def path_of(self, name: str) -> Path:
        """A step's file: of this study, or of its virtual campaign where that alone has the step."""
        step, campaign = name.split("/")[0], self.campaign()
        return (campaign if campaign is not self and step not in self.steps() and step in campaign.steps() else self).results / name

    def has(self, step: str) -> bool:
        """This study or its virtual campaign has the step."""
        return step in self.steps() or step in self.campaign().steps()

    def paper_table(self, number: int) -> pd.DataFrame:
        """A table as the paper prints it: every cell as text, because the printed digits carry meaning."""
        return self.read_csv(self.data / "paper" / f"table_{number:02d}.csv", text=True)

    def read_toml(self, path: Path) -> dict:
        if not path.is_file():
            raise InputError(f"{path}: missing; {self._mend(path)}")
        try:
            content = tomllib.loads(path.read_text(encoding="utf-8"))
        except tomllib.TOMLDecodeError as problem:
            raise InputError(f"{path}: not valid TOML: {problem}") from problem
        self.used.add(path)
        return content

    def steps(self) -> list:
        """The declared steps of workflows/<study>/study.toml, in order."""
        steps = self.read_toml(self.workflow / "study.toml").get("steps")
        if not isinstance(steps, list) or not all(isinstance(s, str) for s in steps):
            raise InputError(f'{self.workflow / "study.toml"}: steps: expected a list such as ["s1_model", "s4_refinement"]')
        return steps

    def has_paper(self) -> bool:
        """A study without printed tables has nothing to be compared with."""
        return (self.data / "paper").is_dir()

    def virtual(self) -> "Study | None":
        """This one's virtual campaign, workflows/<study>_virtual, with the paper of this one; None where there is none."""
        workflow, results = (path.with_name(f"{path.name}_virtual") for path in (self.workflow, self.results))
        return Study(f"{self.name}_virtual", results, self.data, workflow, self.used) if (workflow / "study.toml").is_file() else None

    def campaign(self) -> "Study":
        """The study that the records are of, and what is identified in them: the virtual one where it has that step, else this one."""
        virtual = self.virtual()
        return virtual if virtual is not None and "s3_identification" in virtual.steps() else self

    def _mend(self, path: Path) -> str:
        try:
            first = path.relative_to(self.results).parts[0]
        except ValueError:
            virtual = self.virtual()
            if virtual is not None and path.is_relative_to(virtual.results):
                return virtual._mend(path)
            return "it belongs to the repository's inputs (give --data or --workflow if they lie elsewhere)"
        if first in ("tables", "figures"):
            return f"run `make {first} STUDY={self.name}` first"
        return f"run `make {first.split('_')[0]} STUDY={self.name}` first"
