"""Periodic steady states: what the kernel finds by shooting, and what to do where it finds none."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, NamedTuple, overload

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._foreign import Opened
from pysim.simulate._found import Found
from pysim.simulate._pass import run_tasks
from pysim.simulate._pool import Stopped
from pysim.simulate._request import Kind, Request
from pysim.simulate._run import make_record
from pysim.simulate._tasks import Tasks
from pysim.simulate._variation import Directions
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.kernel.layout import ORBIT, VARIED
from pysim.simulate.sensitivity.differences import DIFFERENCE_STEP, tight
from pysim.simulate.sensitivity.probe import Offer, both_sides
from pysim.simulate.sensitivity.sensitivities import Ask, run_in
from pysim.simulate.sensitivity.transient import Settled, after, settle_down
from pysim.types import Experiment, Outcome, Record

Array = NDArray[np.float64]

_FORGOTTEN = 10.0  # mismatches: two periods of an orbit may end that far apart,
_MOST_FORGOTTEN = 1e-2  # amplitudes: but no further
_JUMPY = 30.0  # tolerated errors of a step: so far the end of a period with kinks jumps as the steps fall otherwise
_TIGHT = 1e-8  # tolerance of orbits between which a difference is taken
_TIGHT_MISMATCH = 1e-5


@dataclass(frozen=True)
class Orbit:
    """A periodic steady state and how parameters move it.

    Args:
        record: (points) one period from phase zero, without its end.
        parameters: (n_p) names.
        by_parameter: (points, n_y, n_p) derivative of each recorded value, its unit over the parameter's unit.
        state: (n_x,) at phase zero: a guess for an orbit nearby. Empty where the orbit was simulated the long way.
        state_by_parameter: (n_x, n_p) its derivative. Along a direction in which nothing holds the state, as the
            level of a closed volume, the state keeps the guess's value and the derivative has no part.
        iterations: periods that were integrated with derivatives; 0 for the long way.
        exact: False if a column came from differences.
        outcome: DONE, or why there is no orbit.
        message: what was tried, where shooting failed.
    """

    record: Record
    parameters: tuple[str, ...]
    by_parameter: Array = field(repr=False)
    state: Array = field(repr=False)
    state_by_parameter: Array = field(repr=False)
    iterations: int = 0
    exact: bool = True
    outcome: Outcome = Outcome.DONE
    message: str = ""

    def __post_init__(self) -> None:
        for name in ("by_parameter", "state", "state_by_parameter"):
            array = np.array(getattr(self, name), dtype=np.float64)
            array.setflags(write=False)
            object.__setattr__(self, name, array)


class OrbitStack(NamedTuple):
    """Orbits of as many points, one above the other.

    Args:
        numbers: places (n) among all.
        values: (n, points, n_y); by_parameter: (n, points, n_y, n_p).
        state: (n, n_x); state_by_parameter: (n, n_x, n_p).
    """

    numbers: list[int]
    values: Array
    by_parameter: Array
    state: Array
    state_by_parameter: Array


class Orbits(Sequence[Orbit]):
    """Orbits in the order of their tests. Hundreds of them are made where they are asked for, and stacked at once.

    Args:
        make: the orbit of a number, where it is none of the next two.
        others: orbits by number.
        found: what the kernel found, by number, where that is all there is to an orbit.
    """

    def __init__(
        self, count: int, make: Callable[[int], Orbit], others: Mapping[int, Orbit], found: Mapping[int, Found]
    ) -> None:
        self._count, self._make, self._orbits, self._found = count, make, dict(others), found

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, number: int) -> Orbit: ...
    @overload
    def __getitem__(self, number: slice) -> tuple[Orbit, ...]: ...
    def __getitem__(self, number: int | slice) -> Orbit | tuple[Orbit, ...]:
        if isinstance(number, slice):
            return tuple(self[i] for i in range(*number.indices(self._count)))
        number = range(self._count)[number]
        if number not in self._orbits:
            self._orbits[number] = self._make(number)
        return self._orbits[number]

    def stacks(self) -> Iterator[OrbitStack]:
        """All that were found by shooting alone, as arrays."""
        groups: dict[int, tuple[Tasks, list[int]]] = {}
        for number, one in self._found.items():
            groups.setdefault(id(one.tasks), (one.tasks, []))[1].append(number)
        for tasks, numbers in groups.values():
            places = [self._found[number].number for number in numbers]
            values, slopes = tasks.stack("values", places), tasks.stack("slopes", places)
            if values is not None and slopes is not None:
                states = tasks.arrays("state", places), tasks.arrays("state_by", places)
                yield OrbitStack(numbers, values, slopes[..., tasks.by_offset :], *states)


@dataclass(frozen=True)
class Plan:
    """What all tests of a call have in common; `long_way`: whether they take it where shooting fails."""

    library: Opened
    solver: Esdirk
    parameters: tuple[str, ...]
    offer: Offer
    mismatch: float
    long_way: bool = True

    @cached_property
    def directions(self) -> Directions:
        """Columns that come from the FMU, if it gives those of the outputs."""
        return self.offer.directions(states=True) if self.offer.outputs else Directions(states=True, outputs=False)

    @cached_property
    def missing(self) -> tuple[str, ...]:
        """Parameters whose columns have to be differences."""
        given = self.offer.parameters if self.offer.outputs else ()
        return tuple(name for name in self.parameters if name not in given)

    @property
    def kind(self) -> Kind:
        """What the kernel is asked for."""
        return Kind(ORBIT, self.solver, self.directions, self.mismatch)


def remembers(plan: Plan, experiment: Experiment, guess: Array | None) -> bool:
    """Whether the model remembers more than its states, so that a period cannot be started from them.

    If not, a second period of an orbit ends where the first one did, but for what the choice of the steps may move. As
    long as a library is open, a model that was found to remember no more is not asked again.
    """
    if plan.library.known.get("remembers") is False:
        return False
    (found,) = run_tasks(plan.library, plan.kind, [Request(experiment, guess)])
    if not found.done:
        return False
    twice = replace(experiment, times=np.append(experiment.times, experiment.times[-1] * 2))
    requests = [Request(run, found.array("state")) for run in (experiment, twice)]
    once, again = run_tasks(plan.library, Kind(VARIED, plan.solver), requests)
    if once.failed_to_start or again.failed_to_start:
        return False
    if not (once.done and again.done):
        return True
    low, high = once.array("low"), once.array("high")
    size = np.maximum(np.abs(high), np.abs(low))
    jumps = 3 * _JUMPY * (plan.solver.rtol * size + plan.solver.atol * once.array("nominal"))
    allowed = min(_FORGOTTEN * plan.mismatch, _MOST_FORGOTTEN) * 0.5 * (high - low)
    apart = np.abs(again.array("state") - once.array("state"))
    found_out = plan.library.known["remembers"] = bool(np.any(apart > np.maximum(allowed, jumps)))
    return found_out


def find_orbits(plan: Plan, tests: Sequence[tuple[Experiment, Array | None]], **watched: Any) -> list[Found]:
    """What the kernel finds for tests, each with a guess or none; where a guess leads nowhere, the model's own start.

    Args:
        watched: workers, progress and stopped, as of `run_tasks`.
    """
    found = run_tasks(plan.library, plan.kind, [Request(*test) for test in tests], **watched)
    again = [i for i, one in enumerate(found) if not one.done and not one.event and tests[i][1] is not None]
    if again:
        requests = [Request(tests[i][0]) for i in again]
        watched.pop("progress", None)
        for i, one in zip(again, run_tasks(plan.library, plan.kind, requests, **watched), strict=True):
            found[i] = one
    return found


def is_settled(plan: Plan, found: Found) -> bool:
    """Whether what the kernel found is all there is to an orbit."""
    exact = plan.offer.outputs or found.number_of("correction") <= _TIGHT_MISMATCH
    return found.done and exact and not plan.missing


def orbit_of(plan: Plan, experiment: Experiment, found: Found | None, stopped: Stopped) -> Orbit:
    """The orbit of one test; a failure is an outcome.

    Args:
        experiment: one period from time 0, its end included.
        found: by the kernel; None for a model that remembers more than its states.
    """
    if found is None:
        return _the_long_way(plan, experiment, "the model remembers more than its states", stopped)
    if found.failed_to_start:
        return _failed(plan, experiment, Outcome.MODEL_ERROR, found.message)
    if not found.done:
        return _the_long_way(plan, experiment, found.trouble, stopped)
    if not plan.offer.outputs and found.number_of("correction") > _TIGHT_MISMATCH < plan.mismatch:
        return _again(plan, experiment, found, stopped)
    values = found.values
    record = make_record(plan.library.model, experiment, values, Outcome.DONE, "", found.statistics())
    columns, by = found.slopes, found.array("state_by")
    if plan.missing:
        places = [plan.parameters.index(name) for name in plan.directions.parameters]
        columns, by = _spread(columns, places, len(plan.parameters)), _spread(by, places, len(plan.parameters))
    iterations = found.number_of("iterations")
    orbit = Orbit(record, plan.parameters, columns, found.array("state"), by, iterations)
    return _with_differences(plan, experiment, orbit, stopped) if plan.missing else orbit


def _find_orbit(plan: Plan, experiment: Experiment, guess: Array | None, stopped: Stopped) -> Orbit:
    (found,) = find_orbits(plan, [(experiment, guess)], stopped=stopped)
    return orbit_of(plan, experiment, found, stopped)


def _spread(columns: Array, places: list[int], count: int) -> Array:
    """The columns (..., n) at their places among that many, the others not a number."""
    spread = np.full((*columns.shape[:-1], count), np.nan)
    spread[..., places] = columns
    return spread


def _again(plan: Plan, experiment: Experiment, found: Found, stopped: Stopped) -> Orbit:
    """Without derivatives of the outputs a correction needs one more integration."""
    orbit = _find_orbit(replace(plan, mismatch=_TIGHT_MISMATCH), experiment, found.array("state"), stopped)
    more = found.number_of("iterations") if orbit.iterations else 0
    return replace(orbit, iterations=orbit.iterations + more)


def _with_differences(plan: Plan, experiment: Experiment, orbit: Orbit, stopped: Stopped) -> Orbit:
    """Fill the columns that the FMU does not give by central differences of tighter orbits."""
    control = plan.solver.control()
    solver = Esdirk(_TIGHT, _TIGHT, control.max_step, control.max_steps)
    bare = replace(
        plan, solver=solver, parameters=(), offer=replace(plan.offer, parameters=()), mismatch=_TIGHT_MISMATCH
    )
    columns, by = orbit.by_parameter.copy(), orbit.state_by_parameter.copy()
    for name in plan.missing:
        up, down, distance = both_sides(plan.library.model, experiment, name, DIFFERENCE_STEP)
        ends = [_find_orbit(bare, side, orbit.state, stopped) for side in (up, down)]
        for end in ends:
            if end.outcome is not Outcome.DONE or not end.state.size:
                message = f"with {name} moved a little: {end.message}"
                return replace(orbit, outcome=end.outcome, message=message, exact=False)
        place = plan.parameters.index(name)
        columns[:, :, place] = (ends[0].record.values - ends[1].record.values) / distance
        by[:, place] = (ends[0].state - ends[1].state) / distance
    message = f"columns by differences: {', '.join(plan.missing)}"
    return replace(orbit, by_parameter=columns, state_by_parameter=by, exact=False, message=message)


def _the_long_way(plan: Plan, experiment: Experiment, why: str, stopped: Stopped) -> Orbit:
    """Simulate until it repeats, and as long again: what depends on a parameter takes longer to settle."""
    if not plan.long_way:
        return _failed(plan, experiment, Outcome.NOT_PERIODIC, why)
    solver = tight(plan.solver)
    settled = settle_down(plan.library, experiment, solver, stopped)
    if not settled.trouble:
        settled = after(plan.library, experiment, solver, 2 * settled.periods, stopped)
    if settled.trouble:
        return _not_settled(plan, experiment, settled, why)
    last = replace(experiment, times=experiment.times[:-1] + (settled.periods - 1) * experiment.times[-1])
    (run,) = run_in(plan.library, Ask((last,), plan.parameters, False, plan.solver, 1), None)
    if run.record.outcome is not Outcome.DONE:
        return _failed(plan, experiment, run.record.outcome, f"{why}; {run.message or run.record.message}")
    nothing = np.full((0, len(plan.parameters)), np.nan)
    message = f"{why}; simulated for {settled.periods} periods instead"
    exact = run.exact or not plan.parameters
    return Orbit(settled.record, plan.parameters, run.by_parameter, np.zeros(0), nothing, 0, exact, message=message)


def _not_settled(plan: Plan, experiment: Experiment, settled: Settled, why: str) -> Orbit:
    outcome = settled.record.outcome
    outcome = Outcome.NOT_PERIODIC if outcome is Outcome.DONE else outcome
    return _failed(plan, experiment, outcome, f"{why}; {settled.trouble}")


def _failed(plan: Plan, experiment: Experiment, outcome: Outcome, message: str) -> Orbit:
    n, p = len(plan.library.model.abilities.states), len(plan.parameters)
    columns = np.zeros((0, len(experiment.record), p))
    values = np.zeros((0, len(experiment.record)))
    record = make_record(plan.library.model, experiment, values, outcome, message, {})
    return Orbit(
        record, plan.parameters, columns, np.full(n, np.nan), np.full((n, p), np.nan), 0, False, outcome, message
    )
