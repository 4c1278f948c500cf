"""A model to take away: its class, its FMU and its values."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path

from pysim.io import write_file
from pysim.present.report import joining
from pysim.types import BadInput, Effect, Model
from pysim.workflow.built_in import built_in
from pysim.workflow.extended import PARAMETERS, copied, extended_name, needed, parameters_text
from pysim.workflow.variants import Variants


def export_model(
    model: Model,
    variants: Variants | None,
    effects: Sequence[Effect],
    values: Mapping[str, float],
    folder: Path,
    *,
    fmi: int = 2,
    platforms: Sequence[str] = ("host",),
) -> dict[str, Path]:
    """Write a model with its values: class and FMU where its class is known, else a copy of the FMU.

    Args:
        model: without the effects.
        variants: builds it with effects; None where its class is in no library.
        effects: that it has besides.
        values: parameters that differ from its own, by their full names; a class gets those of the model's FMU too.
        folder: made where it is not there.
        fmi, platforms: of the FMU, as `fmu_build.build` says; an FMU of others stays as it is.
    Returns:
        "modelica", "fmu" and "parameters" -> path; beside them copies of the user's files that the class needs.
    Raises:
        BadInput: a class that does not compile or cannot be what its FMU is, or what `joining` refuses of the folder.
    """
    own = {name: value for name, value in values.items() if not _is_state(model, name)}
    with joining(folder) as new:
        if variants is None:
            files = {"fmu": new / model.path.name}
            shutil.copyfile(model.path, files["fmu"])
        else:
            own = built_in(model, variants.libraries) | own
            name = _name(variants, effects)
            files = {"modelica": new / f"{name}.mo", "fmu": new / f"{name}.fmu"}
            about = f"{variants.class_name}{' with ' if effects else ''}{', '.join(effect.name for effect in effects)}."
            variants.write(effects, new, files["fmu"], name, own, about, fmi=fmi, platforms=platforms)
            files |= {copy.stem: copy for copy in copied(needed(variants, effects), new, f"{name}.mo").values()}
        if own:
            files["parameters"] = new / PARAMETERS
            write_file(files["parameters"], parameters_text(f"Of {files['fmu'].stem}.", own))
    return {name: folder / path.name for name, path in files.items()}


def _name(variants: Variants, effects: Sequence[Effect]) -> str:
    if effects:
        return extended_name(variants.class_name, [effect.class_name for effect in effects])
    return f"{variants.class_name.rpartition('.')[2]}Fitted"


def _is_state(model: Model, name: str) -> bool:
    """Whether a value is one that a state starts at, which is no parameter of the class."""
    try:
        return model[name].causality != "parameter"
    except BadInput:  # of an effect
        return False
