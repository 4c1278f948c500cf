"""Logs that began while the plant still moved: what of their start does not count."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from pysim.diagnose.residuals import Ruler
from pysim.diagnose.subject import Extended
from pysim.diagnose.whiten import whitening
from pysim.identify.greybox.residuals import Point
from pysim.identify.greybox.time_log import TimeLog
from pysim.simulate import simulate_many
from pysim.types import Outcome

Array = NDArray[np.float64]

# s after which a plate that moved when its log began is at rest; s at its start in which that shows.
_OVER, _SHOWS = 0.8, 0.15
# A wrong start shows with this chance by noise alone, and the model moves little while it does.
_BY_CHANCE, _STILL = 1e-6, 0.25
# Lengths of a log, over those of the start left out: something is left, as of a sine that had not settled; much is.
_LEFT, _MUCH_LEFT = 1.25, 4.0


def started(ruler: Ruler, what: Extended, x: Array) -> Ruler:
    """The ruler without the starts that are wrong beside a model."""
    near = answers(ruler, what, x)
    return ruler if near is None else ruler.with_other(skips=skips_beside(ruler, near))


def skips_beside(ruler: Ruler, near: Sequence[Array]) -> tuple[float, ...]:
    """Per target s at its start that do not count; what was left out once stays so.

    Args:
        near: `answers` of a model.
    """
    return tuple(
        _OVER if skip or (isinstance(t, TimeLog) and _wrong_start(ruler, t, near[place])) else 0.0
        for t, skip, place in zip(ruler.targets, ruler.skips, _places(ruler), strict=True)
    )


def answers(ruler: Ruler, what: Extended, x: Array) -> list[Array] | None:
    """What a model at x (n,) of its space answers in every run; None where one fails."""
    runs = ruler.experiments(what.space.values(x))
    records = simulate_many(what.model, runs, solver=ruler.solver, workers=ruler.workers)
    good = all(r.outcome is Outcome.DONE and np.isfinite(r.values).all() for r in records)
    return [r.values for r in records] if good else None


def _places(ruler: Ruler) -> list[int]:
    """Of each target's first run."""
    return np.cumsum([0, *(len(t.runs) for t in ruler.targets)])[:-1].tolist()


def restless_beside(ruler: Ruler, point: Point) -> tuple[float, ...]:
    """Skips with those logs that leave more at their very start than noise does, and than they leave after it.

    So beside a model that is near the plant even a little motion shows that was left when a log began.
    """
    rows = np.split(point.residual, np.cumsum([w.size for w in ruler.whitenings])[:-1])
    found = []
    for target, own, skip in zip(ruler.targets, rows, ruler.skips, strict=True):
        if isinstance(target, TimeLog) and not skip and _length(target) >= _LEFT * _OVER:
            time = target.measured.time
            first = int(np.searchsorted(time, time[0] + _SHOWS)) * own.size // time.size
            level = max(1.0, float(np.mean(own[first:] ** 2))) if first < own.size else np.inf
            if float(np.sum(own[:first] ** 2)) > level * float(stats.chi2.isf(_BY_CHANCE, max(first, 1))):
                skip = _OVER
        found.append(skip)
    return tuple(found)


def _length(target: TimeLog) -> float:
    """Of a log, s."""
    return float(target.measured.time[-1] - target.measured.time[0])


def _wrong_start(ruler: Ruler, target: TimeLog, simulated: Array) -> bool:
    """Whether the log leaves a model that starts at rest at once, before the model's motion could explain it."""
    early = target.measured.time - target.measured.time[0] < _SHOWS
    if _length(target) < _MUCH_LEFT * _OVER or early.sum() < 3:
        return False
    noise = np.array(target.noise)
    apart = ((target.measured.values - simulated) / noise)[early]
    moved = (simulated / noise)[early]
    apart, moved = apart - apart.mean(axis=0), moved - moved.mean(axis=0)
    if np.sum(apart**2) < _STILL**2 * np.sum(moved**2):
        return False
    whole = np.zeros(simulated.shape)
    whole[early] = apart
    independent = whitening(target, ruler.noise).of(whole.reshape(-1, 1)).reshape(simulated.shape)[early]
    return float(np.sum(independent**2)) > float(stats.chi2.isf(_BY_CHANCE, apart.size))
