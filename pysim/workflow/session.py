"""What a diagnosis takes, opened by names and paths."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

from pysim.diagnosis import Session, Settings, session
from pysim.io import in_model_units
from pysim.types import BadInput, Dataset, Effect, Model, Note, NoteCode
from pysim.types.kinds import names_of
from pysim.workflow.built_in import built_in
from pysim.workflow.data import BY_DATA, data_of, reference_of
from pysim.workflow.free import Bounds, begun_at, free_parameters, suggested
from pysim.workflow.model import ModelInside, inside, model_of, with_standard
from pysim.workflow.variants import Variants


@dataclass(frozen=True)
class SessionParts:
    """All that a session is made of.

    Args:
        model: the base model; where free parameters were set, their values are its start values.
        dataset: the measurements, in the model's units.
        inside: what the libraries know of the model.
        catalogue: effects to consider.
        variants: builds models with effects; None where the model's class is in no library.
        free: parameters that may be refitted.
        bounds: free parameter -> lower and upper bound in its unit, where they are not the model's.
        priors: free parameter -> mean and standard deviation of what is known of it beforehand, in its unit.
        overrides: parameters that keep the value they were set to, in their units.
        reference_hz: whose gain counts as 0 dB in responses; None for absolute gains.
        libraries: the user's own, beside the one that comes along.
        notes: what was assumed.
        rested: whether logs begin near rest, where they do not say it themselves; else as states were set.
        begins: free parameter -> where the search begins, if not at the model's value.
    """

    model: Model
    dataset: Dataset
    inside: ModelInside = field(repr=False)
    catalogue: tuple[Effect, ...]
    variants: Variants | None
    free: tuple[str, ...]
    bounds: Bounds
    priors: Bounds
    overrides: Mapping[str, float]
    reference_hz: float | None
    libraries: tuple[Path, ...]
    notes: tuple[Note, ...]
    rested: bool = True
    begins: Mapping[str, float] = field(default_factory=dict)

    @property
    def model_name(self) -> str:
        """The class, or the FMU's model where there is none."""
        return self.inside.class_name or self.model.name


def open_session(
    model: Model | Path | str,
    data: Dataset | Path | str,
    *,
    library: Path | str | Sequence[Path | str] = (),
    free: Sequence[str] = (),
    bounds: Bounds | None = None,
    values: Mapping[str, float] | None = None,
    effects: Sequence[str] | None = None,
    reference_hz: float | Literal["by data"] | None = BY_DATA,
    settings: Settings | None = None,
) -> Session:
    """Open a model and its measurements for a diagnosis.

    Args:
        model: a Modelica class, or an .fmu.
        data: folder with a dataset.toml.
        library: with the class or with effects, one or several; the one that comes along is always there.
        free: parameters to refit; all to which the model gives min, max and nominal and that are not set by default.
        bounds: parameter -> lower and upper bound in its unit, in place of the model's; frees it too.
        values: parameters that differ from the model's, in their units; a free one begins there.
        effects: consider only these; all that the model's slots take where None.
        reference_hz: whose gain counts as 0 dB in measured responses; None for absolute gains; by default 0.1 Hz where
            every test measured it, as in the thesis (Eq. 2.12).
        settings: numbers of the diagnosis; its own where None.
    Raises:
        BadInput: what cannot be read, does not compile, or does not go together.
    """
    libraries = [library] if isinstance(library, Path | str) else list(library)
    opened = model if isinstance(model, Model) else model_of(model, libraries)
    dataset = data if isinstance(data, Dataset) else data_of(data)
    parts = session_parts(
        opened, dataset, libraries=libraries, free=names_of(free, "free"), bounds=bounds or {}, values=values or {},
        effects=None if effects is None else names_of(effects, "effects"),
        reference_hz=reference_of(dataset.responses(), reference_hz),
    )  # fmt: skip
    return session_of(parts, settings)


def session_parts(
    model: Model,
    dataset: Dataset,
    *,
    libraries: Sequence[Path | str] = (),
    free: Sequence[str] = (),
    bounds: Bounds,
    priors: Bounds | None = None,
    values: Mapping[str, float],
    effects: Sequence[str] | None = None,
    reference_hz: float | None,
    refits: bool = True,
) -> SessionParts:
    """Bring together what `open_session` names, which says what the arguments are.

    Args:
        refits: whether parameters will be refitted, so that some must be free.
    Raises:
        BadInput: no free parameter, an effect that no slot takes, a class that does not compile, or an FMU that is not
            what its class would become.
    """
    notes: list[Note] = []
    dataset = in_model_units(_diagnosed(dataset, notes), model)
    known = inside(model, libraries)
    if not known.class_name:
        notes += _from_outside(model)
    catalogue = known.candidates if effects is None else named(effects, known)
    if known.class_name and not known.candidates:
        notes.append(Note(NoteCode.NO_EFFECT_FITS, {"model": known.class_name}))
    overrides, chosen = dict(values), free_parameters(model, free, bounds, values) if refits else ()
    if refits:
        model = begun_at(model, {name: overrides.pop(name) for name in chosen if name in overrides})
        held = [name for name in suggested(model) if name in overrides]
        notes += [Note(NoteCode.HELD_AS_SET, {"parameters": ", ".join(held)})] if held else []
    if refits and known.class_name:
        own = {name: value for name, value in built_in(model, libraries).items() if name not in (*chosen, *values)}
        notes += [Note(NoteCode.BUILT_WITH, {"parameters": ", ".join(own)})] if own else []
        overrides = own | overrides
    variants = Variants(known.class_name, tuple(with_standard(libraries))) if known.class_name else None
    places = tuple(Path(one) for one in libraries)
    return SessionParts(
        model, dataset, known, catalogue, variants, chosen, bounds, priors or {}, overrides, reference_hz, places,
        tuple(notes),
    )  # fmt: skip


def session_of(parts: SessionParts, settings: Settings | None = None) -> Session:
    """The session of these parts.

    Raises:
        BadInput: bounds of what is not free, or measurements that cannot carry a diagnosis.
    """
    return session(
        parts.model,
        parts.dataset,
        parts.catalogue,
        parts.variants.build if parts.variants else None,
        free=parts.free,
        bounds=parts.bounds,
        priors=parts.priors,
        overrides=parts.overrides,
        slots=parts.inside.slots,
        reference_hz=parts.reference_hz,
        rested=parts.rested,
        notes=parts.notes,
        settings=settings,
        build_law=parts.variants.probed if parts.variants else None,
        begins=parts.begins,
    )


def effects_of(names: Sequence[str], parts: SessionParts) -> tuple[Effect, ...]:
    """The effects of these names, in order.

    Raises:
        BadInput: one that is not in the catalogue or in no slot, one twice, or a model without its class.
    """
    if parts.variants is None:
        raise BadInput(
            f"nothing can be added to {parts.model_name}: its class is in none of the libraries; name its library "
            "(--library)"
        )
    for name in names:
        if list(names).count(name) > 1:
            raise BadInput(f"effect {name}: named twice; name each effect once")
    return named(names, parts.inside)


def named(names: Sequence[str], known: ModelInside) -> tuple[Effect, ...]:
    """The effects of these names that the model's slots take, in order.

    Raises:
        BadInput: one that is not in the catalogue, or that no slot takes.
    """
    catalogue, taken = [effect.name for effect in known.catalogue], {effect.name: effect for effect in known.candidates}
    for name in names:
        if name not in catalogue:
            near = difflib.get_close_matches(name, catalogue, n=1, cutoff=0.7)
            cure = f"did you mean {near[0]}?" if near else f"it has {', '.join(sorted(catalogue))}"
            raise BadInput(f"effect {name}: not in the catalogue; {cure}")
        if name not in taken:
            its = ", ".join(taken) or "none of them"
            raise BadInput(f"effect {name}: no slot of {known.class_name} takes it; its slots take {its}")
    return tuple(taken[name] for name in names)


def _diagnosed(dataset: Dataset, notes: list[Note]) -> Dataset:
    """What a diagnosis counts of the measurements: errors of sensors belong to logs over time and not to a table of
    responses, so that the two are not counted in one."""
    logs = dataset.logs()
    count = len(dataset.records) - len(logs)
    if not logs or not count:
        return dataset
    notes.append(Note(NoteCode.TABLES_LEFT_OUT, {"count": count}))
    return replace(dataset, records=tuple(logs))


def _from_outside(model: Model) -> list[Note]:
    """What cannot be looked at in a model without its Modelica class."""
    names = {c: [v.name for v in model.variables if v.causality == c] for c in ("input", "output")}
    seen: dict[str, float | str] = {f"{c}s": ", ".join(own) or "(none)" for c, own in names.items()}
    return [
        Note(NoteCode.CLASS_UNKNOWN, {"model": model.name}),
        Note(NoteCode.SEEN_FROM_OUTSIDE, {"model": model.label, "states": float(len(model.abilities.states)), **seen}),
    ]
