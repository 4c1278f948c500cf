"""Residuals of any model on the measurements, and their slopes: what every step of the diagnosis counts in."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.adapter import Target, bad_point, over_noise
from pysim.diagnose.noise import Column, Noise, estimated_noise
from pysim.diagnose.nuisance import NOTHING, Span, Suspect, columns, undisturbed
from pysim.diagnose.subject import Extended
from pysim.diagnose.whiten import Whitening, whitening
from pysim.identify.greybox import Simulation, Threads
from pysim.identify.greybox.observation import Simulated
from pysim.identify.greybox.residuals import Point
from pysim.identify.greybox.runs import simulate_runs
from pysim.simulate import Esdirk, Rodas, Solver, simulate_many
from pysim.types import Experiment, Model, Outcome, Record

Array = NDArray[np.float64]

# Step of one-sided differences, in the search's numbers (natural logarithms or shares of the scale): ten times shorter,
# and what step control leaves of the runs' error would be as large as the change by a parameter known to a percent.
STEP = 1e-2
# Slopes beyond are none: their products would leave the range of numbers.
_STEEPEST = 1e100
# Residuals beyond are those of a model that ran away, and no guide: differences by them are no slopes.
_RUNAWAY = 1e50
# Slopes of a run with events come from runs so fine that they take ten times the steps. One that takes so many times
# those of the longest run at the ruler's tolerances chatters there, and one-sided differences say as much.
_PATIENCE = 20


@dataclass(frozen=True)
class Ruler:
    """Runs models through the tests and counts residuals in standard deviations of the noise.

    Args:
        targets: to count; all of one use.
        solver: of the runs.
        workers: runs at a time; all cores where None.
        noise: of each signal; white and as large as the targets have it where not named.
        skips: per target, s at its start that do not count; none where empty.
        suspected: nuisances that are allowed for: residuals and slopes are counted across what they span.
        near: per run, what a model near the plant answers (n_t, n_y): the shape of the nuisances.
        taken: shifts of clocks that the targets have lost, s. Residuals are counted with them put back in a straight
            line: so what is counted is what it was, but for the error of the straight line.
        whitenings, span, back: what follows from all that; left out, they are worked out.
    """

    targets: tuple[Target, ...]
    solver: Solver = field(default_factory=lambda: Rodas(rtol=1e-5, atol=1e-5))
    workers: int | None = None
    noise: Mapping[Column, Noise] = field(default_factory=dict)
    skips: tuple[float, ...] = ()
    suspected: tuple[Suspect, ...] = ()
    near: tuple[Array, ...] = field(default=(), repr=False)
    taken: Mapping[Suspect, float] = field(default_factory=dict)
    whitenings: tuple[Whitening, ...] = field(default=(), repr=False)
    span: Span = field(default=NOTHING, repr=False)
    back: Array = field(default_factory=lambda: np.zeros(0), repr=False)

    def __post_init__(self) -> None:
        if self.whitenings:
            return
        skips = self.skips or (0.0,) * len(self.targets)
        maps = tuple(whitening(t, self.noise, skip) for t, skip in zip(self.targets, skips, strict=True))
        everyone = (*self.suspected, *self.taken)
        rows, rest = [np.zeros((0, len(everyone)))], list(self.near)
        for target, made in zip(self.targets, maps, strict=True):
            own, rest = rest[: len(target.runs)], rest[len(target.runs) :]
            rows.append(made.of(columns(target, own, everyone)) if everyone else rows[0])
        each, count = np.concatenate(rows), len(self.suspected)
        object.__setattr__(self, "skips", skips)
        object.__setattr__(self, "whitenings", maps)
        object.__setattr__(self, "span", Span.of(each[:, :count], np.array([s.width for s in self.suspected])))
        object.__setattr__(self, "back", each[:, count:] @ np.array(list(self.taken.values())))

    def with_other(self, **changed: Any) -> Ruler:
        """The ruler with other targets, noise, skips or nuisances."""
        return replace(self, **{**changed, "whitenings": (), "span": NOTHING})

    def only(self, suspects: Collection[Suspect]) -> Ruler:
        """The ruler that allows for those of its nuisances that are among others."""
        kept = tuple(s for s in self.suspected if s in suspects)
        return self.with_other(suspected=kept).moved({s: v for s, v in self.taken.items() if s in suspects})

    def moved(self, shifts: Mapping[Suspect, float]) -> Ruler:
        """The ruler with these shifts of clocks taken off its targets, s, and no others."""
        if shifts == self.taken:
            return self
        change = {s: shifts.get(s, 0.0) - self.taken.get(s, 0.0) for s in {**self.taken, **shifts}}
        return self.with_other(targets=undisturbed(self.targets, change), taken=dict(shifts))

    @property
    def plain(self) -> Ruler:
        """The ruler that allows for no nuisance."""
        return self.only(())

    @property
    def bare(self) -> Ruler:
        """The ruler of the same rows before any nuisance is allowed for."""
        return replace(self, suspected=(), span=NOTHING)

    @property
    def freedom(self) -> int:
        """Independent residuals: rows less what nuisances take."""
        return sum(w.size for w in self.whitenings) - self.span.freedom

    def count(self, model: Model, runs: Sequence[Experiment]) -> Array | None:
        """Residuals (n_r,) of changed experiments, given in the order of `experiments`; None where one failed."""
        return self._counted(simulate_many(model, list(runs), solver=self.solver, workers=self.workers))

    def experiments(self, overrides: Mapping[str, float]) -> list[Experiment]:
        """Every run, with parameters set."""
        runs = [run.experiment for target in self.targets for run in target.runs]
        return [replace(e, overrides={**e.overrides, **overrides}) for e in runs]

    def failure(self, what: Extended, x: Array) -> str:
        """Which run of a model at x (n,) of its space fails first, and why; "" where none does."""
        records = self._runs(what, x)
        names = [run.record for target in self.targets for run in target.runs]
        failed = ((n, r) for n, r in zip(names, records, strict=True) if r.outcome is not Outcome.DONE)
        return next((f"{name}: {record.outcome.value}. {record.message}".strip() for name, record in failed), "")

    def residuals(self, model: Model, settings: Sequence[Mapping[str, float]]) -> list[Array | None]:
        """Per setting of parameters the residuals (n_r,), None where a run failed."""
        runs = [e for overrides in settings for e in self.experiments(overrides)]
        records = simulate_many(model, runs, solver=self.solver, workers=self.workers)
        count = len(runs) // max(len(settings), 1)
        found: list[Array | None] = []
        for k in range(len(settings)):
            found.append(self._counted(records[k * count : (k + 1) * count]))
        return found

    def _counted(self, records: Sequence[Record]) -> Array | None:
        if any(r.outcome is not Outcome.DONE or not np.isfinite(r.values).all() for r in records):
            return None
        rows = self.weighed([Simulated(r.values, np.zeros((*r.values.shape, 0))) for r in records])
        return self.span.across(rows)[:, 0] if np.all(np.abs(rows) < _RUNAWAY) else None

    def weighed(self, simulated: Sequence[Simulated]) -> Array:
        """Residuals and, in the columns behind, their slopes, (n_r, 1 + n_x), nuisances and all."""
        rest, parts = list(simulated), []
        for target, made in zip(self.targets, self.whitenings, strict=True):
            own, rest = rest[: len(target.runs)], rest[len(target.runs) :]
            residual = over_noise(target, own)
            parts.append(made.of(np.column_stack([residual.values, residual.slopes])))
        rows = np.concatenate(parts)
        rows[:, 0] += self.back if self.taken else 0.0
        return rows

    def at(self, what: Extended, x: Array) -> Array | None:
        """Residuals (n_r,) of an extended model at x (n,) of its space."""
        return self._counted(self._runs(what, x))

    def _runs(self, what: Extended, x: Array) -> tuple[Record, ...]:
        return simulate_many(what.model, self.experiments(_values(what, x)), solver=self.solver, workers=self.workers)

    def evaluation(self, what: Extended, x: Array) -> Point:
        """Residuals and their slopes: exact for a model without events, else by one-sided differences.

        So too where an exact slope is no number, as that of a root at nothing, or where its run chatters.
        """
        whole = self.bare
        records = whole._runs(what, x)
        residual = whole._counted(records)
        if residual is None:
            return bad_point(x, "the model could not be simulated")
        most = _PATIENCE * max(r.statistics["steps"] + r.statistics["rejected"] for r in records)
        slopes = None if self.has_events(what, x) else whole._exact(what, x, most)
        if slopes is None or not np.all(np.abs(slopes) < _STEEPEST):
            slopes = whole._differences(what, x, residual)
        if slopes is None:
            return bad_point(x, "the model could not be simulated beside this point")
        return self.counted(x, np.column_stack([residual, slopes]))

    def counted(self, x: Array, rows: Array) -> Point:
        """A point from residuals and slopes (n_r, 1 + n) where no nuisance is allowed for."""
        across = self.span.across(rows)
        residual = across[:, 0].copy()
        return Point(x, float(residual @ residual), residual, across[:, 1:].copy())

    def whole(self, point: Point) -> Array:
        """Residuals and slopes (n_r, 1 + n) of a point of this ruler where no nuisance is allowed for."""
        return self.span.undone(np.column_stack([point.residual, point.jacobian]))

    def has_events(self, what: Extended, x: Array) -> bool:
        """Whether the shortest test makes more events than its command has jumps and kinks."""
        shortest = min(self.experiments(what.space.values(x)), key=lambda e: float(e.times[-1]) - e.start)
        record = simulate_many(what.model, [shortest], solver=self.solver, workers=1)[0]
        breaks = sum(int(np.count_nonzero(np.logical_or(*signal.breaks()))) for signal in shortest.inputs.values())
        return record.statistics["events"] > breaks

    def _exact(self, what: Extended, x: Array, most: int) -> Array | None:
        """Slopes (n_r, n); None where a run fails or takes more than so many steps."""
        runs = [run for target in self.targets for run in target.runs]
        simulation = Simulation(workers=Threads(self.workers))
        if isinstance(self.solver, Rodas | Esdirk):
            known = self.solver
            solver = Esdirk(rtol=known.rtol, atol=known.atol, max_step=known.max_step, max_steps=max(most, 1))
            simulation = replace(simulation, solver=solver)
        answer = simulate_runs(what.model, what.space, runs, x, [None] * len(runs), simulation, initial=False)
        if answer.failure:
            return None
        return self.weighed(answer.simulated)[:, 1:]

    def _differences(self, what: Extended, x: Array, residual: Array) -> Array | None:
        steps = steps_inside(x, what.space.bounds())
        points = x + np.diag(steps)
        moved = self.residuals(what.model, [_values(what, p) for p in points])
        if any(r is None for r in moved):
            return None
        return np.stack([(r - residual) / step for r, step in zip(moved, steps, strict=True) if r is not None], axis=1)


def steps_inside(x: Array, bounds: tuple[Array, Array]) -> Array:
    """Steps (n,) of differences at a point (n,), away from the nearer bound."""
    return np.where(bounds[1] - x >= x - bounds[0], STEP, -STEP)


def _values(what: Extended, x: Array) -> dict[str, float]:
    return what.space.values(x)


def rulers(targets: Sequence[Target], workers: int | None = None, *, told: bool = True) -> tuple[Ruler, Ruler | None]:
    """For what is fitted, and for what is held out if anything is, with the noise that the logs show.

    Args:
        told: whether the noise in the targets is told by the data set; seen otherwise, with noise as white.
    """
    noise = estimated_noise(targets, told=told)
    fitted, held = (tuple(t for t in targets if (t.use == "fit") is fit) for fit in (True, False))
    ruler = Ruler(fitted, workers=workers, noise=noise)
    return ruler, Ruler(held, workers=workers, noise=noise) if held else None
