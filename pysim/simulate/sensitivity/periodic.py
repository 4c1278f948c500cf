"""Periodic steady states: one period and a Newton correction instead of seconds of settling."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from numbers import Integral, Real

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._check import check_arguments, check_list
from pysim.simulate._foreign import Opened, open_model
from pysim.simulate._found import Found
from pysim.simulate._pass import later
from pysim.simulate._pool import Stopped, side_by_side, worker_count
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.sensitivity.orbit import Orbit, Orbits, Plan, find_orbits, is_settled, orbit_of, remembers
from pysim.simulate.sensitivity.probe import check_names, check_parameters, probe_each
from pysim.types import BadInput, Experiment, Model, Signal
from pysim.types._frozen import changed

Array = NDArray[np.float64]

_LOOKS = 16  # times at which a signal is compared with itself a period later
_APART = 1e-6  # of its range: what may lie between the two


@dataclass(frozen=True)
class Periodic:
    """A test whose inputs repeat for ever, of which the steady state is wanted.

    Args:
        period: s.
        points: equidistant samples of the period, the first one at phase zero.
        record: names of the variables to record.
        inputs: input name -> Signal that repeats with the period from time 0 on, in the input's unit.
        overrides, rates: as of an Experiment.
    Raises:
        BadInput: a period or a number of points that is not positive, an input that does not repeat with the period,
            and as an Experiment.
    """

    period: float
    points: int
    record: tuple[str, ...]
    inputs: Mapping[str, Signal] = field(default_factory=dict)
    overrides: Mapping[str, float] = field(default_factory=dict)
    rates: Mapping[str, str] = field(default_factory=dict)
    _experiment: Experiment = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        if not (isinstance(self.period, Real) and self.period > 0 and math.isfinite(self.period)):
            raise BadInput(f"periodic: the period is {self.period!r} s; give a positive number")
        if not (isinstance(self.points, Integral) and self.points >= 1):
            raise BadInput(f"periodic: points is {self.points!r}; give a whole number of at least 1")
        times = np.linspace(0.0, self.period, self.points + 1)
        experiment = Experiment(times, self.record, self.inputs, self.overrides, 0.0, self.rates)
        for name, signal in experiment.inputs.items():
            if not _repeats(signal, float(self.period)):
                raise BadInput(
                    f"periodic: input {name} does not repeat every {self.period} s; "
                    "give the period of its signal, or a multiple of that"
                )
        object.__setattr__(self, "_experiment", experiment)
        for name in ("record", "inputs", "overrides", "rates"):
            object.__setattr__(self, name, getattr(experiment, name))

    def experiment(self) -> Experiment:
        """One period from time 0, its end included."""
        return self._experiment

    def override(self, **values: float) -> Periodic:
        """The same test with more parameters set; what stays is not checked again."""
        experiment = self._experiment.override(**values)
        return changed(self, _experiment=experiment, overrides=experiment.overrides)


def _repeats(signal: Signal, period: float) -> bool:
    """Whether the first two periods look alike. One look may fall on a jump, where rounding decides the side."""
    if _is_steady(signal):
        turns = signal.sines[0, :, 2] * period / (2 * math.pi)
        if np.all(np.abs(turns - np.round(turns)) <= _APART / math.pi):
            return True
    phases = (0.5 + np.arange(_LOOKS) * (math.sqrt(5) - 1) / 2) % 1.0  # evenly spread, on no fraction of the period
    first, second = np.split(signal.value(np.concatenate([phases, phases + 1.0]) * period), 2)
    allowed = _APART * max(np.ptp(first), np.ptp(second)) + 1e-12 * np.max(np.abs(first))
    return int(np.sum(np.abs(second - first) > allowed)) <= 1


def _is_steady(signal: Signal) -> bool:
    """Whether it is a mean and sines of constant frequency, for all times from 0 on."""
    whole = signal.starts.size == 1 and signal.starts[0] <= 0
    return bool(whole and not signal.cubics[0, 1:].any() and not signal.sines[0, :, 3].any())


def periodic_many(
    model: Model,
    tests: Sequence[Periodic],
    parameters: Sequence[str] = (),
    *,
    guesses: Sequence[Array | None] = (),
    solver: Esdirk = Esdirk(),  # noqa: B008
    mismatch: float = 1e-3,
    workers: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Orbit, ...]:
    """Find the periodic steady states of tests, and how parameters move them.

    Newton on the states at phase zero, with the derivative of a period by its start (the monodromy matrix M): from the
    mismatch after one period follows the correction (I - M)^-1 (x(T) - x(0)), and from the derivatives by parameters
    those of the orbit. What is left of the correction is applied to the samples to first order. Where shooting fails,
    because an event happens or because the model remembers more than its states, the model is simulated until what is
    recorded repeats itself, with the derivatives that such a run has.

    Args:
        model: a model-exchange FMU.
        tests: (n) what to find.
        parameters: (n_p) names, as for `sensitivities`; what only moves a start value has no part in an orbit.
        guesses: (n) states (n_x,) at phase zero to start from, as those of an orbit nearby; None, or what a failed
            orbit holds, starts from the model's own start. All None where empty.
        solver: tolerances and limits.
        mismatch: largest correction, in amplitudes of each state, that is left to first order. The samples are then
            wrong by about its square, their derivatives by about itself.
        workers, progress: as for `simulate_many`.
    Returns:
        (n) in the order of the tests; what failed is an Orbit whose outcome says why.
    Raises:
        BadInput: as `sensitivities`, before anything runs.
    """
    check_arguments("periodic_many", model, solver, Esdirk)
    ask = check_periodic(model, tests, parameters, guesses, solver, mismatch, workers)
    if not tests:
        return ()
    with open_model(model) as library:
        return tuple(find_in(library, ask, progress))


@dataclass(frozen=True)
class Ask:
    """Checked arguments of `periodic_many`, and whether a test takes the long way where shooting fails."""

    experiments: tuple[Experiment, ...]
    names: tuple[str, ...]
    guesses: tuple[Array | None, ...]
    solver: Esdirk
    mismatch: float
    workers: int
    long_way: bool = True


def check_periodic(
    model: Model,
    tests: Sequence[Periodic],
    parameters: Sequence[str],
    guesses: Sequence[Array | None],
    solver: Esdirk,
    mismatch: float,
    workers: int | None,
) -> Ask:
    """Check what `periodic_many` is given.

    Raises:
        BadInput: as there.
    """
    check_list("periodic_many", "tests", tests, Periodic)
    count = worker_count("periodic_many", model, workers)
    names = check_names("periodic_many", parameters)
    starts = _check_guesses(model, tests, guesses)
    if not mismatch > 0:
        raise BadInput(f"periodic_many: mismatch must be positive, got {mismatch}")
    experiments = tuple(test.experiment() for test in tests)
    check_parameters("periodic_many", model, experiments, names)
    return Ask(experiments, names, tuple(starts), solver, mismatch, count)


def find_in(library: Opened, ask: Ask, progress: Callable[[int, int], None] | None) -> Orbits:
    """As `periodic_many`, with a library that is open already."""
    experiments, starts, count = ask.experiments, ask.guesses, ask.workers
    offers = probe_each(library, experiments, ask.solver, ask.names)
    common = ask.mismatch, ask.long_way
    plans = {record: Plan(library, ask.solver, ask.names, offer, *common) for record, offer in offers.items()}
    quick = min(range(len(experiments)), key=lambda i: float(experiments[i].times[-1]))
    memory = remembers(plans[experiments[quick].record], experiments[quick], starts[quick])
    found: dict[int, Found] = {}
    whole: dict[int, Found] = {}  # where that is all there is to an orbit
    for record, plan in plans.items():
        numbers = [i for i, experiment in enumerate(experiments) if experiment.record == record and not memory]
        pairs, watch = [(experiments[i], starts[i]) for i in numbers], later(progress, len(whole), len(experiments))
        watch = None if plan.missing or not plan.offer.outputs else watch
        found |= zip(numbers, find_orbits(plan, pairs, workers=count, progress=watch), strict=True)
        whole |= {i: found[i] for i in numbers if is_settled(plan, found[i])}

    def make(number: int, stopped: Stopped = lambda: False) -> Orbit:
        experiment = experiments[number]
        return orbit_of(plans[experiment.record], experiment, found.get(number), stopped)

    left = [i for i in range(len(experiments)) if i not in whole]
    watch = later(progress, len(whole), len(experiments))
    others = side_by_side([partial(make, number) for number in left], count, watch) if left else ()
    return Orbits(len(experiments), make, dict(zip(left, others, strict=True)), whole)


def _check_guesses(model: Model, tests: Sequence[Periodic], guesses: Sequence[Array | None]) -> list[Array | None]:
    if not len(guesses):
        return [None] * len(tests)
    if len(guesses) != len(tests):
        raise BadInput(f"periodic_many: {len(tests)} tests need as many guesses or none, got {len(guesses)}")
    n, starts = len(model.abilities.states), []
    for guess in guesses:
        try:
            start = np.zeros(0) if guess is None else np.array(guess, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise BadInput(f"periodic_many: a guess is the model's {n} states, got {guess!r}") from error
        if start.size and start.shape != (n,):
            raise BadInput(f"periodic_many: a guess is the model's {n} states, got an array of shape {start.shape}")
        starts.append(start if start.size and math.isfinite(start.sum()) else None)
    return starts
