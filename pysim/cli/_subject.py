"""What the commands of the diagnosis have in common: a data set, a model, libraries, and what may be refitted."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pysim.cli._variants import Variants
    from pysim.cli.command import Given
    from pysim.diagnose import Subject
    from pysim.effects import Slot
    from pysim.types import Dataset, Effect, Model


@dataclass(frozen=True)
class Named:
    """What the command line named.

    Args:
        subject: for the steps of the diagnosis.
        dataset: its measurements.
        variants: builds models with effects; None where the model's class is not at hand.
        overrides: parameters that were set, in the variables' units.
        libraries: the user's own, beside the one that comes along.
    """

    subject: Subject
    dataset: Dataset
    variants: Variants | None
    overrides: dict[str, float]
    libraries: tuple[Path, ...]

    @property
    def model_name(self) -> str:
        """The class, or the FMU's model where there is none."""
        return self.variants.class_name if self.variants else self.subject.model.name


def read_subject(args: Given, *, refits: bool = True, only: Sequence[str] = ()) -> Named:
    """Model, data and catalogue of a command line.

    Args:
        refits: whether parameters will be refitted, so that some must be free.
        only: effects to consider; all that the slots take, where none is named.
    Raises:
        BadInput: what cannot be read, or does not go together. BuildError: a model that does not compile.
    """
    from pysim.cli._any_model import is_fmu
    from pysim.cli._built_in import built_in
    from pysim.cli._free import begun_at, free_parameters, held_as_set
    from pysim.cli._variants import Variants
    from pysim.cli.options import chosen_reference, read_parameters
    from pysim.diagnose import Inside, subject
    from pysim.effects import STANDARD_LIBRARY, slots
    from pysim.io import in_model_units

    dataset, left_out = _diagnosed(args.dataset)
    libraries = [STANDARD_LIBRARY, *args.library]
    model, class_name, notes = _model(args.typed["model"], libraries)
    dataset, notes = in_model_units(dataset, model), [*left_out, *notes]
    catalogue = _catalogue(libraries, only, class_name)
    if class_name and not catalogue:
        notes.append(f"no slot of {class_name} takes an effect of the libraries, so none could be tried")
    variants = Variants(class_name, libraries) if class_name else None
    inside = Inside(slots(class_name, libraries), variants.probed) if variants else None
    reference_hz = chosen_reference(args.reference_hz, dataset.responses())
    overrides, bounds = read_parameters(args, model), args.bounds
    free = free_parameters(model, args.free, bounds, overrides) if refits else ()
    if refits:
        model = begun_at(model, {name: overrides.pop(name) for name in free if name in overrides})
        notes += held_as_set(model, overrides)
    if refits and class_name and is_fmu(args.typed["model"]):
        own = {name: value for name, value in built_in(model, class_name, libraries).items() if name not in free}
        if own:
            notes.append(f"built with values of its own, which every candidate has too: {', '.join(own)}")
        overrides = own | overrides
    given = subject(
        model,
        dataset,
        catalogue,
        variants,
        free=free,
        bounds=bounds,
        overrides=overrides,
        reference_hz=reference_hz,
        inside=inside,
        notes=tuple(notes),
    )
    return Named(given, dataset, variants, overrides, tuple(args.library))


def _diagnosed(dataset: Dataset) -> tuple[Dataset, list[str]]:
    """What a diagnosis counts of the measurements, and a note on what it does not: nuisances of logs over time, such as
    a sensor's gain, are no matter of a table of responses, so that the two are not counted in one."""
    logs = dataset.logs()
    count = len(dataset.records) - len(logs)
    if not logs or not count:
        return dataset, []
    note = (
        f"left out: tables of frequency responses ({count}), beside logs over time; they need a data set of their own"
    )
    return replace(dataset, records=tuple(logs)), [note]


def read_inside(args: argparse.Namespace) -> tuple[Model, str, tuple[Slot, ...], tuple[Effect, ...]]:
    """A model, its class where that is known, its slots, and the effects of the libraries that these take.

    Raises:
        BadInput: an FMU that cannot be read. BuildError: a class that does not compile.
    """
    from pysim.effects import STANDARD_LIBRARY, slots

    libraries = [STANDARD_LIBRARY, *args.library]
    model, class_name, _ = _model(args.model, libraries)
    if not class_name:
        return model, "", (), ()
    return model, class_name, slots(class_name, libraries), _catalogue(libraries, [], class_name)


def effects_of(names: Sequence[str], given: Named, option: str = "--effects") -> tuple[Effect, ...]:
    """Effects that an option names, in order.

    Raises:
        BadInput: one that is not in the catalogue or in no slot, one twice, or a model without its class.
    """
    from pysim.effects import STANDARD_LIBRARY, read_catalogue
    from pysim.types import BadInput

    if given.variants is None:
        raise BadInput(
            f"nothing can be added to {given.model_name}: its class is in none of the libraries; name its library with "
            "--library"
        )
    for name in names:
        if list(names).count(name) > 1:
            raise BadInput(f"{option} {name}: named twice; name each effect once")
    catalogue = read_catalogue(STANDARD_LIBRARY, *given.libraries)
    return named_effects(names, given.subject.catalogue, catalogue, option, given.model_name)


def _model(text: str, libraries: Sequence[Path]) -> tuple[Model, str, list[str]]:
    """The base model, its class where that is known, and notes."""
    from pysim.cli._any_model import is_fmu, read_fmu_or_class
    from pysim.effects import declares

    model = read_fmu_or_class(text, libraries)
    if not is_fmu(text):
        return model, text, []
    if declares(model.name, libraries):
        return model, model.name, []
    return model, "", _out_of_sight(model)


def _out_of_sight(model: Model) -> list[str]:
    """What cannot be looked at in a model without its Modelica class."""
    from pysim.present.diagnosis.words import SHUT

    names = {c: [v.name for v in model.variables if v.causality == c] for c in ("input", "output")}
    states = model.abilities.states
    inside = f"nothing inside it: neither its {len(states)} states nor the terms of their equations"
    return [
        f"{model.name} is {SHUT}, so no effect can be added; name its library with --library",
        f"looked at were the inputs {', '.join(names['input']) or '(none)'} and the outputs "
        f"{', '.join(names['output']) or '(none)'} of {model.label}, {inside}",
    ]


def _catalogue(libraries: Sequence[Path], names: Sequence[str], class_name: str) -> tuple[Effect, ...]:
    """Effects of the libraries that the class takes; all where it is not known. Those wanted, where any are named."""
    from pysim.effects import fitting, read_catalogue

    catalogue = read_catalogue(*libraries)
    taken = fitting(catalogue, class_name, libraries) if class_name else catalogue
    return named_effects(names, taken, catalogue, "--effects", class_name) if names else taken


def named_effects(
    names: Sequence[str], taken: Sequence[Effect], catalogue: Sequence[Effect], option: str, class_name: str
) -> tuple[Effect, ...]:
    """The effects of these names.

    Args:
        taken: those that the model's slots take, of the catalogue.
        option: for messages.
    Raises:
        BadInput: one that is not in the catalogue, or that no slot of the model takes.
    """
    from pysim.cli.option import did_you_mean
    from pysim.types import BadInput

    known, fit = {effect.name for effect in catalogue}, {effect.name: effect for effect in taken}
    for name in names:
        if name not in known:
            near = did_you_mean(name, known) or f"; it has {', '.join(sorted(known))}"
            raise BadInput(f"{option} {name}: not in the catalogue{near}")
        if name not in fit:
            raise BadInput(
                f"{option} {name}: no slot of {class_name} takes it; its slots take {', '.join(fit) or 'none of them'}"
            )
    return tuple(fit[name] for name in names)
