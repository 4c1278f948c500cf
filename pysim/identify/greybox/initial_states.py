"""Where logs began whose initial states were estimated from themselves, and how well that is known."""

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
    """The states at the first sample of every log of which nothing else says where it began, those not fitted too.

    They were eliminated from the fit, so their doubt has two parts: that of the log, were the parameters known, and
    that of the parameters, which they follow. The colour of the residual widens the first.

    Args:
        x: (n,) of the fit in the search's numbers.
        covariances: (n, n) of these, and with the ends of their intervals in place of standard deviations.
        levels: what residuals of a channel are counted in.
        offsets: id of a run -> its free states less those at rest.
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
    u, sigma, vt = np.linalg.svd(by_state, full_matrices=False)
    held = sigma > EXACT * sigma[0]
    inverse = (vt[held].T / sigma[held]) @ u[:, held].T
    begins = first.simulated[0]
    follow = begins.slopes[0] - begins.by_initial[0] @ inverse @ by_x
    back = begins.by_initial[0] @ inverse  # (n_s, n_r) how an error of each row moves the states
    colour = np.ones(len(names))
    if table.reduction is None:
        shape = (-1, len(one.channels))
        colour = np.array([inflation([rows[:, 0].reshape(shape)], [own.reshape(shape)]) for own in back])
    own_variance = colour * np.sum(back**2, axis=1)
    followed = [np.sum((follow @ covariance) * follow, axis=1) for covariance in covariances]
    unseen = np.sum(vt[~held] ** 2, axis=0) > EXACT  # a share of it moves nothing that was measured
    std = np.where(unseen, math.inf, np.sqrt(own_variance + followed[0]))
    half = np.where(unseen, math.inf, np.sqrt(HALF_95**2 * own_variance + followed[1]))
    value, rest = begins.values[0], begins.values[0] - begins.by_initial[0] @ offset
    return [
        Estimate(f"{name}@{run.record}", model[name].unit, v, at_rest, -math.inf, math.inf, sd,
                 (v - reach, v + reach))
        for name, v, at_rest, sd, reach in zip(names, *(a.tolist() for a in (value, rest, std, half)), strict=True)
    ]  # fmt: skip
