"""A copy of the study for one changed input: every file a link to the original but the one that is changed, and the steps that read it
run anew, as far as the change reaches. A step is run if the contents of something that it read are another than its manifest says. Steps are
named with their study, "ponte_del_mare/s1_model": those of the virtual campaign, which the study's tables show too, come first."""
import json
import os
import shutil
import subprocess
from pathlib import Path

from twindeck_report.manifests import sha256

STEPS = ("s0_campaign", "s1_model", "s2_sensors", "s3_identification", "s4_refinement", "s5_sensitivity", "s6_updating", "s7_aerodynamics",
         "s8_validation")  # those that the tables of the paper rest on


class Scratch:
    def __init__(self, root: Path, origin: Path, study: str, binaries: Path, quick: dict):
        """@param root  is emptied  @param origin  the repository, with the finished results of the study"""
        self.root, self.origin, self.binaries, self.quick = root, origin, binaries, quick
        self.results = root / "results" / study
        shutil.rmtree(root, ignore_errors=True)
        for folder in ("data", "workflows"):
            link_tree(origin / folder, root / folder)
        self.results.mkdir(parents=True)
        self.steps = [f"{of}/{s}" for of in (f"{study}_virtual", study) for s in STEPS if (origin / "results" / of / s / "manifest.json").is_file()]
        for step in self.steps:
            self._link(step)
        self.done = []

    def own(self, file: str) -> None:
        """Makes a file a copy of its own, so that it can be changed."""
        path = self.root / file
        text = path.read_bytes()
        path.unlink()
        path.write_bytes(text)

    def waiting(self) -> list:
        """Steps that have to run, in order: an input changed, or one that they read is itself to be run. Their old results are out of
        sight until then."""
        out = []
        for step in self.steps:
            if step not in self.done and (self._changed(step) or any(before in out for before in self.reads(step))):
                out.append(step)
        for step in out:
            if (self.root / "results" / step).is_symlink():
                (self.root / "results" / step).unlink()
        for step in self.steps:  # a step before it came out the same: what was out of sight is right after all
            if step not in out and step not in self.done and not (self.root / "results" / step).exists():
                self._link(step)
        return out

    def run(self, step: str) -> str:
        """"" or, if it fails, its last line, which begins with the step's name."""
        study, token = step.split("/")
        options = [f for setting in self.quick.get(token, []) for f in ("--set", setting)]
        command = [str(self.binaries / token), "--study", f"workflows/{study}", "--results", f"results/{study}", "--out", f"results/{step}", "--quiet",
                   *options]
        done = subprocess.run(command, cwd=self.root, capture_output=True, text=True)
        self.done.append(step)
        return "" if done.returncode == 0 else (done.stderr.strip().splitlines() or [f"{step}: exit code {done.returncode}"])[-1]

    def inputs(self, step: str) -> dict:
        manifest = self.origin / "results" / step / "manifest.json"
        return json.loads(manifest.read_text(encoding="utf-8"))["inputs"]

    def reads(self, step: str) -> set:
        """Earlier steps whose files it reads."""
        return {"/".join(name.split("/")[1:3]) for name in self.inputs(step) if name.startswith("results/")}

    def seconds(self, step: str) -> float:
        manifest = self.origin / "results" / step / "manifest.json"
        return float(json.loads(manifest.read_text(encoding="utf-8")).get("seconds", 0.0))

    def _link(self, step: str) -> None:
        (self.root / "results" / step).parent.mkdir(parents=True, exist_ok=True)
        (self.root / "results" / step).symlink_to(self.origin / "results" / step)

    def _changed(self, step: str) -> bool:
        """Files that are links, or lie in a step's folder that is one, are the originals; a link to a file of this copy is not."""
        return any(self._own(self.root / name) and sha256(self.root / name) != digest for name, digest in self.inputs(step).items())

    def _own(self, path: Path) -> bool:
        return path.is_file() and path.resolve().is_relative_to(self.root.resolve())


def link_tree(origin: Path, to: Path) -> None:
    """The folders of `origin` below `to`, their files as links."""
    for folder, names, files in os.walk(origin):
        names[:] = [n for n in names if n != "__pycache__"]
        here = to / Path(folder).relative_to(origin)
        here.mkdir(parents=True, exist_ok=True)
        for name in files:
            file = Path(folder) / name  # a link within the tree, two studies on one file, stays one
            (here / name).symlink_to(file.readlink() if file.is_symlink() and not file.readlink().is_absolute() else file)

