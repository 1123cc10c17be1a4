"""twindeck new NAME --from FILES: writes data/NAME and workflows/NAME, all of it or nothing, and prints line by line what is still missing."""
import argparse
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

from . import model as models
from .campaign import all_known, copied_name, write_campaign
from .errors import InputError
from .inspection import inspected
from .sensors import table_of_sensors
from .settings import Settings, chosen
from .study import write_study


def main(arguments) -> int:
    options = _parse(arguments)
    try:
        return _new(options.name, [Path(f) for f in options.files], Path(options.bin))
    except InputError as problem:
        print(f"new: {problem}", file=sys.stderr)
        return 2


def _parse(arguments):
    parser = argparse.ArgumentParser(prog="twindeck new", description="A study out of records, a table of sensors and a model, as they lie there.")
    parser.add_argument("name", help="of the study: small letters, digits and _")
    parser.add_argument("--from", dest="files", nargs="+", required=True, metavar="FILE", help="records, a table of sensors (channel, x, y, z, direction), a deck or a model folder")
    parser.add_argument("--bin", default="build/bin", help="folder of the executables")
    return parser.parse_args(arguments)


def _new(name: str, files: list, bin_folder: Path) -> int:
    targets = [Path("workflows") / name, Path("data") / name]
    for place in targets:
        if place.exists():
            raise InputError(f"{place} is there already; choose another name, or remove it yourself")
    title = re.sub(r"_+", " ", name).strip().capitalize()
    source, tables, records = _sorted_out(files, bin_folder, title)
    with tempfile.TemporaryDirectory(dir=".") as folder:  # moved into place when all of it is there
        workflow, data = Path(folder) / "workflow", Path(folder) / "data"
        workflow.mkdir()
        data.mkdir()
        missing = all_known(tables, records)
        written = write_campaign(records, tables, data / "campaign", source.nodes if source else None) if records else None
        settings = _settings(bin_folder, data / "campaign", targets[1] / "campaign", records)
        line = models.copy_model(source, data) if source else None
        missing += (written.missing if written else ["records: none given; state measured modes in features/ or take s3_identification in with records"])
        missing += source.missing if source else ["a model: put a folder or a deck into data/ and name it in study.toml, [model]; then add the steps from s1_model on"]
        write_study(workflow, name, title, line, written, settings, missing)
        for made, place in zip((workflow, data), targets):
            place.parent.mkdir(exist_ok=True)
            shutil.move(made, place)
    _told(name, targets, records, settings, (source.read if source else []) + (written.read if written else []), missing)
    return 0


def _sorted_out(files: list, bin_folder: Path, title: str) -> tuple:
    """(model or None, tables of sensors, records)"""
    source, tables, records = None, [], []
    for file in _files_in(files):
        if models.is_model_folder(file) or models.is_deck(file):
            if source is not None:
                raise InputError(f"{file}: a second model beside {source.source}; give one")
            source = models.read_model(bin_folder, file, title)
        elif (table := table_of_sensors(file)) is not None:
            tables.append(table)
        else:
            records.append(inspected(bin_folder, file))
    if not records and source is None:
        raise InputError(f"{files[0]}: neither a record nor a model; give at least one of the two")
    copies = [copied_name(r, records) for r in records]
    twice = next((r.file for i, r in enumerate(records) if copies[i] in copies[:i]), None)
    if twice is not None:
        raise InputError(f"{twice}: a second record of that name; rename one of them")
    return source, tables, records


def _files_in(files: list) -> list:
    """The files themselves, and in the place of a folder that is no model all files in it."""
    found = []
    for file in files:
        if not file.exists():
            raise InputError(f"{file} is not there; give records, a table of sensors, a deck or a model folder")
        inside = file.is_dir() and not models.is_model_folder(file)
        found += sorted(f for f in file.rglob("*") if f.is_file() and not f.name.startswith(".")) if inside else [file]
    return found


def _settings(bin_folder: Path, campaign: Path, place: Path, records: list) -> Settings | None:
    """None where nothing is known of the records' spectra: step 3 then chooses for itself. `place`: where the campaign will be."""
    if not records or any(r.rate_Hz is None for r in records):
        return None  # without a rate there is no spectrum in Hz
    rate, samples = min(r.rate_Hz for r in records), min(r.samples for r in records)
    try:
        settings = chosen(bin_folder, campaign, rate, samples)
    except InputError as problem:
        print(f"new: step 3 says of these records: {_with_own_files(str(problem), campaign, place, records)}; "
              "s3_identification.toml leaves band, block length and orders to the step", file=sys.stderr)
        return None
    return settings if settings.peaks_Hz else None


def _with_own_files(text: str, campaign: Path, place: Path, records: list) -> str:
    """The files that the user gave in the place of their copies, and the campaign's own where they will be."""
    folders = (str(campaign.resolve()), str(campaign))
    before = "(?:" + "|".join(re.escape(f"{folder}/") for folder in folders) + r"|(?<![\w/.]))"  # the step names files of the campaign without its folder too
    for record in records:
        text = re.sub(before + re.escape(f"records/{copied_name(record, records)}") + r"(?![\w.])", lambda _, file=record.file: str(file), text)
    for folder in folders:
        text = text.replace(folder, str(place))
    return text


def _told(name: str, targets: list, records: list, settings: Settings | None, read: list, missing: list) -> None:
    for record in records:
        print(f"record   {record.file.name}: {len(record.columns)} channels, {record.samples} samples, " + ("lines of frequency response functions" if record.responses else f"{record.rate_Hz:.6g} Hz" if record.rate_Hz else "rate unknown"))
    if settings is not None and settings.peaks_Hz:
        sampling = "step 3 chooses decimation and block length" if settings.by_step else f"decimation {settings.decimation}, block_rows {settings.block_rows}"
        print(f"band     {len(settings.peaks_Hz)} peaks from {settings.peaks_Hz[0]:.4g} to {settings.peaks_Hz[-1]:.4g} Hz: {sampling}, maximum_order {settings.maximum_order}")
    print(f"written  {targets[0]}/, {targets[1]}/")
    for line in read:
        print(f"read     {line}")
    for line in missing:
        print(f"missing  {line}")
    run = os.environ.get("TWINDECK_RUN", "make all STUDY=")
    print(f"next     {'fill in what is missing, then ' if missing else ''}{run}{name}")
