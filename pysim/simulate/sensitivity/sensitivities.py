"""What parameters do to a run: every recorded value with its derivatives, exact where the FMU offers its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._check import check_arguments, check_list
from pysim.simulate._foreign import Opened, open_model
from pysim.simulate._found import Found
from pysim.simulate._pass import Progress, later, run_tasks
from pysim.simulate._pool import Stopped, side_by_side, worker_count
from pysim.simulate._request import Kind, Request, Take
from pysim.simulate._run import record_of, run
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.kernel.layout import VARIED
from pysim.simulate.sensitivity.differences import offset_differences, run_differences
from pysim.simulate.sensitivity.probe import (
    Offer,
    check_names,
    check_parameters,
    counts,
    probe_each,
)
from pysim.simulate.sensitivity.starts import start_slopes
from pysim.types import BadInput, Experiment, Model, Outcome, Record, SimulationError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Sensitivities:
    """A run and how its parameters move it.

    Args:
        record: the run; one that stopped early ends there, and its outcome says why.
        parameters: (n_p) names.
        by_parameter: (n_t, n_y, n_p) derivative of each recorded value, its unit over the parameter's unit.
        by_offset: (n_t, n_y, n_x) the same by the offset of the states; n_x = 0 where it was not asked for.
        exact: False if a column, or the way a start value moves, came from differences.
        message: why, where it did; and which derivative is not finite, if one is.
    """

    record: Record
    parameters: tuple[str, ...]
    by_parameter: Array = field(repr=False)
    exact: bool = True
    message: str = ""
    by_offset: Array = field(default_factory=lambda: np.zeros((0, 0, 0)), repr=False)

    def __post_init__(self) -> None:
        for name in ("by_parameter", "by_offset"):
            array = np.array(getattr(self, name), dtype=np.float64)
            array.setflags(write=False)
            object.__setattr__(self, name, array)


def sensitivities(
    model: Model,
    experiment: Experiment,
    parameters: Sequence[str],
    *,
    solver: Esdirk = Esdirk(),  # noqa: B008
    check: bool = True,
) -> Sensitivities:
    """Run one experiment and differentiate what was recorded by parameters.

    The derivatives are those of the steps themselves (internal numerical differentiation): exact for the computed
    solution but for the choice of the steps, so their error falls with the tolerance as the solution's does. A column
    for which the FMU offers no directional derivative comes from central differences of tight runs, and so do all
    columns of a run with state or time events. An FMU built here says what depends on numbers that events leave behind;
    where slopes and recorded variables do not, a run goes on through events that change neither a state nor a slope.

    Args:
        model: a model-exchange FMU; left unchanged.
        experiment: what is done to it.
        parameters: (n_p) names of what overrides may set: parameters, start values, inputs that are not driven.
        solver: tolerances and limits.
        check: False returns a failed run instead of raising.
    Raises:
        BadInput: as `simulate`, or a parameter that is not real, has no value, or is named twice.
        SimulationError: stopped early; `.record` holds the part that was reached.
    """
    found = sensitivities_many(model, [experiment], parameters, solver=solver, workers=1)[0]
    if check and found.record.outcome is not Outcome.DONE:
        raise SimulationError(f"{model.name}: {found.record.message}", found.record)
    return found


def sensitivities_many(
    model: Model,
    experiments: Sequence[Experiment],
    parameters: Sequence[str],
    *,
    offset: bool = False,
    solver: Esdirk = Esdirk(),  # noqa: B008
    workers: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[Sensitivities, ...]:
    """Run experiments side by side with their derivatives; the results do not depend on how many threads do it.

    Args:
        model, parameters, solver: as for `sensitivities`.
        experiments: (n) with the same things recorded or not.
        offset: differentiate by the offsets of the states too, which every experiment then has.
        workers: threads; all cores where None.
        progress: called with (runs done, runs in all) from the calling thread; what it raises stops everything.
    Returns:
        (n) in the order of the experiments; a failed run is a result whose record says why.
    Raises:
        BadInput: as `sensitivities`, before the first run starts.
    """
    check_arguments("sensitivities_many", model, solver, Esdirk)
    ask = check_sensitivities(model, experiments, parameters, offset, solver, workers)
    if not experiments:
        return ()
    with open_model(model) as library:
        return run_in(library, ask, progress)


@dataclass(frozen=True)
class Ask:
    """Checked arguments of `sensitivities_many`."""

    experiments: tuple[Experiment, ...]
    names: tuple[str, ...]
    offset: bool
    solver: Esdirk
    workers: int
    takes: tuple[Take | None, ...] = ()


def check_sensitivities(
    model: Model,
    experiments: Sequence[Experiment],
    parameters: Sequence[str],
    offset: bool,
    solver: Esdirk,
    workers: int | None,
) -> Ask:
    """Check what `sensitivities_many` is given.

    Raises:
        BadInput: as there.
    """
    check_list("sensitivities_many", "experiments", experiments, Experiment)
    count = worker_count("sensitivities_many", model, workers)
    names = check_names("sensitivities_many", parameters)
    check_parameters("sensitivities_many", model, experiments, names)
    if offset and any(e.offset.size != len(model.abilities.states) for e in experiments):
        raise BadInput("sensitivities_many: a derivative by the offset needs experiments with one; give them zeros")
    return Ask(tuple(experiments), names, offset, solver, count)


def run_in(library: Opened, ask: Ask, progress: Progress | None) -> tuple[Sensitivities, ...]:
    """As `sensitivities_many`, with a library that is open already."""
    experiments, names, solver, count = ask.experiments, ask.names, ask.solver, ask.workers
    offers = probe_each(library, experiments, solver, names)
    whole = {record for record, offer in offers.items() if len(offer.parameters) == len(names)}
    starts = start_slopes(library, experiments, solver, offers, count)
    found: dict[int, Found] = {}
    ready: list[int] = []  # those that need nothing more
    for record, offer in offers.items():
        numbers = [i for i, e in enumerate(experiments) if e.record == record and starts[i] is not None]
        takes = ask.takes if ask.takes and record in whole else (None,) * len(experiments)
        requests = [Request(experiments[i], start_by=starts[i], take=takes[i]) for i in numbers]
        watch = later(progress, len(ready), len(experiments)) if record in whole else None
        held = library.model.abilities.held  # numbers that events leave behind
        through = held is not None and not counts(library.model, record, held)
        kind = Kind(VARIED, solver, offer.directions(offset=ask.offset, through=through))
        found |= zip(numbers, run_tasks(library, kind, requests, workers=count, progress=watch), strict=True)
        ready += [i for i in numbers if record in whole and found[i].done]
    tasks = [
        partial(_one, library, ask, e, offers[e.record], starts[i], found.get(i)) for i, e in enumerate(experiments)
    ]
    left = sorted(set(range(len(experiments))) - set(ready))
    others = side_by_side([tasks[i] for i in left], count, later(progress, len(ready), len(experiments)))
    results = dict(zip(left, others, strict=True))
    return tuple(results[i] if i in results else task(lambda: False) for i, task in enumerate(tasks))


def _one(
    library: Opened,
    ask: Ask,
    experiment: Experiment,
    offer: Offer,
    start_by: Array | None,
    varied: Found | None,
    stopped: Stopped,
) -> Sensitivities:
    """What the kernel found, with the columns that it could not give."""
    names = ask.names
    if varied is None or varied.event or varied.failed_to_start:
        return _by_differences(library, ask, experiment, varied is not None and varied.event, stopped)
    columns = np.full((len(varied.values), len(experiment.record), len(names)), np.nan)
    columns[:, :, [names.index(name) for name in offer.parameters]] = varied.slopes
    missing = [name for name in names if name not in offer.parameters]
    record = record_of(library.model, experiment, varied)
    if not missing or record.outcome is not Outcome.DONE:
        moved = start_by is not None and bool(start_by.any())
        messages = ["start values were differentiated by differences"] if moved else []
        messages += _not_finite(record, names, columns)
        return Sensitivities(record, names, columns, not moved, "; ".join(messages), varied.by_offset)
    differences, failed = run_differences(library, experiment, ask.solver, missing, stopped)
    for column, name in enumerate(missing):
        columns[:, :, names.index(name)] = differences[:, :, column]
    message = f"the FMU gives no derivative by {', '.join(missing)}"
    return Sensitivities(_with_trouble(record, failed), names, columns, False, message, varied.by_offset)


def _not_finite(record: Record, names: tuple[str, ...], columns: Array) -> list[str]:
    """The first derivative (n_t, n_y, n_p) that does not exist, in words; as of a square root at zero."""
    wrong = np.argwhere(~np.isfinite(columns))
    if not len(wrong):
        return []
    row, y, p = wrong[0]
    return [f"the derivative of {record.names[y]} by {names[p]} is {columns[row, y, p]:g} at {record.time[row]:g} s"]


def _by_differences(library: Opened, ask: Ask, experiment: Experiment, event: bool, stopped: Stopped) -> Sensitivities:
    names, solver = ask.names, ask.solver
    record = run(library, experiment, solver, stopped)
    shape = (len(record.values), len(experiment.record), len(names))
    if record.outcome is not Outcome.DONE:
        return Sensitivities(record, names, np.full(shape, np.nan), False, record.message)
    columns, failed = run_differences(library, experiment, solver, names, stopped)
    by_offset = np.zeros((*shape[:2], 0))
    if ask.offset and failed is None:
        by_offset, failed = offset_differences(library, experiment, solver, stopped)
    why = "the run has events" if event else "the FMU gives no derivatives"
    message = f"{why}: all columns are differences"
    return Sensitivities(_with_trouble(record, failed), names, columns, False, message, by_offset)


def _with_trouble(record: Record, failed: Record | None) -> Record:
    """The record, or the reason why a run beside it failed."""
    if failed is None:
        return record
    message = f"with a parameter moved a little: {failed.message}"
    return replace(record, outcome=failed.outcome, message=message)
