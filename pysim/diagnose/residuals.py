"""Residuals of any model on the measurements, and their slopes: what every step of the diagnosis counts in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.subject import Extended
from pysim.identify.greybox import Simulation, Threads
from pysim.identify.greybox.evaluation import Evaluation, bad_point
from pysim.identify.greybox.simulation import simulate_runs
from pysim.identify.greybox.target import Simulated, Target
from pysim.simulate import Rodas, Solver, simulate_many
from pysim.types import Experiment, Model, Outcome

Array = NDArray[np.float64]

# Step of one-sided differences, in the search's numbers (natural logarithms or shares of the scale): ten times shorter,
# and what step control leaves of the runs' error would be as large as the change by a parameter known to a percent.
STEP = 1e-2


@dataclass(frozen=True)
class Ruler:
    """Runs models through the tests and counts residuals in standard deviations of the noise.

    Args:
        targets: to count; all of one use.
        solver: of the runs.
        workers: runs at a time; all cores where None.
    """

    targets: tuple[Target, ...]
    solver: Solver = field(default_factory=lambda: Rodas(rtol=1e-5, atol=1e-5))
    workers: int | None = None

    def experiments(self, overrides: Mapping[str, float]) -> list[Experiment]:
        """Every run, with parameters set."""
        runs = [run.experiment for target in self.targets for run in target.runs]
        return [replace(e, overrides={**e.overrides, **overrides}) for e in runs]

    def residuals(self, model: Model, settings: Sequence[Mapping[str, float]]) -> list[Array | None]:
        """Per setting of parameters the residuals (n_r,), None where a run failed."""
        runs = [e for overrides in settings for e in self.experiments(overrides)]
        records = simulate_many(model, runs, solver=self.solver, workers=self.workers)
        count = len(runs) // max(len(settings), 1)
        found: list[Array | None] = []
        for k in range(len(settings)):
            own = records[k * count : (k + 1) * count]
            if any(r.outcome is not Outcome.DONE or not np.isfinite(r.values).all() for r in own):
                found.append(None)
            else:
                found.append(self._stacked([r.values for r in own]))
        return found

    def _stacked(self, values: Sequence[Array]) -> Array:
        rest, parts = [Simulated(v, np.zeros((*v.shape, 0))) for v in values], []
        for target in self.targets:
            own, rest = rest[: len(target.runs)], rest[len(target.runs) :]
            parts.append(target.weighted(own).values)
        return np.concatenate(parts)

    def at(self, what: Extended, x: Array) -> Array | None:
        """Residuals (n_r,) of an extended model at x (n,) of its space."""
        return self.residuals(what.model, [_values(what, x)])[0]

    def evaluation(self, what: Extended, x: Array) -> Evaluation:
        """Residuals and their slopes: exact for a model without events, else by one-sided differences."""
        residual = self.at(what, x)
        if residual is None:
            return bad_point(x, "the model could not be simulated")
        slopes = self._differences(what, x, residual) if self.has_events(what, x) else self._exact(what, x)
        if slopes is None:
            return bad_point(x, "the model could not be simulated beside this point")
        return Evaluation(x, float(residual @ residual), residual, slopes)

    def has_events(self, what: Extended, x: Array) -> bool:
        """Whether the shortest test makes more events than its command has pieces."""
        shortest = min(self.experiments(what.space.values(x)), key=lambda e: float(e.times[-1]) - e.start)
        record = simulate_many(what.model, [shortest], solver=self.solver, workers=1)[0]
        return record.statistics["events"] > sum(signal.starts.size for signal in shortest.inputs.values())

    def _exact(self, what: Extended, x: Array) -> Array | None:
        runs = [run for target in self.targets for run in target.runs]
        simulation = Simulation(workers=Threads(self.workers))
        answer = simulate_runs(what.model, what.space, runs, x, [None] * len(runs), simulation)
        if answer.trouble:
            return None
        rest, parts = list(answer.simulated), []
        for target in self.targets:
            own, rest = rest[: len(target.runs)], rest[len(target.runs) :]
            parts.append(target.weighted(own).slopes)
        return np.concatenate(parts)

    def _differences(self, what: Extended, x: Array, residual: Array) -> Array | None:
        """Away from the nearer bound."""
        lower, upper = what.space.bounds()
        steps = np.where(upper - x >= x - lower, STEP, -STEP)
        points = x + np.diag(steps)
        moved = self.residuals(what.model, [_values(what, p) for p in points])
        if any(r is None for r in moved):
            return None
        return np.stack([(r - residual) / step for r, step in zip(moved, steps, strict=True) if r is not None], axis=1)


def _values(what: Extended, x: Array) -> dict[str, float]:
    return what.space.values(x)


def rulers(targets: Sequence[Target], workers: int | None = None) -> tuple[Ruler, Ruler | None]:
    """For what is fitted, and for what is held out if anything is."""
    fitted = tuple(t for t in targets if t.use == "fit")
    held = tuple(t for t in targets if t.use != "fit")
    return Ruler(fitted, workers=workers), Ruler(held, workers=workers) if held else None
