"""What each effect is worth, by SciPy's least squares on the plant's equations: no noise, nothing of the product."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from tests.known_answers.case import Case
from tests.known_answers.plants import simulate

Array = NDArray[np.float64]


def misfit(case: Case, effects: Sequence[str]) -> float:
    """Mean square over noise that the best model with these effects leaves of the fitted logs without their noise."""
    free = [*((None, name) for name in case.parameters), *((e, p) for e in effects for p in case.effects[e])]
    true = np.array([case.parameters[p] if e is None else case.effects[e][p] for e, p in free])
    times = case.logged(case.logs.fit[0])[0] + case.logs.begins
    noises = np.array([sensor.noise for sensor in case.plant.sensors.values()])
    commands = [case.command(seed) for seed in case.logs.fit]
    clean = [simulate(case.plant, case.parameters, case.effects, command, times) for command in commands]

    def residual(scaled: Array) -> Array:
        own = {p: float(v) for (e, p), v in zip(free, scaled * true, strict=True) if e is None}
        added = {e: {p: float(v) for (of, p), v in zip(free, scaled * true, strict=True) if of == e} for e in effects}
        runs = [simulate(case.plant, own, added, command, times) for command in commands]
        return np.concatenate([((run - y) / noises).ravel() for run, y in zip(runs, clean, strict=True)])

    found = least_squares(residual, np.ones(len(free)), diff_step=1e-4, x_scale=0.1)
    return float(2 * found.cost / residual(np.ones(len(free))).size)


def shares(case: Case) -> dict[str, float]:
    """Of what the best model without any effect leaves, the part that each takes alone, everything refitted."""
    bare = misfit(case, [])
    return {name: 1 - misfit(case, [name]) / bare for name in case.effects}


def losses(case: Case) -> dict[str, float]:
    """Mean square over noise that comes back where one effect is left out and everything is refitted."""
    return {name: misfit(case, [other for other in case.effects if other != name]) for name in case.effects}
