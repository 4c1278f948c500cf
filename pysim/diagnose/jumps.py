"""Logs that a model cannot be fitted to by slopes: its answer jumps where a parameter moves by a few thousandths.

So where a model has several steady states and the smallest change decides which one a sine ends in. One such log makes
the sum of squares a comb, and the end of a refit the gap that it got caught in.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.adapter import Target
from pysim.diagnose.corrections import is_off
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.residuals import Ruler
from pysim.identify.greybox.stepped_sines import SteppedSines

Array = NDArray[np.float64]

# How far each parameter is moved to both sides, in units of the search: natural logarithms of most.
STEP = 3e-3
# Length by which the residuals of a log then are beside a straight line, where noise has a length of one: more is a
# jump, unless the line is so long that this share of it is a bend.
_JUMP, _BEND = 10.0, 0.25
# Share of all rows that may be left out.
_FEW = 0.5


def logs(ruler: Ruler) -> list[tuple[str, slice]]:
    """Source of each log and its rows among the residuals."""
    targets = zip(ruler.targets, ruler.whitenings, strict=True)
    parts = [(source, rows) for t, w in targets for source, rows in zip(_sources(t), w.parts, strict=True)]
    ends = np.cumsum([0, *(rows for _, rows in parts)]).tolist()
    return [(source, slice(*rows)) for (source, _), rows in zip(parts, pairwise(ends), strict=True)]


def jumping(ruler: Ruler, at: Fitted) -> list[str]:
    """Sources of the logs on which a model's answer jumps, of one with events that is near the measurements.

    A smooth model has none. Where most of what was measured jumps there is no fit without it, and nothing is named.

    Args:
        ruler: that counted
        at: the fitted model.
    """
    if is_off(ruler, at.point) or not ruler.has_events(at.what, at.point.x):
        return []
    places = logs(ruler)
    (lower, upper), x = at.what.space.bounds(), at.point.x
    steps = STEP * np.eye(x.size)[(x + STEP <= upper) & (x - STEP >= lower)]
    points = [at.what.space.values(x + sign * step) for step in steps for sign in (1.0, -1.0)]
    bare, here = ruler.bare, ruler.whole(at.point)[:, 0]  # a nuisance would put a share of a jump into other logs
    runs = iter(bare.residuals(at.what.model, points))
    found = set[str]()
    for above, below in zip(runs, runs, strict=True):
        if above is not None and below is not None:
            straight, beside = above - below, above - 2 * here + below
            lengths = ((source, np.linalg.norm([straight[rows], beside[rows]], axis=1)) for source, rows in places)
            found |= {source for source, (long, bend) in lengths if bend > max(_JUMP, _BEND * long)}
    share = sum(rows.stop - rows.start for source, rows in places if source in found) / at.point.residual.size
    return list(dict.fromkeys(source for source, _ in places if source in found and share < _FEW))


def without(targets: Sequence[Target], sources: Collection[str]) -> tuple[Target, ...]:
    """Targets without the logs of these sources."""
    kept = (t.without(sources) if isinstance(t, SteppedSines) else t for t in targets)
    return tuple(t for t in kept if any(source not in sources for source in _sources(t)))


def _sources(target: Target) -> list[str]:
    """Of a target's logs."""
    return [log.source for log in target.logs] if isinstance(target, SteppedSines) else [target.runs[0].record]
