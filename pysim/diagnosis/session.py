"""What is diagnosed: a model, its measurements, a catalogue, and a way to make models with effects."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from pysim.diagnosis.adequacy import shortcomings
from pysim.diagnosis.learn.laws import Term
from pysim.diagnosis.settings import Settings
from pysim.effects import Slot
from pysim.identify import THESIS_REFERENCE_HZ
from pysim.identify.greybox import Measurements, Parameter, Problem, Rest, Threads, Treatment, problem
from pysim.identify.greybox.context import on_one_clock
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.problem import beside
from pysim.types import BadInput, Dataset, Effect, MeasuredRecord, Model, Note, NoteCode

# Effects -> the model that has them, and effect name -> the name ahead of its parameters there.
BuildVariant = Callable[[Sequence[Effect]], tuple[Model, Mapping[str, str]]]

# Effects and terms beside them -> the model that has both.
BuildLaw = Callable[[Sequence[Effect], Term], Model]

TEST = "test"


@dataclass(frozen=True)
class Session:
    """Checked once; every step takes it.

    Args:
        model: the base model.
        data: what is fitted and what may choose, with the parameters that differ in these tests.
        unseen: logs of use "test", which nothing looks at before the verdict; None where there are none.
        parameters: of the base model that may be refitted.
        catalogue: effects to consider.
        build: makes models with effects; None where the model's source is not at hand.
        slots: replaceable parts of the model.
        treatment: how logs are compared.
        notes: what was assumed.
        settings: the numbers of the search.
        workers: where runs go.
        build_law: makes models with laws that no catalogue has; None likewise.
    """

    model: Model
    data: Measurements
    unseen: Measurements | None
    parameters: tuple[Parameter, ...]
    catalogue: tuple[Effect, ...]
    build: BuildVariant | None
    slots: tuple[Slot, ...] = ()
    treatment: Treatment = field(default_factory=Treatment)
    notes: tuple[Note, ...] = ()
    settings: Settings = field(default_factory=Settings)
    workers: Threads = field(default_factory=Threads)
    build_law: BuildLaw | None = None

    @property
    def dataset(self) -> Dataset:
        """What is fitted and what may choose."""
        return self.data.dataset

    @property
    def has_clock(self) -> bool:
        """Whether every log that is fitted says when it began, and not all at once."""
        begins = {record.begin for record in self.dataset.logs() if record.use == "fit"}
        return len(begins) > 1 and None not in begins

    def unseen_beside(self, model: Model, space: ParameterSpace) -> Problem:
        """The logs that nothing has looked at, beside a model."""
        assert self.unseen is not None
        records = tuple(replace(record, use="fit") for record in self.unseen.dataset.records)
        data = replace(self.unseen, dataset=replace(self.unseen.dataset, records=records))
        own = problem(self.model, [data], self.parameters, treatment=self.treatment)
        return replace(beside(own, model, self.parameters), space=space)

    @cached_property
    def problems(self) -> tuple[Problem, Problem]:
        """The base model beside the measurements: stepped sines as periodic orbits, and run as the bench ran them.

        Long logs keep all their rows: models are compared sample by sample.
        """
        noise = replace(self.treatment.noise, whole=sys.maxsize)
        ways = (replace(self.treatment, steady=steady, noise=noise) for steady in ("orbit", "transient"))
        one, other = (problem(self.model, [self.data], self.parameters, treatment=way) for way in ways)
        return one, other


def session(
    model: Model,
    dataset: Dataset,
    catalogue: Sequence[Effect] = (),
    build: BuildVariant | None = None,
    *,
    free: Sequence[str] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    priors: Mapping[str, tuple[float, float]] | None = None,
    overrides: Mapping[str, float] | None = None,
    slots: Sequence[Slot] = (),
    rested: bool = True,
    reference_hz: float | None = THESIS_REFERENCE_HZ,
    initial: str = "near rest",
    notes: Sequence[Note] = (),
    settings: Settings | None = None,
    workers: int | None = None,
    build_law: BuildLaw | None = None,
) -> Session:
    """Bring everything together.

    Args:
        free: parameters that may be refitted; all that the model gives min, max and nominal where None.
        bounds: free parameter -> lower and upper bound in its unit, in place of the model's min and max.
        priors: free parameter -> mean and standard deviation of what is known of it beforehand, in its unit.
        overrides: parameters of the model that differ in these tests.
        rested: whether the model comes to rest ahead of a log; else it begins as its start values say.
        reference_hz: whose gain counts as 0 dB in measured responses (Eq. 2.12); None takes gains as they are.
        initial: what is known of the plant at a log's first sample: "near rest", "rest" or "estimate".
        workers: runs at a time; all cores where None.
        build_law: makes models with laws that no catalogue has; None learns none.
    Raises:
        BadInput: no free parameter, bounds of what is not free, a data set and a model that do not fit together, or
            measurements that cannot carry a diagnosis.
    """
    names = identifiable(model) if free is None else tuple(free)
    bounds, priors = bounds or {}, priors or {}
    for name in bounds:
        if name not in names:
            raise BadInput(f"{name} has bounds but is not free; free are {', '.join(names) or 'none'}")
    ends = {name: bounds.get(name, (None, None)) for name in names}
    parameters = tuple(Parameter(n, None, low, high, prior=priors.get(n)) for n, (low, high) in ends.items())
    read, unseen = _withheld(on_one_clock(dataset))
    given = Session(
        model,
        Measurements(read, overrides=overrides or {}),
        None if unseen is None else Measurements(unseen, overrides=overrides or {}),
        parameters,
        tuple(catalogue),
        build,
        tuple(slots),
        Treatment(rest=Rest() if rested else None, reference_hz=reference_hz, initial=initial),
        settings=settings or Settings(),
        workers=Threads(workers),
        build_law=build_law,
    )
    checked = given.problems[0]
    more = [*(Note(NoteCode.OTHER, {"text": text}) for text in shortcomings(dataset, names)), *checked.notes]
    found = zip(checked.space.keys, checked.space.lower, checked.space.upper, strict=True)
    open_ = [name for name, lower, upper in found if not (math.isfinite(lower) and math.isfinite(upper))]
    more += [Note(NoteCode.UNBOUNDED, {"parameters": ", ".join(open_)})] if open_ else []
    return replace(given, notes=(*notes, *more))


def _withheld(dataset: Dataset) -> tuple[Dataset, Dataset | None]:
    """What may be read, and what nothing looks at before the verdict; that as records to compare, never to fit."""
    unseen: list[MeasuredRecord] = [record for record in dataset.records if record.use == TEST]
    if not unseen:
        return dataset, None
    read = tuple(record for record in dataset.records if record.use != TEST)
    return replace(dataset, records=read), replace(dataset, records=tuple(unseen))


def identifiable(model: Model) -> tuple[str, ...]:
    """Parameters that the model gives min, max and nominal: what it says may differ from one unit to the next.

    Raises:
        BadInput: there is none.
    """
    found = tuple(
        v.name
        for v in model.variables
        if v.causality == "parameter"
        and v.type in ("Real", "Float64")
        and v.min is not None
        and v.max is not None
        and v.nominal is not None
        and v.start is not None
    )
    if not found:
        raise BadInput(f"{model.label} gives no parameter min, max and nominal; name those to refit, and their bounds")
    return found
