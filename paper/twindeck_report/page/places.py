"""Where a location of the diagnosis (node:7, stay:NE3, group:E_c1, …) lies on the model."""
from pathlib import Path

import numpy as np

from ..study import Study
from .drawing import read_drawing
from .shapes import packed

LEAST_FULL = 3.0  # standard deviations at the end of the colours at least: what is smaller is noise and shall not look alarming


def places(study: Study, settings: dict, folder: str | None, localisation: list) -> list:
    """[{location, score, spots: [[x, y, z], …], nodes: positions in the drawing}], highest score first; spots and nodes stay empty
    where a location has no place, as for a mode or a sensor whose place nobody told."""
    drawing = read_drawing(study, folder) if folder else None
    finder = _Finder(study, settings, folder, drawing)
    ordered = sorted(localisation, key=lambda entry: -entry["score"])
    return [{"location": e["location"], "words": e.get("words", e["location"]), "score": e["score"], **finder.find(e["location"])} for e in ordered]


def stays_of(effect: dict) -> list:
    """Stays that the extended model has as cables, where that is the cause; step 9 names them by their forces alone."""
    names = [p["name"] for p in effect.get("parameters", [])] if effect.get("cause") == "barstays" else []
    return [name.removeprefix("force_").removesuffix("_N") for name in names if name.startswith("force_")]


def place_of(effect: dict) -> tuple:
    """(location, in words) of a cause."""
    stays = stays_of(effect)
    if stays:
        return "stays:" + ",".join(stays), "the stay" + ("s " if len(stays) > 1 else " ") + " and ".join(filter(None, [", ".join(stays[:-1]), stays[-1]]))
    return effect["location"], (effect.get("place") or {}).get("words") or ""


def where_data(found: list, nodes: int) -> dict:
    """Scores as colours of the drawing's nodes, and spots for what acts at a point."""
    score = np.zeros(nodes)
    spots = []
    for entry in found:
        at = [i for i in entry["nodes"] if i < nodes]
        score[at] = np.maximum(score[at], entry["score"])
        spots += [
            {"name": entry.get("words", entry["location"]), "score": round(entry["score"], 2), "at": [round(float(x), 3) for x in spot]}
            for spot in entry["spots"]
        ]
    most = max([LEAST_FULL, *(entry["score"] for entry in found)])
    return {"mesh": 0, "score": packed(score / most, "f4"), "spots": spots, "most": round(most, 2)}


class _Finder:
    def __init__(self, study, settings, folder, drawing):
        self.study, self.folder, self.drawing, self.nodes, self.channels, self.groups = study, folder, drawing, {}, {}, {}
        if folder and drawing:
            table = study.step_csv(f"{folder}/nodes.csv", ["node", "x_m", "y_m", "z_m"])
            self.nodes = {str(r["node"]): [r["x_m"], r["y_m"], r["z_m"]] for r in table.to_dict("records")}
            for parameter in study.read_toml(study.results / folder / "model.toml").get("parameter", []):
                self.groups[parameter["name"]] = parameter.get("of", [])
        listed = Path(str(settings.get("features", ""))) / "channels.csv"
        if settings.get("features") and listed.is_file():
            table = study.read_csv(listed)
            if {"channel", "x_m", "y_m", "z_m"} <= set(table.columns):
                self.channels = {
                    str(r["channel"]): [r["x_m"], r["y_m"], r["z_m"]]
                    for r in table.dropna(subset=["x_m", "y_m", "z_m"]).to_dict("records")
                }

    def find(self, location: str) -> dict:
        kind, _, names = location.partition(":")
        kind, parts = kind.removesuffix("s"), names.split(",")
        spots, nodes = [], []
        if kind == "node":
            spots = [self.nodes[p] for p in parts if p in self.nodes]
        elif kind == "channel":
            spots = [self.channels[p] for p in parts if p in self.channels]
        elif kind in ("support", "damper"):
            spots = [spot for part in parts for spot in self._attached(part)]
        elif self.drawing is not None and kind in ("element", "stay"):
            of = self.drawing.elements if kind == "element" else self.drawing.names
            each = [sorted(of[part]) for part in parts if part in of]
            nodes = [i for one in each for i in one]
            spots = [self.drawing.points[one].mean(axis=0).tolist() for one in each]
        elif self.drawing is not None and kind == "group":
            nodes = sorted({i for part in parts for group in self.groups.get(part, [part]) for i in self.drawing.groups.get(group, [])})
        return {"spots": spots, "nodes": nodes}

    def _attached(self, name: str) -> list:
        """Where the supports or springs are that bear this name, or whose group does, each place once."""
        found = []
        for file, key, node in (("supports.csv", "support", "node"), ("springs.csv", "spring", "node2")):
            if self.folder and (self.study.results / self.folder / file).is_file():
                table = self.study.step_csv(f"{self.folder}/{file}", [key, "node"])
                for row in table.to_dict("records"):
                    if name in (str(row[key]), str(row.get("group"))):
                        at = row.get(node) if row.get(node) == row.get(node) else row["node"]
                        found += [self.nodes[k] for k in (str(at).removesuffix(".0"),) if k in self.nodes and self.nodes[k] not in found]
        return found
