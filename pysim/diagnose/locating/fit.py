"""A table of values at a place of the model, estimated together with the model's parameters."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from pysim.diagnose.adapter import bad_point
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.laws import KNOTS, UNIT, Law
from pysim.diagnose.residuals import Ruler
from pysim.diagnose.screen import across, column_space
from pysim.diagnose.strengths import translated
from pysim.diagnose.subject import Extended
from pysim.identify.greybox import GaussNewton
from pysim.identify.greybox.optimiser import Bounds
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.residuals import Point
from pysim.types import Model

Array = NDArray[np.float64]

# Knots on either side of zero, as shares of the reach: what changes abruptly mostly does so there.
_SIDE = (0.005, 0.02, 0.07, 0.2, 0.4, 0.7, 1.0)
# Weight of level and slope, in shares of what the data give a value: too little to matter where they tell something.
_LEVEL = 1e-4
# Share of the samples that has to lie on either side of zero for it to matter.
_BOTH = 0.05
# What lies beyond these quantiles of a variable is too rare to say anything about.
RANGE = (0.002, 0.998)
# A variable whose largest value is so many times its least spans a decade.
_DECADE = 10.0
# Steps that are tried with one set of slopes, and the gain that ends a fit: a sum of squares, or a share of what
# exceeds noise.
_TRIALS, _SMALL, _ENOUGH = 6, 3.0, 1e-2


@dataclass(frozen=True)
class Solution:
    """The best table to first order around a point, parameters refitted.

    Args:
        values: (m,) of the table, in units of the columns.
        covariance: (m, m) of the values, noise as large as what is left.
        loss: minus the logarithm of the residuals' likelihood, the noise's variance at its best, values marginalised.
        left: sum of squares that is left.
        freedom: how many values the data determine.
        smoothing: logarithms (2,) of the weights of bends, and of level and slope.
        penalised: sum of squares with these.
    """

    values: Array
    covariance: Array = field(repr=False)
    loss: float
    left: float
    freedom: float
    smoothing: Array
    penalised: float


@dataclass(frozen=True)
class Table:
    """A law with its numbers.

    Args:
        law: which.
        model: compiled with it.
        knots: (KNOTS,) increasing.
        unit: what the values are multiplied by.
    """

    law: Law
    model: Model
    knots: Array
    unit: float = 1.0

    def space(self, current: Fitted, *, free: bool = True) -> ParameterSpace:
        """The current model's free numbers, the table's values behind; these alone where not `free`."""
        base, m = current.what.space, KNOTS
        fixed = {**base.fixed, **dict(zip(self.law.knots, self.knots.tolist(), strict=True)), UNIT: self.unit}
        if not free:
            fixed |= base.values(current.point.x)
            base = ParameterSpace.held({})
        names = self.law.values
        return ParameterSpace(
            keys=(*base.keys, *names),
            variables=(*base.variables, *names),
            records=(*base.records, *(None,) * m),
            units=(*base.units, *("1",) * m),
            start=np.append(base.start, np.zeros(m)),
            lower=np.append(base.lower, np.full(m, -math.inf)),
            upper=np.append(base.upper, np.full(m, math.inf)),
            scale=np.append(base.scale, np.ones(m)),
            log=np.append(base.log, np.zeros(m, dtype=bool)),
            ties=base.ties,
            fixed=fixed,
        )

    def what(self, current: Fitted, *, free: bool = True) -> Extended:
        """The model with the table, and its free numbers."""
        return replace(current.what, model=self.model, space=self.space(current, free=free))


def knots(z: Array) -> Array:
    """Places (KNOTS,) for a table over a variable's samples z (n,): dense around zero where z goes through it.

    Laws that change their sign do so at zero, and often abruptly: friction, dead bands, play. Elsewhere they follow the
    square root of the density of samples; over a variable that spans a decade or more they stand half way between that
    and equal ratios, since what falls with a pressure does so at its low end.
    """
    low, high = (float(end) for end in np.quantile(z, RANGE))
    reach = max(-low, high)
    if np.mean(z < -0.02 * reach) > _BOTH and np.mean(z > 0.02 * reach) > _BOTH:
        side = np.array(_SIDE)
        return np.concatenate([low * side[::-1], [0.0], high * side])
    if not high > low:
        low, high = low - 1e-9 - 1e-3 * abs(low), high + 1e-9 + 1e-3 * abs(high)
    edges = np.linspace(low, high, 401)
    count = np.histogram(z, edges)[0]
    weight = np.cumsum(np.sqrt(count / max(count.sum(), 1) + 1e-4))
    found = np.interp(np.linspace(0, weight[-1], KNOTS), np.append(0.0, weight), edges)
    return (found + np.geomspace(low, high, KNOTS)) / 2 if 0 < _DECADE * low < high else found


def bends(k: Array) -> Array:
    """Rows (m - 2, m): change of slope at each inner knot, over its neighbourhood; none for a straight line."""
    h = np.diff(k)
    rows, width = np.zeros((k.size - 2, k.size)), (h[1:] + h[:-1]) / 2
    inner = np.arange(k.size - 2)
    rows[inner, inner], rows[inner, inner + 2] = width / h[:-1], width / h[1:]
    rows[inner, inner + 1] = -width / h[:-1] - width / h[1:]
    return rows


def lines(k: Array) -> Array:
    """Orthonormal columns (m, 2): level and slope."""
    return np.asarray(np.linalg.qr(np.column_stack([np.ones(k.size), (k - k.mean()) / np.ptp(k)]))[0])


def solve(left_over: Array, columns: Array, k: Array) -> Solution:
    """Values c of a table that minimise |r + A c|^2, kept smooth as far as the data do not say otherwise.

    The weight of bends maximises the marginal likelihood, with the noise's variance at its best.

    Args:
        left_over: (n,) residuals r across what refitting takes.
        columns: (n, m) A, their change by each value, across the same.
        k: (m,) knots.
    Source: empirical Bayes for penalised splines, Wood 2011, Journal of the Royal Statistical Society B 73:3.
    """
    n, m = columns.shape
    gram, right, whole = columns.T @ columns, columns.T @ left_over, float(left_over @ left_over)
    rough, level = bends(k).T @ bends(k), lines(k) @ lines(k).T
    typical = float(np.trace(gram)) / m or 1.0

    lowest, highest, flat = math.log(1e-9 * typical), math.log(1e3 * typical), math.log(_LEVEL * typical)

    def parts(bending: float) -> tuple[Array, Array, float, float]:
        prior = math.exp(bending) * rough + math.exp(flat) * level
        c: Array = -np.asarray(np.linalg.solve(gram + prior, right), dtype=np.float64)
        penalised = max(whole + float(right @ c), 1e-12 * whole)
        volume = float(np.linalg.slogdet(gram + prior)[1]) - float(np.linalg.slogdet(prior)[1])
        return prior, c, penalised, 0.5 * n * math.log(penalised / n) + 0.5 * volume

    grid = np.linspace(lowest, highest, 25)
    near = int(np.argmin([parts(bending)[3] for bending in grid.tolist()]))
    ends = (grid[max(near - 1, 0)], grid[min(near + 1, grid.size - 1)])
    bending = float(optimize.minimize_scalar(lambda b: parts(b)[3], bounds=ends, method="bounded").x)
    prior, c, penalised, fun = parts(bending)
    inverse = np.linalg.inv(gram + prior)
    rest, freedom = float(np.sum((left_over + columns @ c) ** 2)), float(np.trace(inverse @ gram))
    scale = max(1.0, rest / max(n - freedom, 1.0))
    return Solution(c, inverse * scale, fun, rest, freedom, np.array([bending, flat]), penalised)


@dataclass(frozen=True)
class Estimate:
    """A table fitted together with the model's parameters.

    Args:
        table: its law, knots and unit.
        point: of the model with the table, slopes by the parameters first, then by the values.
        solution: the table's values at that point, and their doubt; of a table at zero those that first order promises.
    """

    table: Table
    point: Point = field(repr=False)
    solution: Solution = field(repr=False)


def first_order(ruler: Ruler, current: Fitted, span: Array, table: Table) -> Estimate | None:
    """The table at zero in the fitted model, from the slopes by its values alone; None where it cannot be simulated.

    Args:
        span: (n_r, rank) orthonormal, what refitting takes; of the ruler's own runs.
    Returns:
        the table with the unit that changes the residuals by about as much as they are, its slopes beside those of the
        model's parameters, and its solution in that unit.
    """
    point = bad_point(np.zeros(KNOTS), "")
    for power in (0, -3, -6, -9):  # nobody knows how much of it the model bears
        table = replace(table, unit=table.unit * 10.0**power)
        point = ruler.evaluation(table.what(current, free=False), np.zeros(KNOTS))
        if point.good and np.isfinite(point.jacobian).all():
            break
    else:
        return None
    here = current.point
    columns, left_over = across(span, point.jacobian), across(span, here.residual)
    size = float(np.linalg.norm(columns)) / math.sqrt(KNOTS)
    if not size > 0:
        return None
    factor = float(np.linalg.norm(left_over)) / size
    slopes = np.hstack([here.jacobian, point.jacobian * factor])
    start = Point(np.append(here.x, np.zeros(KNOTS)), here.cost, here.residual, slopes)
    return Estimate(replace(table, unit=factor * table.unit), start, solve(left_over, columns * factor, table.knots))


def advance(ruler: Ruler, current: Fitted, at: Estimate, *, rounds: int) -> Estimate:
    """Gauss-Newton steps of parameters and values together, smoothness as the data ask for it at each point.

    Args:
        rounds: sets of slopes at most, some steps with each; it ends where one gains next to nothing.
    """
    what = at.table.what(current)
    bounds = Bounds(*what.space.bounds())
    radius = 1.0
    for _ in range(rounds):
        penalty = _penalty(at.table, at.solution, at.point.x.size)
        here = _penalised(at.point, penalty)
        optimiser = GaussNewton(max_iterations=_TRIALS + 1, tolerance=0.05, radius=radius)
        state = optimiser.begin(here, bounds, True)
        while state.outcome is None and state.tried < _TRIALS:
            proposal = optimiser.propose(state, bounds)
            residual = ruler.at(what, proposal.x)
            best = state.best
            trial = bad_point(proposal.x, "") if residual is None else _trial(best, proposal.x, residual, penalty)
            state = optimiser.tell(state, proposal, trial, bounds)
        if state.best is here:
            return at
        radius = max(state.memory["radius"], 2 * float(np.linalg.norm(state.best.x - here.x)))
        moved = _estimate(ruler.evaluation(what, state.best.x), at.table, at.solution.smoothing)
        if moved is None:
            return at
        excess = moved.point.cost - moved.point.residual.size
        done = at.point.cost - moved.point.cost < max(_SMALL, _ENOUGH * excess)
        at = moved
        if done:
            return at
    return at


def begun(ruler: Ruler, current: Fitted, near: Fitted, table: Table, values: Array) -> Estimate | None:
    """A table that another law is a good guess of; None where it cannot be simulated there.

    Args:
        current: the model without a term.
        near: the model with that law, refitted.
        values: (m,) of that law at the knots.
    Returns:
        the table with these values beside the parameters of that model, as smooth as the data ask for around there.
    """
    space, told = current.what.space, near.what.space.values(near.point.x)
    names = translated(current.what, near.what, dict.fromkeys(space.keys, 0.0))
    x = np.append(space.to_search(np.array([told[name] for name in names])), values / table.unit)
    point = ruler.evaluation(table.what(current), x)
    if not point.good:
        return None
    span = column_space(point.jacobian[:, :-KNOTS])
    columns = across(span, point.jacobian[:, -KNOTS:])
    without = across(span, point.residual) - columns @ x[-KNOTS:]
    return _estimate(point, table, solve(without, columns, table.knots).smoothing)


def _estimate(point: Point, table: Table, before: Array) -> Estimate | None:
    """A point, with the weight of bends that suits the table there.

    Args:
        before: the weights so far.
    Source: the step of the weight is that of Wood and Fasiolo 2017, Biometrics 73:1071. It needs the values and the
        slopes at this point only: how the residuals were without the table, a straight line from here does not tell.
    """
    if not point.good:
        return None
    slopes, x = point.jacobian, point.x
    columns = across(column_space(slopes[:, :-KNOTS]), slopes[:, -KNOTS:])
    k, c, n, gram = table.knots, x[-KNOTS:], point.residual.size, columns.T @ columns
    rough = bends(k).T @ bends(k)
    prior = math.exp(before[0]) * rough + math.exp(before[1]) * lines(k) @ lines(k).T
    taken = math.exp(before[0]) * float(np.trace(np.linalg.solve(gram + prior, rough)))
    bent = max(float(c @ rough @ c), 1e-300)
    bending = math.log(max(KNOTS - 2 - taken, 1e-3) * max(1.0, point.cost / n) / bent)
    prior += (math.exp(bending) - math.exp(before[0])) * rough
    reached = point.cost + float(c @ prior @ c)
    inverse = np.linalg.inv(gram + prior)
    volume = -float(np.linalg.slogdet(inverse)[1]) - float(np.linalg.slogdet(prior)[1])
    loss = 0.5 * n * math.log(reached / n) + 0.5 * volume
    covariance: Array = np.asarray(inverse * max(1.0, point.cost / n), dtype=np.float64)
    freedom = float(np.trace(inverse @ gram))
    return Estimate(
        table, point, Solution(c, covariance, loss, point.cost, freedom, np.array([bending, before[1]]), reached)
    )


def _penalty(table: Table, solution: Solution, size: int) -> Array:
    """Rows (KNOTS, size) whose squares times x hold the table smooth."""
    root, k = np.exp(solution.smoothing / 2), table.knots
    own = np.vstack([root[0] * bends(k), root[1] * lines(k).T])
    return np.hstack([np.zeros((own.shape[0], size - KNOTS)), own])


def _penalised(point: Point, penalty: Array) -> Point:
    residual = np.append(point.residual, penalty @ point.x)
    return Point(point.x, 0.5 * float(residual @ residual), residual, np.vstack([point.jacobian, penalty]))


def _trial(here: Point, x: Array, residual: Array, penalty: Array) -> Point:
    """A point with the slopes of the last one, corrected along the step (Broyden 1965)."""
    full, step = np.append(residual, penalty @ x), x - here.x
    change = full - here.residual - here.jacobian @ step
    slopes = here.jacobian + np.outer(change, step) / max(float(step @ step), 1e-300)
    return Point(x, 0.5 * float(full @ full), full, slopes)
