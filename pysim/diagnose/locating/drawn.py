"""What a fitted effect does at its place, as samples of a term over a variable: where a table starts, or a picture."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.fit import RANGE, bends
from pysim.diagnose.locating.known import Known
from pysim.diagnose.locating.laws import RATE, Law
from pysim.diagnose.locating.shape import units
from pysim.simulate import simulate_many
from pysim.types import Model, Outcome, Record
from pysim.types.diagnosis import Shape

Array = NDArray[np.float64]

# Between two looks at a signal, s.
_STEP = 1e-3
# Part of a term that is no function of the variable, as a share of its size, from which on it remembers.
_MEMORY = 0.1
# Weight of bends, as a share of what the samples give a value.
_SMOOTH = 1e-6
# What the slot's own filling gives, as a share of the largest: rounding.
_SAME = 1e-6
# A picture's points, and the share of the range that counts as beside one of them, with so many samples at least.
_POINTS, _WINDOW, _LEAST = 81, 0.02, 40
_BAND = (0.025, 0.975)


@dataclass(frozen=True)
class Acted:
    """What an effect gives where a law stands.

    Args:
        law: the place, and what the term is looked at over.
        argument, term: (n,) samples in all tests.
        knots: (m,) as the law's table has them.
        values: (m,) of the table that is nearest.
        scatter: root mean square of what the table misses, as a share of the term's.
    """

    law: Law
    argument: Array = field(repr=False)
    term: Array = field(repr=False)
    knots: Array = field(repr=False)
    values: Array = field(repr=False)
    scatter: float

    @property
    def remembers(self) -> bool:
        """Whether it is no function of the variable."""
        return self.scatter > _MEMORY


def acted(one: Known, base: Fitted, laws: Sequence[tuple[Law, Array]]) -> Acted | None:
    """The law of the effect's place over whose variable the effect is nearest to a function.

    Args:
        one: the effect in its place.
        base: the model without it.
        laws: of that place, with their knots.
    Returns:
        None where the place's own filling is neither nothing nor one of the variables it sees, or the effect does
        nothing.
    """
    names = tuple(dict.fromkeys(name for law, _ in laws for c in law.copies for name in (c.output, c.argument)))
    before, after = _records(one, base, base, names), _records(one, base, one.at, names)
    if not before or not after:
        return None
    found = []
    for law, knots in laws:
        neutral = _neutral(before, law, names)
        if neutral is None:
            continue
        parts = [
            (_argument(record, law, k), record[c.output] - (record[neutral[k]] if neutral[k] else 0.0))
            for record in after
            for k, c in enumerate(law.copies)
        ]
        z, y = (np.concatenate([part[i] for part in parts]) for i in (0, 1))
        if np.any(y):
            found.append(_table(law, z, y, knots))
    return min(found, key=lambda acted: acted.scatter, default=None)


def _records(one: Known, base: Fitted, at: Fitted, names: tuple[str, ...]) -> list[Record]:
    runs = []
    for experiment in one.ruler.experiments(at.what.space.values(at.point.x)):
        duration = float(experiment.times[-1]) - experiment.start
        times = np.linspace(experiment.start, experiment.times[-1], 2 + int(duration / _STEP))
        runs.append(replace(experiment, times=times, record=names))
    records = simulate_many(at.what.model, runs, solver=one.ruler.solver, workers=one.ruler.workers)
    return list(records) if all(r.outcome is Outcome.DONE for r in records) else []


def _neutral(records: Sequence[Record], law: Law, names: Sequence[str]) -> list[str] | None:
    """Per copy the variable that the model hands on at that place without the effect, "" for nothing."""
    found = []
    for copy in law.copies:
        size = max(float(np.max(np.abs(record[copy.output]))) for record in records)
        same = ["", *(name for name in names if name != copy.output and _slot(name) == _slot(copy.output))]
        for name in same:
            apart = (record[copy.output] - (record[name] if name else 0.0) for record in records)
            if max(float(np.max(np.abs(rows))) for rows in apart) <= _SAME * size:
                found.append(name)
                break
        else:
            return None
    return found


def _slot(name: str) -> str:
    return name.rpartition(".")[0]


def _argument(record: Record, law: Law, copy: int) -> Array:
    """What the law depends on: the variable, or its rate, as late as the law sees it."""
    z, step = record[law.copies[copy].argument], float(record.time[1] - record.time[0])
    if law.of_rate:
        z = np.gradient(z, step)
    late = law.lag or (RATE if law.of_rate else 0.0)
    if not late:
        return z
    kept = float(np.exp(-step / late))
    return np.asarray(lfilter([1 - kept], [1, -kept], z, zi=[kept * z[0]])[0])


def _table(law: Law, z: Array, y: Array, knots: Array) -> Acted:
    """Least squares, straight on beyond the last knots."""
    hats = np.stack([np.interp(z, knots, row) for row in np.eye(knots.size)], axis=1)
    gram, rough = hats.T @ hats, bends(knots).T @ bends(knots)
    weight = _SMOOTH * float(np.trace(gram)) / knots.size
    values: Array = np.asarray(np.linalg.solve(gram + weight * (rough + 1e-6 * np.eye(knots.size)), hats.T @ y))
    scatter = float(np.linalg.norm(y - hats @ values) / np.linalg.norm(y))
    return Acted(law, z, y, knots, values, scatter)


def remembered(of: Acted, model: Model, doubt: float) -> Shape:
    """The term where it remembers: its mean over the variable, and between which ends 95 percent of it lie.

    Args:
        doubt: half a 95 percent interval of the effect's size, as a share of it.
    """
    order = np.argsort(of.argument, kind="stable")
    z, y = of.argument[order], of.term[order]
    low, high = (float(end) for end in np.quantile(z, RANGE))
    grid = np.linspace(low, high, _POINTS)
    rows = np.array([_beside(z, y, at, _WINDOW * (high - low)) for at in grid.tolist()])
    wider = doubt * np.max(np.abs(rows[:, 1:]), axis=1)
    unit_in, unit_out = units(of.law, model)
    return Shape(grid, rows[:, 0], rows[:, 1] - wider, rows[:, 2] + wider, unit_in, unit_out)


def _beside(z: Array, y: Array, at: float, half: float) -> tuple[float, float, float]:
    """Mean and ends of the samples around a place."""
    first, last = np.searchsorted(z, [at - half, at + half]).tolist()
    if last - first < _LEAST:
        middle = int(np.searchsorted(z, at))
        first = max(min(middle - _LEAST // 2, z.size - _LEAST), 0)
        last = min(first + _LEAST, z.size)
    near = y[first:last]
    low, high = np.quantile(near, _BAND)
    return float(np.mean(near)), float(low), float(high)
