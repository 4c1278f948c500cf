"""One run with its derivatives, in an instance: what native code is given, and what it leaves."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._base import Solver
from pysim.simulate._job import Job
from pysim.simulate._library import Instance
from pysim.simulate._run import explain, make_record, prepare
from pysim.simulate._state import RUNNING
from pysim.simulate._variation import ASKED, FIXED
from pysim.simulate._variation_loop import EVENT, integrate_variations
from pysim.types import Experiment, Model, Outcome, Record

Array = NDArray[np.float64]

_BUDGET = 2_000  # steps between two looks at the world outside: some 50 ms
_VECTOR = 4  # doubles; rows are filled up to a multiple
_REALS = frozenset({"Real", "Float64"})


@dataclass(frozen=True)
class Directions:
    """By what a run is differentiated.

    Args:
        parameters: names whose columns the FMU's directional derivatives give.
        starts: those of them that no equation holds: start values of states.
        states: whether the states at the start are directions too; their columns come first.
        outputs: whether the derivatives of what is recorded are wanted.
    """

    parameters: tuple[str, ...] = ()
    starts: frozenset[str] = frozenset()
    states: bool = False
    outputs: bool = True


@dataclass(frozen=True)
class Varied:
    """A run and its derivatives.

    Args:
        record: the run; one that met an event ends there.
        event: whether it did.
        rows: (n_t, n_y, n_s + n_p) derivatives of the recorded values.
        states: (n_x,) at the end.
        by: (n_x, n_s + n_p) their derivatives.
        low, high: (n_x,) least and largest value of each state, at the steps.
        nominal: (n_x,) nominal values of the states.
        rates: (n_x,) derivatives of the states at the end, and
        forcing: (n_p, n_x) those by the parameters, where the run did not leave its start.
        terms: (n_x,) size of what adds up to the derivatives there.
        rewindable: whether the instance can go back to the start without being initialised again.
    """

    record: Record
    event: bool
    rows: Array
    states: Array
    by: Array
    low: Array
    high: Array
    nominal: Array
    rates: Array
    forcing: Array
    terms: Array
    rewindable: bool

    @property
    def done(self) -> bool:
        """Whether the run came to its end, with all that is derived from it."""
        return self.record.outcome is Outcome.DONE and not self.event


def vary(
    instance: Instance,
    experiment: Experiment,
    solver: Solver,
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
        solver: an `Esdirk`.
        directions: of the derivatives.
        start: (n_x,) states to start from; those of the FMU where None.
        start_by: (n_x, n_p) how the start states depend on the parameters; not at all where None.
        rewind: start again in continuous-time mode.
        stopped: asked now and then.
    """
    job = prepare(instance, experiment, solver)
    arrays = _arrays(instance.model, experiment, directions, start, start_by)
    job.put("variation", {**arrays, "rewind": int(rewind)})
    code = RUNNING
    while code == RUNNING and not stopped():
        code = integrate_variations(job.record, _BUDGET)
    instance.status = int(job.number("run", "status"))
    return _result(instance, experiment, job, code, directions)


def _result(instance: Instance, experiment: Experiment, job: Job, code: int, directions: Directions) -> Varied:
    event = code == EVENT
    outcome = Outcome.DONE if event or code == RUNNING else list(Outcome)[code]
    message = "" if outcome is Outcome.DONE else explain(job, outcome) + instance.mailbox.text()
    count = job.number("rows", "next")
    values = job.array("rows", "values")[:count]
    states, rates = job.array("work", "x").copy(), job.array("work", "dx").copy()
    used = job.array("work", "x").size * directions.states + len(directions.parameters)
    return Varied(
        record=make_record(instance.model, experiment, values, outcome, message, job.statistics()),
        event=event,
        rows=job.array("variation", "rows")[:count, :, :used],
        states=states,
        by=job.array("variation", "s")[:, :used].copy(),
        low=job.array("variation", "low"),
        high=job.array("variation", "high"),
        nominal=np.abs(job.array("work", "nominal")),
        rates=rates,
        forcing=job.array("variation", "forcing"),
        terms=np.abs(rates) + np.abs(job.array("work", "jacobian").T) @ np.abs(states),
        rewindable=job.number("run", "events") == 0 and job.number("run", "next_event") >= experiment.times[-1],
    )


def _arrays(
    model: Model, experiment: Experiment, directions: Directions, start: Array | None, start_by: Array | None
) -> dict[str, Any]:
    """What VARIATION points to."""
    n, parameters = len(model.abilities.states), directions.parameters
    by_start = n if directions.states else 0
    width = -(-(by_start + len(parameters)) // _VECTOR) * _VECTOR
    first = np.zeros((n, width))
    first[:, :by_start] = np.eye(n, by_start)
    if start_by is not None:
        first[:, by_start : by_start + len(parameters)] = start_by
    stages = 6
    return {
        "columns": width,
        "by_start": by_start,
        "parameters": len(parameters),
        **({} if start is None else {"start": np.array(start, dtype=np.float64)}),
        "start_by": first,
        "seeds": np.array([model[name].reference for name in parameters], dtype=np.uint32),
        "seeded": np.array([name not in directions.starts for name in parameters], dtype=np.int64),
        "s": np.zeros((n, width)),
        "k": np.zeros((stages, n, width)),
        "right": np.zeros((n, width)),
        "inside": np.zeros((n, width)),
        "forcing": np.zeros((len(parameters), n)),
        "rows": np.zeros((experiment.times.size, len(experiment.record), width)),
        "low": np.full(n, np.inf),
        "high": np.full(n, -np.inf),
        **_recorded(model, experiment.record, directions, by_start, width),
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
