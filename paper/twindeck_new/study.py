"""study.toml and a configuration for each step."""
import json
from pathlib import Path

from .campaign import Written
from .settings import Settings

OF_A_MODEL = ("s1_model", "s3_identification", "s4_refinement", "s5_sensitivity", "s6_updating", "s9_diagnosis")


def write_study(folder: Path, name: str, title: str, model: str | None, written: Written | None, settings: Settings | None, missing: list) -> None:
    """`model`: the line of the [model] table; None where none was given. Only steps that have what they read are declared."""
    steps = [s for s in OF_A_MODEL if (model or s == "s3_identification") and (written or s == "s1_model")]
    head = "".join(f"# missing: {line}\n" for line in missing)
    text = f'{head}title = {json.dumps(title, ensure_ascii=False)}\nseed = 1\nmeasured = "published"\n'
    if written:
        text += f'features = "results/{name}/s3_identification/features"\n'
    text += f"steps = {json.dumps(steps)}\n"
    if model:
        text += f"\n[model]\n{model.format(data=f'data/{name}')}\n"
    (folder / "study.toml").write_text(text, encoding="utf-8")
    for step, lines in _configurations(settings, written.conditions if written else []).items():
        if step in steps:
            (folder / f"{step}.toml").write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")


def _configurations(settings: Settings | None, conditions: list) -> dict:
    one = [f"condition = {json.dumps(conditions[0], ensure_ascii=False)}   # the state that the model is in, one of: {', '.join(conditions)}"] if len(conditions) > 1 else []
    modes = settings.modes if settings else 8
    identification = ['kind = "ambient"']
    if settings:
        identification += [] if settings.by_step else [f"decimation = {settings.decimation}", f"block_rows = {settings.block_rows}"]
        identification += [f"maximum_order = {settings.maximum_order}", f"blocks = {settings.blocks}"]
    return {"s1_model": [f"n_modes = {2 * modes}"], "s3_identification": identification, "s4_refinement": [f"n_modes = {2 * modes}", "maximum_frequency_error = 0.35", *one],
            "s5_sensitivity": [f"n_modes = {modes}"], "s6_updating": ['parameters_from = "s5_sensitivity"', f"n_modes = {2 * modes}", *one], "s9_diagnosis": []}
