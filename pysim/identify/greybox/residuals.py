"""Residuals over their levels, with their Jacobian, of a model at one point: the input of searches and intervals.

The objective is the negative log-likelihood of independent normal errors. The level (standard deviation) of each
channel is estimated from its residual: Q = sum n/2 log(v) with v = RSS/n, plus priors. If v is below the square of the
channel's noise floor s, the term is n/2 (log(s^2) + v/s^2 - 1). Nuisances are sensor errors.
Source: Box and Draper 1965, Biometrika 52:355; for errors that are not independent Liang and Zeger 1986, Biometrika
73:13; for models that are wrong White 1982, Econometrica 50:1."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox.identifiability import EXACT
from pysim.identify.greybox.nuisance import Nuisance
from pysim.identify.greybox.observation import Measure, Observation, Run, Simulated
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.identify.greybox.reduction import Reduction
from pysim.identify.greybox.runs import Answer, Failure, Simulation, simulate_runs
from pysim.identify.greybox.settings import NoiseSettings
from pysim.identify.greybox.triangle import ROWS, triangle
from pysim.types import Model, Outcome
from pysim.types.answer import NoiseFloor

Array = NDArray[np.float64]
Rows = NDArray[np.intp]  # a number for each row

Channel = tuple[str, str]  # data set and signal
BEFOREHAND = -1  # block of the rows of priors
# Least and largest damping of a step, over the information of a column of norm 1.
_DAMPING = 1e-24, 1e24


@dataclass(frozen=True)
class Carried:
    """Unknowns of a point other than the parameters, which are estimated together with them.

    Args:
        states: per run, an orbit's state (n_states,), the offset of a log's initial states from rest (n_s,), or None.
        nuisances: (k,) sizes of the free sensor errors.
        pieces: per run, number of independent stretches of the residual of a long log; 0 for any other run.
    """

    states: tuple[Array | None, ...] = ()
    nuisances: Array = field(default_factory=lambda: np.zeros(0))
    pieces: tuple[int, ...] = ()


class OwnStep(NamedTuple):
    """Gauss-Newton step of what is estimated beside the parameters: initial states, an orbit's state, or nuisances.

    Args:
        by: (n_s, n) its derivative by x.
        back: (n_s, m) from the directions of the singular value decomposition to the unknowns.
        sizes, inner: (m,) singular values, and residual along each direction.
        through: (n_s, k) its derivative by the steps of the k nuisances.
    """

    by: Array
    back: Array
    sizes: Array
    inner: Array
    through: Array

    @classmethod
    def none(cls, by: Array) -> OwnStep:
        """Without a step at constant x."""
        return cls(by, np.zeros((len(by), 0)), np.zeros(0), np.zeros(0), np.zeros((len(by), 0)))

    def kept(self, damping: float) -> Array:
        """(m,) share of the full step along each direction (Levenberg-Marquardt); damping may be 0 or infinite."""
        return self.sizes**2 / (self.sizes**2 + damping)

    def at(self, damping: float) -> Array:
        """The step (n_s,) at constant x, without the part by the nuisances."""
        return np.asarray(-self.back @ (self.kept(damping) * self.inner / self.sizes))


@dataclass(frozen=True)
class Point:
    """The objective at one point, with everything that a search needs.

    Args:
        x: (n,) search coordinates.
        cost: the objective, in nats if it sums up squares; infinite if the model could not be simulated.
        residual: (n_r,) over the level of its channel; priors are rows too. For a long log, the rows of each channel
            and block are replaced by a QR triangle (`reduction`), with the same sums of squares and products.
        jacobian: (n_r, n) of the residual by x, after elimination of initial states and nuisances.
        levels: (n_c,) of the channels, in their units.
        squares: (n_c,) sums of squares of the residuals, in the units squared.
        known: sum of squares of the residuals with known standard deviations.
        more: number of rows that triangles replace, less the number of rows of the triangles.
        blocks: (n_r,) number of the block that each row belongs to; blocks count as independent of each other. The
            priors of parameters have the block BEFOREHAND.
        series: (n_r,) number of the log and channel that each row belongs to, in the order of time; -1 for priors.
        carried: initial states, orbits and nuisances at this point.
        steps: per array of `carried`, its Gauss-Newton step; None if it is held.
        failure: why the model could not be simulated; None if it could.
    """

    x: Array
    cost: float
    residual: Array
    jacobian: Array
    levels: Array = field(default_factory=lambda: np.zeros(0))
    squares: Array = field(default_factory=lambda: np.zeros(0))
    known: float = 0.0
    more: float = 0.0
    blocks: NDArray[np.intp] = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    series: NDArray[np.intp] = field(default_factory=lambda: np.zeros(0, dtype=np.intp))
    carried: Carried = field(default_factory=Carried)
    steps: tuple[OwnStep | None, ...] = ()
    failure: Failure | None = None

    @property
    def good(self) -> bool:
        """Whether the model could be simulated."""
        return math.isfinite(self.cost)

    @property
    def square(self) -> float:
        """Sum of the squared residuals over their levels."""
        return float(self.residual @ self.residual)

    @property
    def count(self) -> float:
        """Number of rows of all observations and priors, before reduction."""
        return self.residual.size + self.more

    @cached_property
    def triangle(self) -> Array:
        """R (n + 1, n + 1) of the QR factorisation of [Jacobian, residual]."""
        slices = [slice(first, first + ROWS) for first in range(0, max(self.residual.size, 1), ROWS)]
        return triangle(np.column_stack([self.jacobian[own], self.residual[own]]) for own in slices)

    def with_columns(self, columns: Sequence[int]) -> Point:
        """The point with only these parameters free, in this order."""
        steps = tuple(step if step is None else step._replace(by=step.by[:, columns]) for step in self.steps)
        return replace(self, x=self.x[columns], jacobian=self.jacobian[:, columns], steps=steps)

    def own_gain(self, damping: float = 0.0) -> float:
        """nats by which damped steps at constant x would lower the objective, if the model were linear."""
        kept = [(step.kept(damping), step.inner) for step in self.steps if step is not None]
        return 0.5 * sum(float(np.sum(inner**2 * share * (2 - share))) for share, inner in kept)

    def own_length(self, damping: float) -> float:
        """Length of the damped steps at constant x, in levels of the residual."""
        kept = [(step.kept(damping), step) for step in self.steps if step is not None]
        return math.sqrt(sum(float(np.sum((share * step.inner / step.sizes) ** 2)) for share, step in kept))

    def own_damping(self, length: float) -> float:
        """The least damping with which the steps at constant x are no longer than `length`; 0 if they are not."""
        if self.own_length(0.0) <= length:
            return 0.0
        low, high = _DAMPING
        while high > 1.1 * low:  # the length falls as the damping grows
            middle = math.sqrt(low * high)
            low, high = (middle, high) if self.own_length(middle) > length else (low, middle)
        return high

    def carried_to(self, x: Array, damping: float = 0.0) -> Carried:
        """`carried` at another point x (n,), to first order, with the damped step at constant x."""
        if not self.steps:
            return Carried()
        moved, last = list[Array | None](), self.steps[-1]
        nuisances = np.zeros(0) if last is None else last.at(damping)
        for value, step in zip((*self.carried.states, self.carried.nuisances), self.steps, strict=True):
            if value is not None and step is not None:
                value = value + step.at(damping) + (step.through @ nuisances if step.through.size else 0.0)
                if step.by.size:  # empty if the point has no Jacobian
                    value = value + step.by @ (x - self.x)
            moved.append(value)
        sizes = moved.pop()
        assert sizes is not None
        return Carried(tuple(moved), sizes, self.carried.pieces)


def with_rows(point: Point, residual: Array, slopes: Array, block: int) -> Point:
    """The point with additional rows for priors: residual (k,) and Jacobian (k, n), all in one block."""
    return replace(
        point,
        cost=point.cost + 0.5 * float(residual @ residual),
        residual=np.append(point.residual, residual),
        jacobian=np.vstack([point.jacobian, slopes]),
        blocks=np.append(point.blocks, np.full(residual.size, block, dtype=np.intp)),
        series=np.append(point.series, np.full(residual.size, -1, dtype=np.intp)),
    )


def failed_point(x: Array, failure: Failure) -> Point:
    """A point where the model could not be simulated."""
    return Point(x, math.inf, np.zeros(0), np.zeros((0, x.size)), failure=failure)


@dataclass(frozen=True)
class WeightedResiduals:
    """Observations, and how their residuals are weighted.

    Args:
        observations: observations that are compared with the model.
        floors: noise floor of each channel.
        simulation: settings of the runs.
        measure: unit of the residuals. All levels are 1 if it is that of the thesis.
        absolute: whether absolute values are summed up instead of squares; initial states are then held at rest.
        nuisances: sensor errors that are estimated together with the parameters.
        known: sensor errors of known size.
        settings: of levels, priors and blocks.
    """

    observations: tuple[Observation, ...]
    floors: Mapping[Channel, NoiseFloor]
    simulation: Simulation = field(default_factory=Simulation)
    measure: Measure = Measure.SIGNAL
    absolute: bool = False
    nuisances: tuple[Nuisance, ...] = ()
    known: tuple[tuple[Nuisance, float], ...] = ()
    settings: NoiseSettings = field(default_factory=NoiseSettings)

    @property
    def runs(self) -> tuple[Run, ...]:
        """The runs of all observations, in order."""
        return tuple(run for one in self.observations for run in one.runs)

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Channels whose level is estimated, in the order of the observations."""
        return tuple(dict.fromkeys((o.dataset, name) for o in self.observations for name in o.channels))

    @property
    def series(self) -> tuple[tuple[Observation, str | None], ...]:
        """Observation and signal of each number in `Point.series`; the signal is None if the level is known."""
        return tuple((one, name) for one in self.observations for name in (one.channels or (None,)))

    @property
    def known_rows(self) -> int:
        """Number of rows whose level is known."""
        return sum(one.channel_of_row.size for one in self.observations if not one.channels)

    @property
    def samples(self) -> Array:
        """(n_c,) number of samples per channel."""
        return self._summed([one.samples for one in self.observations])

    def evaluate(
        self,
        model: Model,
        space: ParameterSpace,
        x: Array,
        carried: Carried | None = None,
        *,
        jacobian: bool = True,
        states: bool = True,
    ) -> Point:
        """The objective at x (n,). If the model cannot be simulated, nothing is raised: the point has a `failure`.

        Args:
            carried: initial states, guesses of orbits, and nuisances; None: at rest, without guesses and sensor errors.
            jacobian: whether the Jacobian by x is computed; if not, it has no columns.
            states: whether initial states are free; if not, they are held at the values in `carried`.
        """
        carried = carried or Carried()
        answer = self.simulate(model, space, x, carried, jacobian=jacobian, states=states)
        return self.with_priors(self.weigh(x, answer, carried, x.size if jacobian else 0), space)

    def with_priors(self, point: Point, space: ParameterSpace) -> Point:
        """The point with the parameters' priors as rows; unchanged for absolute values and the thesis' measure."""
        if not space.priors or self.absolute or self.measure is Measure.THESIS or not point.good:
            return point
        away, slopes = space.prior_rows(point.x)
        return with_rows(point, away, slopes[:, : point.jacobian.shape[1]], BEFOREHAND)

    def simulate(
        self,
        model: Model,
        space: ParameterSpace,
        x: Array,
        carried: Carried,
        *,
        jacobian: bool = True,
        states: bool = True,
    ) -> Answer:
        """Simulate all runs at x (n,); see `evaluate`."""
        runs = self.runs
        return simulate_runs(
            model,
            space,
            runs,
            x,
            carried.states or (None,) * len(runs),
            self.simulation,
            slopes=jacobian,
            initial=states and not self.absolute,
            reductions=self._reductions(carried),
        )

    def _reductions(self, carried: Carried) -> list[Reduction | None]:
        """A reduction for each run that is too long to keep its rows, None for others; empty if none may be reduced."""
        if self.absolute or self.measure is Measure.THESIS or self.nuisances or self.known:
            return []
        runs, blocks = self.runs, self.settings.blocks
        pieces = carried.pieces or (0,) * len(runs)
        return [
            Reduction(run.measured, count, blocks) if len(run.measured) > self.settings.whole else None
            for run, count in zip(runs, pieces, strict=True)
        ]

    def weigh(self, x: Array, answer: Answer, carried: Carried, n: int) -> Point:
        """The point from simulated runs, with n columns of the Jacobian; a failed point if a residual is not finite."""
        if answer.failure is not None:
            return failed_point(x, answer.failure)
        sizes = carried.nuisances if carried.nuisances.size else np.zeros(len(self.nuisances))
        errors = (*self.known, *zip(self.nuisances, sizes.tolist(), strict=True))
        own = self._own(answer.simulated)
        shown = [(one, one.sensed(answers, errors)) for one, answers in own] if errors else own
        tables = [rows_of(one, answers, self.measure) for one, answers in shown]
        if not all(_finite(table.rows) for table in tables):
            return failed_point(x, Failure("residual", Outcome.DONE, "it is not finite; an output may not move at all"))
        if self.absolute or self.measure is Measure.THESIS:
            return self._unlevelled(x, tables, answer, n)
        by_error = [-one.nuisance_columns(answers, self.nuisances) for one, answers in own] if self.nuisances else []
        return self._levelled(x, tables, answer, replace(carried, nuisances=sizes), by_error, n)

    def _own(self, simulated: Sequence[Simulated]) -> list[tuple[Observation, Sequence[Simulated]]]:
        rest, found = list(simulated), list[tuple[Observation, Sequence[Simulated]]]()
        for one in self.observations:
            found.append((one, rest[: len(one.runs)]))
            rest = rest[len(one.runs) :]
        return found

    def _summed(self, parts: Sequence[Array]) -> Array:
        """Sum over observations, per channel, of values (n_c,) of each observation."""
        place = {channel: i for i, channel in enumerate(self.channels)}
        total = np.zeros(len(place))
        for one, part in zip(self.observations, parts, strict=True):
            for name, value in zip(one.channels, part, strict=True):
                total[place[one.dataset, name]] += value
        return total

    def _unlevelled(self, x: Array, tables: Sequence[_Rows], answer: Answer, n: int) -> Point:
        residual = np.concatenate([table.rows[:, 0] for table in tables])
        jacobian = np.concatenate([table.rows[:, 1 : 1 + n] for table in tables])
        cost = float(np.sum(np.abs(residual))) if self.absolute else 0.5 * float(residual @ residual)
        states, steps = _orbits(answer, n)
        return Point(
            x, cost, residual, jacobian,
            carried=Carried(tuple(states)), steps=(*steps, OwnStep.none(np.zeros((0, n)))),
        )  # fmt: skip

    def _levelled(
        self,
        x: Array,
        tables: Sequence[_Rows],
        answer: Answer,
        carried: Carried,
        by_error: Sequence[Array],
        n: int,
    ) -> Point:
        """The point of all observations, with estimated levels.

        Args:
            by_error: derivatives (n, k) of each observation's residual by the sizes of the nuisances; empty if none.
        """
        squares = self._summed([_squares(one, table) for one, table in zip(self.observations, tables, strict=True)])
        levels, cost = self._levels(squares)
        place = {channel: i for i, channel in enumerate(self.channels)}
        states, steps = _orbits(answer, n)
        parts: list[_Eliminated] = []
        run, known = 0, 0.0
        for k, (one, whole) in enumerate(zip(self.observations, tables, strict=True)):
            own = np.array([levels[place[one.dataset, name]] for name in one.channels] or [1.0])
            size, table = own[whole.channel][:, None], whole.rows
            table /= size
            if not one.channels:
                known += float(table[:, 0] @ table[:, 0])
            more = by_error[k] / size if by_error else np.zeros((len(table), 0))
            free = table.shape[1] - 1 - n
            count = len(one.runs[0].free) if one.runs else 0
            sd = one.runs[0].initial[one.runs[0].free] if count else np.zeros(0)
            offset = carried.states[run] if carried.states and count else None
            offset = np.zeros(count) if offset is None else offset
            is_free = bool(free) or not count
            parts.append(_eliminated(table, more, n, offset, sd) if is_free else _held(table, more, offset, sd))
            cost += 0.5 * float(np.sum((offset / sd) ** 2))
            if count:
                states[run] = offset
            run += len(one.runs)
        point = self._joined(x, parts, states, steps, carried.nuisances, n, tables)
        return replace(point, cost=cost + 0.5 * known + point.cost, levels=levels, squares=squares, known=known)

    def _joined(
        self,
        x: Array,
        parts: Sequence[_Eliminated],
        states: list[Array | None],
        steps: list[OwnStep | None],
        sizes: Array,
        n: int,
        tables: Sequence[_Rows],
    ) -> Point:
        """The point of all observations, with nuisances eliminated; its cost is that of the nuisances' priors alone."""
        residual = _stacked([part.residual for part in parts])
        jacobian = _stacked([part.rows[:, 1 : 1 + n] for part in parts])
        cost, last = 0.0, OwnStep.none(np.zeros((sizes.size, n)))
        if sizes.size:
            sd = np.array([one.prior_sd for one in self.nuisances])
            joint = np.concatenate([part.rows for part in parts])
            found = _eliminated(joint, np.zeros((len(joint), 0)), n, sizes, sd)
            cost = 0.5 * float(np.sum((sizes / sd) ** 2))
            residual = np.concatenate([-sizes / sd, residual])
            jacobian = found.rows[:, 1 : 1 + n]
            last = found.own._replace(by=-found.solution[:, 1 : 1 + n])
        run = 0
        for one, part in zip(self.observations, parts, strict=True):
            if part.solution.size:
                by, through = -part.solution[:, 1 : 1 + n], -part.solution[:, 1 + n :]
                steps[run] = part.own._replace(by=by + through @ last.by, through=through)
            run += len(one.runs)
        blocks, series, pieces = self._blocks(parts, tables, sizes.size)
        return Point(
            x, cost, residual, jacobian, blocks=blocks, series=series, more=sum(table.more for table in tables),
            carried=Carried(tuple(states), sizes, pieces), steps=(*steps, last),
        )  # fmt: skip

    def _levels(self, squares: Array) -> tuple[Array, float]:
        """Level of every channel from sums of squares (n_c,), and the objective of all channels in nats."""
        floor = np.array([self.floors[channel].sd for channel in self.channels])
        samples, least = self.samples, floor**2
        variance = squares / np.maximum(samples, 1.0)
        above = variance > least
        cost = np.where(above, np.log(np.where(above, variance, 1.0)), np.log(least) + variance / least - 1)
        return np.sqrt(np.where(above, variance, least)), float(0.5 * np.sum(samples * cost))

    def _blocks(
        self, parts: Sequence[_Eliminated], tables: Sequence[_Rows], ahead: int = 0
    ) -> tuple[NDArray[np.intp], NDArray[np.intp], tuple[int, ...]]:
        """Block and series of each row, and the number of pieces of long logs. Pieces are assigned to blocks in turn,
        so that each block has some of every log.

        Args:
            parts: one per observation; `ahead` rows of priors come before all.
        """
        blocks, series = [np.zeros(ahead, dtype=np.intp)], [np.full(ahead, -1, dtype=np.intp)]
        dealt, number, settings = 0, 0, self.settings
        counts: list[int] = []
        for one, part, table in zip(self.observations, parts, tables, strict=True):
            counts += [0] * len(one.runs)
            if table.reduction is None:
                pieces = one.pieces(part.residual[part.priors :], settings.piece)
                own, dealing = (dealt + pieces) % settings.blocks, int(pieces[-1]) + 1
            else:
                own, dealing = table.reduction.block, table.reduction.pieces(settings.piece)
                counts[-1] = dealing
            blocks += [np.full(part.priors, dealt % settings.blocks), own]
            series += [np.full(part.priors, -1), number + table.channel]
            dealt += dealing
            number += max(len(one.channels), 1)
        return np.concatenate(blocks), np.concatenate(series), tuple(counts)

    def misfit(self, point: Point, noise: Mapping[Channel, float]) -> float:
        """Root mean square residual in standard deviations of the noise, per degree of freedom: 1 means only noise."""
        size = np.array([noise[channel] for channel in self.channels])
        total = float(np.sum(point.squares / size**2)) + point.known
        return math.sqrt(total / max(float(self.samples.sum()) + self.known_rows - point.x.size, 1.0))


_LARGEST = 1e200  # largest sum of squares; a hundred decades remain for division by levels


class _Rows(NamedTuple):
    """Residual and derivatives of one observation (n, m), channel of each row (n,), and the reduction of a long log."""

    rows: Array
    channel: Rows
    reduction: Reduction | None = None

    @property
    def more(self) -> float:
        """Number of rows that were reduced, less the number of rows that remain."""
        return 0.0 if self.reduction is None else float(self.reduction.count - len(self.rows))


def rows_of(one: Observation, own: Sequence[Simulated], measure: Measure = Measure.SIGNAL) -> _Rows:
    """Residual of an observation and its derivatives, as `Observation.residual`, or the triangles of a long log."""
    reduction = own[0].reduction if own else None
    if reduction is None:
        return _Rows(one.residual(own, measure), one.channel_of_row)
    return _Rows(reduction.table, reduction.channel, reduction)


@dataclass(frozen=True)
class _Eliminated:
    """Rows of one observation after elimination of its initial states; or of all, after that of the nuisances.

    Args:
        residual: (n,) as simulated, rows of priors first.
        rows: (n, 1 + n_x + k) residual, Jacobian and nuisance columns, projected off the eliminated columns.
        solution: (n_s, 1 + n_x + k) least-squares coefficients of the eliminated columns for each of these.
        own: step of the eliminated unknowns, without its derivatives.
        priors: number of rows that are priors.
    """

    residual: Array
    rows: Array
    solution: Array
    own: OwnStep
    priors: int


_NO_STEP = OwnStep.none(np.zeros((0, 0)))


def _eliminated(table: Array, more: Array, n: int, values: Array, sd: Array) -> _Eliminated:
    """Eliminate the last n_s columns of table (n_r, 1 + n + n_s), by QR and a truncated singular value decomposition.

    Args:
        more: (n_r, k) columns that stay, besides the first ones of the table.
        values, sd: (n_s,) present values of the eliminated unknowns; standard deviations of their priors around 0."""
    kept = np.column_stack([table[:, : 1 + n], more]) if more.size else table[:, : 1 + n]
    if not values.size:
        return _Eliminated(np.ascontiguousarray(table[:, 0]), kept, np.zeros((0, kept.shape[1])), _NO_STEP, 0)
    count = values.size
    rows = np.zeros((count + len(kept), kept.shape[1]))
    rows[:count, 0], rows[count:] = -values / sd, kept
    priors, columns = np.diag(-1 / sd), table[:, 1 + n :]
    slices = [slice(first, first + ROWS) for first in range(0, len(table), ROWS)]
    ahead = np.column_stack([priors, rows[:count]])
    whole = triangle([ahead, *(np.column_stack([columns[own], kept[own]]) for own in slices)])
    own, others = whole[:count, :count], whole[:count, count:]
    size = np.linalg.norm(own, axis=0)
    size[size == 0] = 1.0
    u, sigma, vt = np.linalg.svd(own / size)
    held = sigma > EXACT * sigma[0]
    inner = u[:, held].T @ others
    solution = (vt[held].T @ (inner / sigma[held, None])) / size[:, None]
    residual = rows[:, 0].copy()
    rows[:count] -= priors @ solution
    for part in slices:
        rows[count:][part] -= columns[part] @ solution
    none = np.zeros((count, 0))
    own_step = OwnStep(none, vt[held].T / size[:, None], sigma[held], inner[:, 0], none)
    return _Eliminated(residual, rows, solution, own_step, count)


def _held(table: Array, more: Array, values: Array, sd: Array) -> _Eliminated:
    """Rows with unknowns held at `values`; the rows of their priors come first."""
    rows = np.column_stack([table, more])
    ahead = np.zeros((values.size, rows.shape[1]))
    ahead[:, 0] = -values / sd
    rows = np.concatenate([ahead, rows])
    return _Eliminated(rows[:, 0].copy(), rows, np.zeros((0, rows.shape[1])), _NO_STEP, values.size)


def _squares(one: Observation, table: _Rows) -> Array:
    """(n_c,) sum of squares of an observation, including the part that no model changes (`Observation.rest`)."""
    count = len(one.channels)
    if not count:
        return np.zeros(0)
    return one.rest + np.bincount(table.channel, table.rows[:, 0] ** 2, count)[:count]


def _finite(table: Array) -> bool:
    """Whether all entries of a table (n, m) are finite, and small enough for squares that are divided by any level."""
    with np.errstate(over="ignore", invalid="ignore"):
        squares = sum(
            np.vdot(own, own) for own in (table[first : first + ROWS] for first in range(0, len(table), ROWS))
        )
    return bool(squares < _LARGEST)


def _stacked(parts: Sequence[Array]) -> Array:
    return np.ascontiguousarray(parts[0]) if len(parts) == 1 else np.concatenate(parts)


def _orbits(answer: Answer, n: int) -> tuple[list[Array | None], list[OwnStep | None]]:
    """States of the orbits, and their steps: 0 at constant x, as the orbit is already found, and derivatives by x."""
    states: list[Array | None] = [None if orbit is None else orbit[0] for orbit in answer.orbits]
    steps = [None if orbit is None else OwnStep.none(orbit[1][:, :n]) for orbit in answer.orbits]
    return states, steps
