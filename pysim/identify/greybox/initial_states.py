"""Estimates and intervals of the unknown initial states of logs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.effective_size import inflation
from pysim.identify.greybox.identifiability import EXACT
from pysim.identify.greybox.observation import Observation
from pysim.identify.greybox.problem import Problem
from pysim.identify.greybox.residuals import Carried, Channel, rows_of
from pysim.identify.greybox.runs import Simulation, simulate_runs
from pysim.types import Estimate
from pysim.types.fit import HALF_95

Array = NDArray[np.float64]


def initial_states(
    problem: Problem,
    x: Array,
    covariances: tuple[Array, Array],
    levels: Mapping[Channel, float],
    offsets: Mapping[int, Array | None],
    simulation: Simulation,
) -> tuple[Estimate, ...]:
    """States at the first sample of every log with unknown initial states, logs that were not fitted included.

    Their variance has two parts: that for known parameters, times lambda of the coloured residual, and that which the
    parameters' uncertainty adds. States that the log does not determine get an infinite standard deviation.

    Args:
        x: (n,) search coordinates of the fit.
        covariances: (n, n) of x; and the same with half widths of intervals in place of standard deviations.
        levels: channel -> standard deviation that its residuals are divided by.
        offsets: id of a run -> its initial states less those at rest.
    """
    found: list[Estimate] = []
    for one in problem.observations:
        unknown = one.domain == "time" and len(one.runs) == 1 and one.runs[0].begins_anywhere
        offset = offsets.get(id(one.runs[0])) if unknown else None
        if offset is not None:
            found += _of_log(problem, one, x, covariances, levels, offset, simulation)
    return tuple(found)


def _of_log(
    problem: Problem,
    one: Observation,
    x: Array,
    covariances: tuple[Array, Array],
    levels: Mapping[Channel, float],
    offset: Array,
    simulation: Simulation,
) -> list[Estimate]:
    model, space, (run,), n = problem.model, problem.space, one.runs, x.size
    residuals = replace(problem.residuals(simulation=simulation), observations=(one,))
    answer = residuals.simulate(model, space, x, Carried((offset,)))
    names = [model.abilities.states[i] for i in run.free]
    look = replace(run, experiment=replace(run.experiment, record=tuple(names), times=np.array([run.begins])))
    first = simulate_runs(model, space, [look], x, [offset], simulation)
    if answer.failure is not None or first.failure is not None:
        return []
    table = rows_of(one, answer.simulated)
    own = np.array([levels[one.dataset, name] for name in one.channels])
    rows = table.rows / own[table.channel][:, None]
    by_x, by_state = rows[:, 1 : 1 + n], rows[:, 1 + n :]
    size = np.linalg.norm(by_state, axis=0)
    size[size == 0] = 1.0
    u, sigma, vt = np.linalg.svd(by_state / size, full_matrices=False)
    held = sigma > EXACT * sigma[0]
    inverse = (vt[held].T / sigma[held]) @ u[:, held].T / size[:, None]
    begins = first.simulated[0]
    follow = begins.slopes[0] - begins.by_initial[0] @ inverse @ by_x
    back = begins.by_initial[0] @ inverse  # (n_s, n_r) derivative of the states by the residual's rows
    colour = np.ones(len(names))
    if table.reduction is None:
        left = _by_channel(rows[:, 0], table.channel)
        colour = np.array([inflation([left], [_by_channel(own, table.channel)]) for own in back])
    own_variance = colour * np.sum(back**2, axis=1)
    followed = [np.sum((follow @ covariance) * follow, axis=1) for covariance in covariances]
    unseen = np.sum(vt[~held] ** 2, axis=0) > EXACT  # states with a share in an undetermined direction
    std = np.where(unseen, math.inf, np.sqrt(own_variance + followed[0]))
    half = np.where(unseen, math.inf, np.sqrt(HALF_95**2 * own_variance + followed[1]))
    value, rest = begins.values[0], begins.values[0] - begins.by_initial[0] @ offset
    return [
        Estimate(f"{name}@{run.record}", model[name].unit, v, at_rest, -math.inf, math.inf, sd,
                 (v - reach, v + reach))
        for name, v, at_rest, sd, reach in zip(names, *(a.tolist() for a in (value, rest, std, half)), strict=True)
    ]  # fmt: skip


def _by_channel(rows: Array, channel: NDArray[np.intp]) -> Array:
    """Rows (n_r,) in a column for each channel (n_t, n_y); zeros follow where one has fewer, which have no part."""
    columns = [rows[channel == j] for j in range(int(channel.max()) + 1)]
    found = np.zeros((max(column.size for column in columns), len(columns)))
    for j, column in enumerate(columns):
        found[: column.size, j] = column
    return found
