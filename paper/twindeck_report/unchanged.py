"""Results are read only as they were written: a file that was changed, or is gone, since its manifest was written is refused."""
from .errors import InputError
from .manifests import stale_inputs, stale_outputs
from .study import Study


def step_folders(study: Study) -> list:
    """The finished folders of steps; not what a step is writing (s4_refinement.partial-17) or could not finish (.unconverged)."""
    return [folder for folder in sorted(study.results.glob("s[0-9]*_*")) if folder.is_dir() and not folder.suffix]


def changed_steps(study: Study) -> list:
    """[(file, what is wrong)] over the folders of the steps."""
    return [finding for folder in step_folders(study) for finding in stale_outputs(folder)]


def changed_pages(study: Study) -> list:
    """[(file, what is wrong)] over tables/, figures/ and what the tables were made from."""
    made = [study.results / part for part in ("tables", "figures") if (study.results / part / "manifest.json").is_file()]
    found = [finding for folder in made for finding in stale_outputs(folder)]
    return found + (stale_inputs([study.results / "tables"]) if made else [])


def refuse_changed(study: Study, found: list) -> None:
    """@throws InputError naming the first file, if any was changed"""
    if not found:
        return
    path, problem = found[0]
    part = path.relative_to(study.results).parts[0] if path.is_relative_to(study.results) else "tables"
    more = f" (and {len(found) - 1} more files)" if len(found) > 1 else ""
    raise InputError(f"{path.as_posix()}: {problem}{more}; put it back, or remove {(study.results / part / 'manifest.json').as_posix()} "
                     f"and run `make {part.split('_')[0]} STUDY={study.name}`")
