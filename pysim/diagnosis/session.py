"""Input of a diagnosis: a model, its measurements, a catalogue of effects, and how to compile models with them."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from pysim.diagnosis.settings import Settings
from pysim.effects import Slot
from pysim.effects.learned import Term
from pysim.identify import THESIS_REFERENCE_HZ
from pysim.identify.adequacy import shortcomings
from pysim.identify.greybox import Measurements, Parameter, Problem, Rest, Threads, Treatment, problem
from pysim.identify.greybox.context import on_one_clock
from pysim.identify.greybox.parameters import ParameterSpace, identifiable
from pysim.identify.greybox.problem import beside
from pysim.types import BadInput, Dataset, Effect, Model, Note, NoteCode

# Effects -> the compiled model that has them, and effect name -> prefix of its parameters' names there.
BuildVariant = Callable[[Sequence[Effect]], tuple[Model, Mapping[str, str]]]

# Effects, and terms of learned laws -> the compiled model that has both.
BuildLaw = Callable[[Sequence[Effect], Sequence[Term]], Model]

TEST = "test"


@dataclass(frozen=True)
class Session:
    """The checked input that every step of a diagnosis takes.

    Args:
        model: the base model.
        data: logs of use "fit" and "validate" (used to choose), and the parameters that differ in these tests.
        unseen: held-out logs, of use "test", which nothing reads before the verdict; None if there are none.
        parameters: of the base model that may be refitted.
        catalogue: effects to consider.
        build: compiles models with effects; None if the model's Modelica source is not available.
        slots: replaceable components of the model, where effects and laws may be put.
        treatment: how logs are compared.
        notes: what was assumed.
        settings: the numbers of the search.
        workers: threads that simulate.
        build_law: compiles models with learned laws; None if the source is not available.
        numbers: places among all logs (`RecordFit.index`) of those in `data`, and of those in `unseen`.
        begins: free parameter -> where the search begins, if not at the base model's own value.
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
    numbers: tuple[Sequence[int], ...] = ()
    begins: Mapping[Any, float] = field(default_factory=dict)

    @property
    def dataset(self) -> Dataset:
        """The logs that are fitted or used to choose (validation data)."""
        return self.data.dataset

    @property
    def has_clock(self) -> bool:
        """Whether all fitted logs say when they began on a common clock, and not all began at the same time."""
        begins = {record.begin for record in self.dataset.logs() if record.use == "fit"}
        return len(begins) > 1 and None not in begins

    def unseen_beside(self, model: Model, space: ParameterSpace) -> Problem:
        """The held-out logs together with a model and its parameters."""
        assert self.unseen is not None
        records = tuple(replace(record, use="fit") for record in self.unseen.dataset.records)
        data = replace(self.unseen, dataset=replace(self.unseen.dataset, records=records))
        own = problem(self.model, [data], self.parameters, treatment=self.treatment)
        return replace(beside(own, model, self.parameters), space=space)

    @cached_property
    def problems(self) -> tuple[Problem, Problem]:
        """The base model and the measurements, with stepped sines as periodic orbits, and simulated over time.

        Long logs keep all their rows, since models are compared sample by sample.
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
    begins: Mapping[str, float] | None = None,
) -> Session:
    """Check model, measurements and catalogue, and make the session.

    Args:
        free: parameters that may be refitted; None takes all with min, max and nominal in the model.
        bounds: free parameter -> lower and upper bound in its unit, in place of the model's min and max.
        priors: free parameter -> mean and standard deviation of a Gaussian prior, in its unit.
        overrides: parameters of the model that differ in these tests.
        rested: whether the model settles before each log; else it begins at its start values.
        reference_hz: frequency whose gain counts as 0 dB in measured responses (Eq. 2.12); None takes absolute gains.
        initial: what is known of the plant's state at a log's first sample: "near rest", "rest" or "estimate".
        workers: number of simultaneous runs; all cores if None.
        build_law: compiles models with learned laws; None learns no law.
        begins: free parameter -> where the search begins, if not at the model's own value.
    Raises:
        BadInput: no free parameter, bounds of a parameter that is not free, a data set and a model that do not match,
            or measurements that do not suffice for a diagnosis.
    """
    names = identifiable(model) if free is None else tuple(free)
    bounds, priors = bounds or {}, priors or {}
    for name in bounds:
        if name not in names:
            raise BadInput(f"{name} has bounds but is not free; free are {', '.join(names) or 'none'}")
    ends = {name: bounds.get(name, (None, None)) for name in names}
    parameters = tuple(Parameter(n, None, low, high, prior=priors.get(n)) for n, (low, high) in ends.items())
    records = on_one_clock(dataset).records
    parts = [tuple(record for record in records if (record.use == TEST) == held) for held in (False, True)]
    read, unseen = (Measurements(replace(dataset, records=own), overrides=overrides or {}) for own in parts)
    given = Session(
        model,
        read,
        unseen if parts[1] else None,
        parameters,
        tuple(catalogue),
        build,
        tuple(slots),
        Treatment(rest=Rest() if rested else None, reference_hz=reference_hz, initial=initial),
        settings=settings or Settings(),
        workers=Threads(workers),
        build_law=build_law,
        numbers=tuple(
            [n for n, log in enumerate(dataset.logs()) if (log.use == TEST) == held] for held in (False, True)
        ),
        begins=begins or {},
    )
    checked = given.problems[0]
    more = [*(Note(NoteCode.OTHER, {"text": text}) for text in shortcomings(dataset, names, initial)), *checked.notes]
    found = zip(checked.space.keys, checked.space.lower, checked.space.upper, strict=True)
    open_ = [name for name, lower, upper in found if not (math.isfinite(lower) and math.isfinite(upper))]
    more += [Note(NoteCode.UNBOUNDED, {"parameters": ", ".join(open_)})] if open_ else []
    return replace(given, notes=(*notes, *more))
