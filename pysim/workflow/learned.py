"""Learned laws as Modelica classes: written beside an answer, and kept as effects of the user's own."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pysim.io import write_file
from pysim.types import BadInput, Effect

if TYPE_CHECKING:
    from pysim.effects import Slot
    from pysim.effects.learned import Formula
    from pysim.types.answer import Diagnosis, LearnedLaw
    from pysim.workflow.variants import Variants


def with_classes(found: Diagnosis, model: str, libraries: Sequence[Path]) -> Diagnosis:
    """An answer whose learned laws have their classes, and formulas where one describes the curve as well.

    A law of which no class can be written, as in a slot whose filling is more than equations, has "" there.

    Args:
        model: full name of the class in whose slots they stand.
        libraries: where that is.
    """
    from pysim.effects.learned import formulas, learned_class

    laws = []
    for law in found.learned:
        argument, name = law.argument.removeprefix(f"{law.slot}."), _effect_name(law)
        best = next(iter(formulas(law)), None)
        try:
            text = learned_class(law, _slot(law, model, libraries), class_name_of(name), libraries, effect=name)
        except BadInput:
            text = ""
        laws.append(replace(law, modelica=text, formula=best.text(argument) if best else ""))
    return replace(found, learned=tuple(laws))


def keep_law(
    law: LearnedLaw,
    name: str,
    model: str,
    libraries: Sequence[Path],
    folder: Path,
    *,
    description: str = "",
    formula: Formula | None = None,
    inner: Sequence[Effect] = (),
) -> Effect:
    """Write the class of a learned law into a folder, as a library of one effect.

    Args:
        name: of the effect, "my.damping" -> MyDamping.mo.
        model: full name of the class in whose slot it stands.
        libraries: where that is.
        folder: made where it is not there.
        formula: in place of the table.
        inner: effects in the same slot that become part of the class.
    Returns:
        the effect, as `pysim.effects.read_catalogue` reads it from that file beside the libraries.
    Raises:
        BadInput: the model has no such slot, the file is there, or no class can be written for the slot.
    """
    own = class_name_of(name)
    if not re.fullmatch(r"[A-Za-z]\w*", own, re.ASCII):
        raise BadInput(f"{name!r} makes no name of a class; begin with a letter, such as my.damping")
    file = folder / f"{own}.mo"
    if file.exists():
        raise BadInput(f"{file} is there already; give the law another name or folder")
    return _written(law, name, model, libraries, file, description=description, formula=formula, inner=inner)


def _written(law: LearnedLaw, name: str, model: str, libraries: Sequence[Path], file: Path, **more: Any) -> Effect:
    """The effect of a law's class, once that is in the file."""
    from pysim.effects import read_catalogue
    from pysim.effects.learned import learned_class

    text = learned_class(law, _slot(law, model, libraries), file.stem, libraries, effect=name, **more)
    file.parent.mkdir(parents=True, exist_ok=True)
    write_file(file, text)
    return next(one for one in read_catalogue(*libraries, file) if one.class_name == file.stem)


def with_laws(found: Diagnosis, variants: Variants, folder: Path) -> tuple[list[Effect], Variants]:
    """The effects of an answer and the laws that it learned, each the filling of a slot, and what builds models with
    them.

    Effects in the slot of a law become part of the law's class. A law stays out where no class holds all.

    Args:
        folder: gets the files of the laws, which are among the libraries then.
    """
    effects, libraries = [one.effect for one in found.effects if one.effect.class_name], variants.libraries
    for law in found.learned:
        beside, file = [one for one in effects if one.slot == law.slot], folder / law_file(law)
        if not law.modelica:
            continue
        with suppress(BadInput):  # the effect's law is more than equations, or no class holds all
            own = _written(law, _effect_name(law), variants.class_name, libraries, file, inner=beside)
            effects = [*(one for one in effects if one not in beside), own]
            libraries = (*libraries, file)
    return effects, replace(variants, libraries=libraries)


def law_file(law: LearnedLaw) -> str:
    """Name of the file of its class."""
    return f"{class_name_of(_effect_name(law))}.mo"


def _effect_name(law: LearnedLaw) -> str:
    argument = law.argument.removeprefix(f"{law.slot}.")
    return "_".join([f"learned.{law.slot}", "over", *re.split(r"\W+", argument.strip("]"))])


def _slot(law: LearnedLaw, model: str, libraries: Sequence[Path]) -> Slot:
    from pysim.effects import slots

    slot = next((one for one in slots(model, libraries) if one.name == law.slot), None)
    if slot is None:
        raise BadInput(f"{model} has no slot {law.slot}; name the model that the law was learned in")
    return slot


def class_name_of(effect: str) -> str:
    """Name of the class of an effect: "my.damping" -> MyDamping."""
    return "".join(word[:1].upper() + word[1:] for word in re.split(r"\W+|_", effect))
