"""What is diagnosed: a model, its measurements, a catalogue, and a way to make models with effects."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from pysim.diagnose.adapter import Target
from pysim.diagnose.locating.laws import Term
from pysim.diagnosis.adequacy import shortcomings
from pysim.diagnosis.session import identifiable
from pysim.effects import Slot
from pysim.identify import THESIS_REFERENCE_HZ
from pysim.identify.greybox import Measurements, Parameter, Rest, Treatment, problem
from pysim.identify.greybox.parameters import ParameterSpace, parameter_space
from pysim.identify.greybox.residuals import Channel
from pysim.types import BadInput, Dataset, Effect, Model, Note
from pysim.types._frozen import FrozenMapping
from pysim.types.answer import NoiseFloor

# Effects -> the model that has them, and effect name -> the name ahead of its parameters there.
BuildVariant = Callable[[Sequence[Effect]], tuple[Model, Mapping[str, str]]]


@dataclass(frozen=True)
class Inside:
    """A model that can be looked into.

    Args:
        slots: its replaceable parts.
        probed: compiles it, effects that it has already and a term at one place.
    """

    slots: tuple[Slot, ...]
    probed: Callable[[Sequence[Effect], Term], Model]


@dataclass(frozen=True)
class Subject:
    """Checked once; every step takes it.

    Args:
        model: the base model.
        targets: measurements in the form in which models are compared with them.
        free: parameters of the base model that may be refitted.
        catalogue: effects to consider.
        build_variant: makes models with effects; None where the model's source is not at hand.
        notes: what was assumed.
        bounds: free parameter -> its bounds, where they are not the model's.
        dataset: the measurements as they were read.
        inside: to locate what is missing; None where only inputs and outputs can be looked at.
        floors: least level of each channel, for the comparison of records.
        specified: whether the data say how large the noise of everything is.
    """

    model: Model
    targets: tuple[Target, ...]
    free: tuple[str, ...]
    catalogue: tuple[Effect, ...]
    build_variant: BuildVariant | None
    notes: tuple[Note | str, ...] = ()
    dataset: Dataset | None = field(default=None, repr=False)
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    inside: Inside | None = field(default=None, repr=False)
    floors: Mapping[Channel, NoiseFloor] = field(default_factory=dict)
    specified: bool = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "bounds", FrozenMapping(self.bounds))

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """The free parameters with their bounds."""
        return tuple(Parameter(name, None, *self.bounds.get(name, (None, None))) for name in self.free)


@dataclass(frozen=True)
class Extended:
    """The base model with some effects, and its free numbers.

    Args:
        effects: in the order in which they were added; none for the base model.
        model: with all of them.
        places: effect name -> name ahead of its parameters.
        space: of the search: the base model's parameters, then the effects' own.
    """

    effects: tuple[Effect, ...]
    model: Model
    places: Mapping[str, str] = field(default_factory=dict)
    space: ParameterSpace = field(repr=False, kw_only=True)

    @property
    def own(self) -> tuple[str, ...]:
        """Full names of the effects' parameters, in the order of the space."""
        return tuple(f"{self.places[e.name]}.{p.name}" for e in self.effects for p in e.parameters)


def subject(
    model: Model,
    dataset: Dataset,
    catalogue: Sequence[Effect],
    build_variant: BuildVariant | None,
    *,
    free: Sequence[str] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    overrides: Mapping[str, float] | None = None,
    rest: Rest | None = None,
    reference_hz: float | None = THESIS_REFERENCE_HZ,
    inside: Inside | None = None,
    notes: Sequence[str] = (),
) -> Subject:
    """Bring everything together.

    Args:
        free: parameters that may be refitted; all that the model gives min, max and nominal where None. None of them
            for a model that is only compared as it is.
        bounds: free parameter -> lower and upper bound in its unit, in place of the model's min and max.
        overrides: parameters of the model that differ in these tests.
        rest: how the model comes to rest ahead of a log; as the thesis' bench did where None.
        reference_hz: whose gain counts as 0 dB in measured responses (Eq. 2.12); None takes gains as they are.
        inside: a way to look into the model, where there is one.
        notes: what a reader must know beside what is noted here.
    Raises:
        BadInput: no free parameter, bounds of what is not free, a data set and a model that do not fit together, or
            measurements that cannot carry a diagnosis.
    """
    names = identifiable(model) if free is None else tuple(free)
    for name in bounds or {}:
        if name not in names:
            raise BadInput(f"{name} has bounds but is not free; free are {', '.join(names) or 'none'}")
    given = Subject(model, (), names, tuple(catalogue), build_variant, dataset=dataset, bounds=bounds or {})
    given = replace(given, inside=inside)
    data = Measurements(dataset, overrides=overrides or {})
    treatment = Treatment(steady="transient", rest=rest or Rest(), reference_hz=reference_hz, initial="rest")
    checked = problem(model, [data], given.parameters, treatment=treatment)
    told: tuple[Note | str, ...] = (
        *notes,
        *shortcomings(dataset, names, at_rest=True),
        *_unbounded(checked.space),
        *checked.notes,
    )
    return replace(given, targets=checked.observations, floors=checked.floors, specified=checked.specified, notes=told)


def _unbounded(space: ParameterSpace) -> tuple[str, ...]:
    ends = zip(space.keys, space.lower, space.upper, strict=True)
    names = [name for name, lower, upper in ends if not (math.isfinite(lower) and math.isfinite(upper))]
    if not names:
        return ()
    return (
        f"{', '.join(names)}: refitted without bounds on both sides, since neither the model nor the call gives any",
    )


def extended(subject: Subject, effects: Sequence[Effect], *, model: Model | None = None) -> Extended:
    """The base model with effects; with none, the base model itself.

    Raises:
        BadInput: effects where no variant can be made.
    """
    if not effects:
        return Extended((), subject.model, space=parameter_space(subject.model, subject.parameters))
    if subject.build_variant is None:
        raise BadInput("no effect can be added: the model's Modelica class is not at hand; name it with its library")
    built, places = subject.build_variant(effects)
    own = [
        Parameter(f"{places[e.name]}.{p.name}", p.default, p.min, p.max, log=None if p.off is None else False)
        for e in effects
        for p in e.parameters
    ]
    space = parameter_space(built, [*subject.parameters, *own])
    return Extended(tuple(effects), built, dict(places), space=space)
