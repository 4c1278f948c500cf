"""Derivatives of a whole run by differences, for what an FMU or the equations between events do not tell."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.simulate._base import Solver
from pysim.simulate._foreign import Opened
from pysim.simulate._run import run_many
from pysim.simulate.rodas import Rodas
from pysim.simulate.sensitivity.probe import both_sides, size_of
from pysim.types import Experiment, Outcome, Record

Array = NDArray[np.float64]

# A run's own error, some 1e-9, is divided by twice the step and the step's square is what the difference leaves out.
DIFFERENCE_STEP = 1e-3  # of a parameter
_TIGHT = 1e-9


def tight(solver: Solver) -> Rodas:
    """A solver whose error does not show in a difference, with the other's limits."""
    control = solver.control()
    return Rodas(_TIGHT, _TIGHT, control.max_step, control.max_steps)


def run_differences(
    library: Opened,
    experiment: Experiment,
    solver: Solver,
    names: Sequence[str],
    stopped: Callable[[], bool],
) -> tuple[Array, Record | None]:
    """Central differences of a run's values (n_t, n_y, n_p), and the record of a run that failed if one did."""
    sides = [both_sides(library.model, experiment, name, DIFFERENCE_STEP) for name in names]
    return _differences(library, experiment, solver, sides, stopped)


def offset_differences(
    library: Opened, experiment: Experiment, solver: Solver, stopped: Callable[[], bool]
) -> tuple[Array, Record | None]:
    """The same by the offset of each state, (n_t, n_y, n_x)."""
    sides = []
    for i, name in enumerate(library.model.abilities.states):
        variable = library.model[name]
        step = np.zeros(experiment.offset.size)
        step[i] = DIFFERENCE_STEP * size_of(variable, variable.start or 0.0)
        ends = [replace(experiment, offset=experiment.offset + sign * step) for sign in (1.0, -1.0)]
        sides.append((ends[0], ends[1], float(2 * step[i])))
    return _differences(library, experiment, solver, sides, stopped)


def _differences(
    library: Opened,
    experiment: Experiment,
    solver: Solver,
    sides: Sequence[tuple[Experiment, Experiment, float]],
    stopped: Callable[[], bool],
) -> tuple[Array, Record | None]:
    """A column of slopes for each pair of experiments and their distance."""
    columns = np.full((experiment.times.size, len(experiment.record), len(sides)), np.nan)
    for p, (up, down, distance) in enumerate(sides):
        records = run_many(library, [up, down], tight(solver), stopped=stopped)
        for record in records:
            if record.outcome is not Outcome.DONE or len(record.values) < experiment.times.size:
                return columns, record
        columns[:, :, p] = (records[0].values - records[1].values) / distance
    return columns, None
