"""figures/<name>.pdf, .png and the plotted data beside them as .csv, then figures/manifest.json."""
import time

from ..manifests import write_manifest
from ..study import Study
from ..tables.writer import write_csv
from . import figures_of
from .style import save


def write_figures(study: Study) -> list:
    """Figures whose step belongs to the study; a declared step that has not run is an error. Returns their names."""
    started = time.monotonic()
    drawn = [(figure.NAME, *figure.draw(study)) for figure in figures_of(study)]
    folder = study.results / "figures"
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for name, picture, data in drawn:
        written += save(picture, folder / name)
        write_csv(data, folder / f"{name}.csv")
        written.append(folder / f"{name}.csv")
    write_manifest("figures", folder, study.used, written, started)
    return [name for name, *_ in drawn]
