"""Ten data sets of an independent plant, diagnosed and held against the truth."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence

from pysim.diagnosis import diagnose
from pysim.types.answer import Diagnosis
from validation.asked import PUMP
from validation.diagnosis.intervals import estimated, named
from validation.diagnosis.sets import NAMES, Told, read_set, read_told
from validation.drawn import drawn, of_the_day
from validation.findings import Finding

AGAIN = 5
"""Sets that are answered each day."""
_FAR = 2.0  # half widths of a 95 percent interval: once in ten thousand times
_HELD = 1.05  # residual over noise of a model that lacks nothing


def answered(name: str) -> Diagnosis:
    """Diagnose that set with the base model and the whole catalogue."""
    return diagnose(PUMP.session(read_set(name)))


def run(
    names: Sequence[str] = NAMES, answer: Callable[[str], Diagnosis] = answered, *, seed: int | None = None
) -> Iterator[Finding]:
    """Some sets, then all intervals of those together.

    Args:
        seed: of the draw; the day's number where None, so that every day answers others.
    """
    outside, total = 0, 0
    seed = of_the_day() if seed is None else seed
    for name in drawn(names, AGAIN, seed):
        found, told = answer(name), read_told(name)
        yield from against_truth(name, found, told)
        rows = [(e, true) for e, true in estimated(told, found) if not e.at and math.isfinite(true)]
        total += len(rows)
        outside += sum(not e.interval[0] <= true <= e.interval[1] for e, true in rows)
    claim = f"truths outside their 95 percent intervals, of {total} in sets drawn with seed {seed}"
    yield Finding(claim, float(outside), _binomial(total), "")


def _right(verdict: str, added: Sequence[str], told: Told) -> bool:
    """The verdict is one of the truth's, and no effect is too few or too many."""
    nothing = told.names in (("none",), ("unknown",))
    return verdict in told.names and (nothing or sorted(added) == sorted(told.names))


def _binomial(total: int) -> float:
    """More misses than this would happen to honest intervals once in a thousand times."""
    from scipy import stats

    return float(stats.binom.ppf(0.999, total, 0.05))


def against_truth(name: str, found: Diagnosis, told: Told) -> Iterator[Finding]:
    """Verdict, effects, strengths, and what is left on held-out records."""
    added = tuple(one.effect.name for one in named(found))
    if told.names not in (("none",), ("unknown",)):
        left = found.history[-1].validate
        yield Finding(f"{name}: held-out residual over noise", math.nan if left is None else left, _HELD, "")
    claim = f"{name}: {found.verdict} ({', '.join(added) or 'nothing added'}), truth {' and '.join(told.names)}; wrong"
    yield Finding(claim, float(not _right(found.verdict, added, told)), 0, "")
    own = {f"{one.place}.{p.name}": one.effect.name for one in named(found) for p in one.effect.parameters}
    for estimate, true in estimated(told, found):
        if estimate.name in own and own[estimate.name] in told.names:
            half = (estimate.interval[1] - estimate.interval[0]) / 2
            off = abs(estimate.value - true) / half if half > 0 else math.inf
            claim = f"{name}: {own[estimate.name]} {estimate.name} = {estimate.value:.4g}, truth {true:.4g}; off by"
            yield Finding(claim, off, _FAR, "half widths of the interval")
