"""A model, its measurements and what may change: checked once, then never changed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from pysim.identify.frequency_response import THESIS_REFERENCE_HZ
from pysim.identify.greybox.command import Rest
from pysim.identify.greybox.measured import build_targets
from pysim.identify.greybox.parameters import Parameter, ParameterSpace, Tie, parameter_space
from pysim.identify.greybox.sine_log import SinePlan
from pysim.identify.greybox.target import Target
from pysim.types import BadInput, Dataset, Model
from pysim.types._frozen import FrozenMapping


@dataclass(frozen=True)
class Measurements:
    """One data set and how it is used.

    Args:
        dataset: its records of use "validate" are compared, never fitted.
        overrides: parameters that differ from the model's own in these tests, in the variables' units.
        outputs: columns to compare; every measured output where None.
        noise: column -> standard deviation in its unit, in place of what the data set says.
    """

    dataset: Dataset
    overrides: Mapping[str, float] = field(default_factory=dict)
    outputs: tuple[str, ...] | None = None
    noise: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("overrides", "noise"):
            object.__setattr__(self, name, FrozenMapping(getattr(self, name)))
        for name, value in self.noise.items():
            if not value > 0:
                raise BadInput(f"measurements: the noise of {name} is {value}; give a positive number")


@dataclass(frozen=True)
class Treatment:
    """How logs are compared.

    Args:
        rest: how the model comes to rest before a log over time; None starts it as the model says, at the log's start.
        sine: what of a stepped sine is compared.
        reference_hz: whose gain counts as 0 dB in responses (Eq. 2.12); None compares gains as they are.
        steady: "orbit" seeks each stepped sine's periodic steady state; "transient" runs the test as the bench did,
            for models that have none (sampling, play, chaos).
    Raises:
        BadInput: a word that is not known.
    """

    rest: Rest | None = field(default_factory=Rest)
    sine: SinePlan = field(default_factory=SinePlan)
    reference_hz: float | None = THESIS_REFERENCE_HZ
    steady: str = "orbit"

    def __post_init__(self) -> None:
        if self.steady not in ("orbit", "transient"):
            raise BadInput(f'treatment: steady = {self.steady!r} is not known; use "orbit" or "transient"')


@dataclass(frozen=True)
class Problem:
    """What a fit solves.

    Args:
        model: left unchanged.
        space: free, tied and fixed parameters.
        targets: measurements to fit and to hold out.
        notes: what was assumed on the way.
    """

    model: Model
    space: ParameterSpace
    targets: tuple[Target, ...]
    notes: tuple[str, ...] = ()


def problem(
    model: Model,
    data: Sequence[Measurements | Dataset],
    free: Sequence[Parameter | str],
    *,
    fixed: Mapping[str, float] | None = None,
    ties: Sequence[Tie] = (),
    treatment: Treatment | None = None,
) -> Problem:
    """Bring model, data sets and parameters together.

    Args:
        model: has a variable for each compared signal, in the same unit. An input named like a command with `_t`
            behind it is taken as its rate and gets its exact derivative.
        data: data sets; a plain Dataset means all its outputs and no overrides.
        free: parameters, or names where everything comes from the model.
        fixed: parameter -> value, in its unit.
        ties: parameters that follow free ones.
        treatment: how logs are compared.
    Raises:
        BadInput: what does not fit together, before anything runs.
    """
    treatment = treatment or Treatment()
    parameters = [Parameter(p) if isinstance(p, str) else p for p in free]
    space = parameter_space(model, parameters, fixed=fixed, ties=ties)
    targets: list[Target] = []
    notes: list[str] = []
    if not data:
        raise BadInput("fit: give at least one data set")
    for one in (d if isinstance(d, Measurements) else Measurements(d) for d in data):
        for name in one.overrides:
            if name in (*space.variables, *space.fixed, *(tie.name for tie in space.ties)):
                raise BadInput(f"fit: data set {one.dataset.name!r} overrides {name}, which is free, tied or fixed")
        found, said = build_targets(model, one, treatment, _started(model, space))
        targets += found
        notes += said
    _check_records(space, targets)
    if not any(target.use == "fit" for target in targets):
        raise BadInput('fit: no record is for fitting; give at least one use = "fit" in dataset.toml')
    return Problem(model, space, tuple(targets), tuple(dict.fromkeys(notes)))


def _started(model: Model, space: ParameterSpace) -> set[str | None]:
    """Records that a state is free to begin at another value in; None where it is in all."""
    states = model.abilities.states
    return {record for name, record in zip(space.variables, space.records, strict=True) if name in states}


def _check_records(space: ParameterSpace, targets: Sequence[Target]) -> None:
    known = {run.record for target in targets for run in target.runs}
    for record in space.records:
        if record is not None and record not in known:
            raise BadInput(f"fit: no compared record is called {record!r}; there are {', '.join(sorted(known))}")
