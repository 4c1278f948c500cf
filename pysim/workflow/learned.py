"""A learned law as an effect that a user keeps."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from pysim.types import BadInput, Effect

if TYPE_CHECKING:
    from pysim.diagnosis.learn.formula import Formula
    from pysim.types.answer import LearnedLaw


def keep_law(
    law: LearnedLaw,
    name: str,
    model: str,
    libraries: Sequence[Path],
    folder: Path,
    *,
    description: str = "",
    formula: Formula | None = None,
) -> Effect:
    """Write the class of a learned law into a folder, as a library of one effect.

    Args:
        name: of the effect, "my.damping" -> MyDamping.mo.
        model: full name of the class in whose slot it stands.
        libraries: where that is.
        folder: made where it is not there.
        formula: in place of the table.
    Returns:
        the effect, as `pysim.effects.read_catalogue` reads it from that file.
    Raises:
        BadInput: the model has no such slot, the file is there, or no class can be written for the slot.
    """
    from pysim.diagnosis.learn.law_class import law_class
    from pysim.effects import read_catalogue, slots

    slot = next((one for one in slots(model, libraries) if one.name == law.slot), None)
    if slot is None:
        raise BadInput(f"{model} has no slot {law.slot}; name the model that the law was learned in")
    own = "".join(word[:1].upper() + word[1:] for word in re.split(r"\W+|_", name))
    if not re.fullmatch(r"[A-Za-z]\w*", own, re.ASCII):
        raise BadInput(f"{name!r} makes no name of a class; begin with a letter, such as my.damping")
    file = folder / f"{own}.mo"
    if file.exists():
        raise BadInput(f"{file} is there already; give the law another name or folder")
    text = law_class(law, slot, own, libraries, effect=name, description=description, formula=formula)
    folder.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    (effect,) = read_catalogue(file)
    return effect
