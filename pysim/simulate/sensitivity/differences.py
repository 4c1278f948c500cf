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
from pysim.simulate.sensitivity.probe import both_sides, size_of, value_of
from pysim.types import Experiment, Outcome, Record

Array = NDArray[np.float64]

# A run's own error, some 1e-9, is divided by twice the step and the step's square is what the difference leaves out.
DIFFERENCE_STEP = 1e-3  # of a parameter
_TIGHT = 1e-9
_SMALL = 1e-4  # the same along all directions at once, some of which may start at a kink
_WRONG = 0.02  # share by which derivatives and that difference may not differ
_LEAST = 1e-2  # share of its step that a parameter of great effect is moved by at least, beside others of small effect
_GOLDEN = (5**0.5 - 1) / 2  # its multiples, whole parts taken off, lie far apart
_NOISY = 10.0  # errors of a step that a tight run may add up to


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


def agree(library: Opened, experiment: Experiment, solver: Solver, names: Sequence[str], slopes: Array) -> bool:
    """Whether a difference along all directions at once is what the derivatives of a run say.

    Each direction is moved by as much as makes its effect about as large as the others'; not by the same share, up and
    down in turn, as an answer that depends on the ratio of two parameters would stay.

    Args:
        names: (n_p) parameters.
        slopes: (n_t, n_y, n_x + n_p) derivatives, by the offset of the states first; n_x = 0 without an offset.
    """
    model, n_x = library.model, slopes.shape[2] - len(names)
    states = [model[name] for name in model.abilities.states[:n_x]]
    sizes = [size_of(one, one.start or 0.0) for one in states]
    sizes += [size_of(model[name], value_of(model, experiment, name)) for name in names]
    effects = np.sqrt(np.mean(slopes**2, axis=(0, 1))) * sizes
    least, places = np.min(effects[effects > 0], initial=np.inf), np.arange(effects.size)
    shares = np.clip(np.where(effects > 0, least / np.where(effects > 0, effects, 1.0), 1.0), _LEAST, 1.0)
    shares *= (1.0 - (places * _GOLDEN) % 1.0 / 2) * (-1.0) ** places
    moved = _SMALL * shares * sizes
    sides = [experiment, experiment]
    if n_x:
        sides = [replace(experiment, offset=experiment.offset + sign * moved[:n_x] / 2) for sign in (1.0, -1.0)]
    for p, name in enumerate(names, n_x):
        up, down, distance = both_sides(model, experiment, name, abs(_SMALL * float(shares[p])) / 2)
        ends = (up, down) if moved[p] > 0 else (down, up)
        sides = [one.override(**{name: end.overrides[name]}) for one, end in zip(sides, ends, strict=True)]
        moved[p] = np.copysign(distance, moved[p])
    first, second = run_many(library, sides, tight(solver))
    if not first.outcome is second.outcome is Outcome.DONE:
        return False
    parts = slopes * moved
    wrong = np.linalg.norm(first.values - second.values - parts.sum(axis=2), axis=0)
    noise = _TIGHT * np.linalg.norm(first.values, axis=0)
    return bool(np.all(wrong <= _WRONG * np.linalg.norm(parts, axis=(0, 2)) + _NOISY * noise))


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
