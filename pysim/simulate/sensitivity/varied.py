"""One run with its derivatives, in an instance: what the kernel is given, and what it leaves."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._job import Job
from pysim.simulate._library import Instance
from pysim.simulate._run import OUTCOMES, explain, go_on, make_record, prepare
from pysim.simulate.esdirk import Esdirk
from pysim.simulate.kernel.layout import ASKED, COLUMNS, EVENT, FIXED
from pysim.simulate.kernel.library import kernel
from pysim.types import Experiment, Model, Outcome, Record

Array = NDArray[np.float64]

_STAGES = Esdirk().method().b.size
_REALS = frozenset({"Real", "Float64"})


@dataclass(frozen=True)
class Directions:
    """By what a run is differentiated.

    Args:
        parameters: names whose columns the FMU's directional derivatives give.
        starts: those of them that no equation holds: start values of states.
        states: whether the states at the start are directions too; their columns come first.
        outputs: whether the derivatives of what is recorded are wanted.
        offset: whether the offset of the states is a direction, in place of the states at the start.
    """

    parameters: tuple[str, ...] = ()
    starts: frozenset[str] = frozenset()
    states: bool = False
    outputs: bool = True
    offset: bool = False

    @property
    def by_state(self) -> bool:
        """Whether there is a column per state, ahead of those of the parameters."""
        return self.states or self.offset


class Varied(NamedTuple):
    """A run and its derivatives."""

    outcome: Outcome  # DONE also for a run that ended at an event
    event: bool  # whether it did
    message: str
    values: Array  # (n_t, n_y) what was recorded
    rows: Array  # (n_t, n_y, n_s + n_p) derivatives of that
    states: Array  # (n_x,) at the end
    by: Array  # (n_x, n_s + n_p) their derivatives
    low: Array  # (n_x,) least and
    high: Array  # (n_x,) largest value of each state at the steps
    nominal: Array  # (n_x,) of the states
    statistics: dict[str, int]  # counts of the run
    rewindable: bool  # whether the instance can go back to the start without being initialised again
    job: Job  # as the run left it, until the instance's next run

    @property
    def done(self) -> bool:
        """Whether the run came to its end, with all that is derived from it."""
        return self.outcome is Outcome.DONE and not self.event

    def record(self, model: Model, experiment: Experiment) -> Record:
        """The run as others know it."""
        return make_record(model, experiment, self.values, self.outcome, self.message, self.statistics)


def vary(
    instance: Instance,
    experiment: Experiment,
    solver: Esdirk,
    directions: Directions,
    *,
    start: Array | None = None,
    start_by: Array | None = None,
    rewind: bool = False,
    stopped: Callable[[], bool] = lambda: False,
) -> Varied:
    """Run an experiment with its derivatives, in an instance that stands behind initialisation.

    Args:
        instance: in event mode; with `rewind` where the run before left it, of which no event may have been part.
        experiment: checked.
        solver: tolerances and limits.
        directions: of the derivatives.
        start: (n_x,) states to start from; those of the FMU where None.
        start_by: (n_x, n_p) how the start states depend on the parameters; not at all where None.
        rewind: start again in continuous-time mode, the run before being of the same experiment and directions.
        stopped: asked now and then.
    """
    job = instance.job if rewind else None
    if job is None:
        job = prepare(instance, experiment, solver)
        kind = (directions, experiment.record)
        if kind not in job.spare:
            job.spare[kind] = _arrays(instance.model, experiment.record, directions)
        job.keep("variation", job.spare[kind])
    else:
        job.restart(experiment.start, float(experiment.times[-1]))
        job.change("rows", {"next": 0, "values": np.zeros((experiment.times.size, len(experiment.record)))})
    job.change("variation", {"tolerance": solver.derivative_tol})
    job.change("variation", _of_this_run(job, experiment, start, start_by, rewind))
    code = go_on(kernel().integrate_variations, job, stopped)
    instance.status = int(job.number("run", "status"))
    return _result(instance, experiment, job, code, directions)


def _result(instance: Instance, experiment: Experiment, job: Job, code: int, directions: Directions) -> Varied:
    event, run = code == EVENT, job.record["run"][0]
    outcome = Outcome.DONE if event else OUTCOMES[code]
    count, states = job.number("rows", "next"), job.array("work", "x").copy()
    used = states.size * directions.by_state + len(directions.parameters)
    return Varied(
        outcome,
        event,
        "" if outcome is Outcome.DONE else explain(job, outcome) + instance.mailbox.text(),
        job.array("rows", "values")[:count],
        job.array("variation", "rows")[:count, :, :used],
        states,
        job.array("variation", "s")[:, :used].copy(),
        job.array("variation", "low"),
        job.array("variation", "high"),
        job.array("work", "nominal").copy(),
        job.statistics(),
        run["events"] == 0 and run["next_event"] >= experiment.times[-1],
        job,
    )


def _of_this_run(
    job: Job,
    experiment: Experiment,
    directions: Directions,
    start: Array | None,
    start_by: Array | None,
    rewind: bool,
) -> dict[str, Any]:
    """The fields of `Variation` that are a run's own."""
    n, width, by_start = (
        job.array("work", "x").size,
        job.number("variation", "columns"),
        job.number("variation", "by_start"),
    )
    first = np.eye(n, width) if directions.states else np.zeros((n, width))
    if start_by is not None:
        first[:, by_start : by_start + start_by.shape[1]] = start_by
    return {
        "rewind": int(rewind),
        "start": 0 if start is None else np.array(start, dtype=np.float64),
        "start_by": first,
        "rows": np.zeros((experiment.times.size, len(experiment.record), width)),
        "sizes": np.zeros(width),
        "low": np.full(n, np.inf),
        "high": np.full(n, -np.inf),
    }


def _arrays(model: Model, record: tuple[str, ...], directions: Directions) -> dict[str, Any]:
    """What else `Variation` points to; the same for every run of a kind."""
    n, parameters = len(model.abilities.states), directions.parameters
    by_start = n if directions.states else 0
    width = -(-(by_start + len(parameters)) // COLUMNS) * COLUMNS
    return {
        "columns": width,
        "by_start": by_start,
        "parameters": len(parameters),
        "seeds": np.array([model[name].reference for name in parameters], dtype=np.uint32),
        "seeded": np.array([name not in directions.starts for name in parameters], dtype=np.int64),
        "s": np.zeros((n, width)),
        "k": np.zeros((_STAGES, n, width)),
        "right": np.zeros((n, width)),
        "inside": np.zeros((n, width)),
        "error": np.zeros((n, width)),
        "weights": np.zeros(_STAGES),
        "forcing": np.zeros((len(parameters), n)),
        **_recorded(model, record, directions, by_start, width),
    }


def _recorded(model: Model, names: Sequence[str], directions: Directions, by_start: int, width: int) -> dict[str, Any]:
    """How each recorded variable follows from states and parameters."""
    states = {model[name].reference: i for i, name in enumerate(model.abilities.states)}
    kinds, fixed = [], np.zeros((len(names), width))
    for row, name in zip(fixed, names, strict=True):
        variable = model[name]
        real = variable.type in _REALS and variable.variability != "discrete"
        if not directions.outputs or not real or variable.causality in ("parameter", "input", "independent"):
            kinds.append(FIXED)
        else:
            kinds.append(states.get(variable.reference, ASKED))
        if name in directions.parameters and variable.causality in ("parameter", "input"):
            row[by_start + directions.parameters.index(name)] = 1.0
    asked = [model[name].reference for name, kind in zip(names, kinds, strict=True) if kind == ASKED]
    return {
        "kinds": np.array(kinds, dtype=np.int64),
        "fixed": fixed,
        "unknowns": len(asked),
        "unknown_references": np.array(asked, dtype=np.uint32),
        "state_references": np.array(list(states), dtype=np.uint32),
        "gradient": np.zeros(len(asked)),
    }
