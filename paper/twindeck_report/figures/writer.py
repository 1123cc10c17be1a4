"""figures/<name>.pdf, .png and the plotted data beside them as .csv, then figures/manifest.json."""
import shutil
import tempfile
import time
from pathlib import Path

from ..errors import InputError
from ..manifests import write_manifest
from ..study import Study
from ..tables.writer import write_csv
from . import figures_of
from .style import save


def write_figures(study: Study) -> list:
    """Figures whose step belongs to the study; a declared step that has not run is an error, and then none is replaced. Returns
    their names."""
    started = time.monotonic()
    folder = study.results / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    names, written = [], []
    with tempfile.TemporaryDirectory(dir=study.results, prefix=".figures_") as fresh:
        for figure in figures_of(study):
            picture, data = figure.draw(study)
            written += save(picture, Path(fresh) / figure.NAME)
            write_csv(data, Path(fresh) / f"{figure.NAME}.csv")
            written.append(Path(fresh) / f"{figure.NAME}.csv")
            names.append(figure.NAME)
        written = [Path(shutil.move(path, folder / path.name)) for path in written]
    write_manifest("figures", folder, study.used, written, started)
    return names


def write_figure(study: Study, name: str) -> Path:
    """One figure, as soon as its own steps have run: look/<name>.png, .pdf, .csv. Returns the picture's path. The figures of the study,
    which go together, are left as they are."""
    figures = {figure.NAME: figure for figure in figures_of(study)}
    if name not in figures:
        raise InputError(f"--only: study {study.name} has no figure {name}; it has {', '.join(figures)}")
    picture, data = figures[name].draw(study)
    folder = study.results / "look"
    folder.mkdir(parents=True, exist_ok=True)
    save(picture, folder / name)
    write_csv(data, folder / f"{name}.csv")
    return folder / f"{name}.png"
