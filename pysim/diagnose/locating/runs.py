"""Which tests a term is looked for in: those that show most of the misfit for the time they take."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.adapter import Target
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.laws import Law
from pysim.diagnose.residuals import Ruler
from pysim.identify.greybox.residuals import Point
from pysim.identify.greybox.stepped_sines import SteppedSines
from pysim.identify.greybox.time_log import TimeLog
from pysim.simulate import Esdirk, Rodas, simulate_many
from pysim.types import Experiment
from pysim.types.record_kind import STEPPED_SINE

Array = NDArray[np.float64]

# Share of the simulated time that is run.
_SHARE = 0.22
# How strongly long tests are shunned: misfit over time to this power.
_POWER = 1.5
# A run with a term may take so many times the steps of the longest without: a term that drives a model wild is wrong.
_PATIENCE = 20
# Between two looks at a variable, s.
_STEP = 4e-3


@dataclass(frozen=True)
class _Piece:
    """What can be run without the rest: a log over time, a stepped sine, or a table of them.

    Args:
        misfit: sum of squares beyond noise.
        time: simulated, s.
        target: its number.
        runs: their numbers in the target.
        over_time: whether it is a log that is no stepped sine.
    """

    misfit: float
    time: float
    target: int
    runs: tuple[int, ...]
    over_time: bool = False

    @property
    def worth(self) -> float:
        """Misfit for its time."""
        return self.misfit / self.time**_POWER


def thinned(ruler: Ruler, point: Point) -> Ruler:
    """A ruler of those runs that show most of the misfit for their time, the best log over time always among them.

    Args:
        point: of the ruler's own model, with its residuals.
    """
    pieces = list(_pieces(ruler, point.residual))
    whole = sum(piece.time for piece in pieces)
    used, kept = 0.0, dict[int, list[int]]()
    for piece in _in_order(pieces):
        if not kept or used + piece.time <= _SHARE * whole:
            used += piece.time
            kept.setdefault(piece.target, []).extend(piece.runs)
    chosen, near = [], []
    starts = np.cumsum([0, *(len(target.runs) for target in ruler.targets)])
    for number, logs in sorted(kept.items()):
        chosen.append(_part(ruler.targets[number], sorted(logs)))
        if ruler.near:
            near += [ruler.near[starts[number] + log] for log in sorted(logs)]
    skips = tuple(ruler.skips[number] for number in sorted(kept))
    return ruler.with_other(targets=tuple(chosen), skips=skips, near=tuple(near))


def patient(ruler: Ruler, current: Fitted) -> Ruler:
    """The ruler whose runs end as failed once they take far more steps than those of the fitted model."""
    if not isinstance(ruler.solver, Rodas | Esdirk):
        return ruler
    runs = ruler.experiments(current.what.space.values(current.point.x))
    records = simulate_many(current.what.model, runs, solver=ruler.solver, workers=ruler.workers)
    most = _PATIENCE * max((r.statistics["steps"] + r.statistics["rejected"] for r in records), default=0)
    return replace(ruler, solver=replace(ruler.solver, max_steps=max(most, 1)))


def _in_order(pieces: Sequence[_Piece]) -> list[_Piece]:
    """By worth, the best log over time ahead of all."""
    ordered = sorted(pieces, key=lambda piece: -piece.worth)
    best = next((piece for piece in ordered if piece.over_time), None)
    return sorted(ordered, key=lambda piece: piece is not best)


def _pieces(ruler: Ruler, residual: Array) -> Iterator[_Piece]:
    """In the order of the targets; a stepped sine that had not settled is taken to show more than any other."""
    rest = residual
    for number, (target, whitening) in enumerate(zip(ruler.targets, ruler.whitenings, strict=True)):
        own, rest = rest[: whitening.size], rest[whitening.size :]
        times = [_duration(run.experiment) for run in target.runs]
        if isinstance(target, SteppedSines):
            for log, time in enumerate(times):
                part, own = own[: target.logs[log].harmonics.size], own[target.logs[log].harmonics.size :]
                yield _Piece(float(part @ part) - part.size, time, number, (log,))
        elif isinstance(target, TimeLog):
            over_time = target.kind != STEPPED_SINE.name  # a sine that had not settled is compared sample by sample
            misfit = float(own @ own) - own.size if over_time else np.inf
            yield _Piece(misfit, times[0], number, (0,), over_time)
        else:
            yield _Piece(float(own @ own), sum(times), number, tuple(range(len(times))))


def _duration(experiment: Experiment) -> float:
    return float(experiment.times[-1]) - experiment.start


def _part(target: Target, logs: list[int]) -> Target:
    if not isinstance(target, SteppedSines):
        return target
    runs = tuple(target.runs[i] for i in logs)
    return replace(target, logs=tuple(target.logs[i] for i in logs), runs=runs, reference=None)


def seen(ruler: Ruler, current: Fitted, laws: Sequence[Law]) -> dict[str, Array]:
    """Samples (n,) of every law's argument on the way of the fitted model through all of the ruler's runs."""
    names = tuple(dict.fromkeys(copy.argument for law in laws for copy in law.copies))
    runs = []
    for experiment in ruler.experiments(current.what.space.values(current.point.x)):
        times = np.linspace(experiment.start, experiment.times[-1], 2 + int(_duration(experiment) / _STEP))
        runs.append(replace(experiment, times=times, record=names))
    records = simulate_many(current.what.model, runs, solver=ruler.solver, workers=ruler.workers)
    found = {}
    for law in laws:
        parts = []
        for record in records:
            for copy in law.copies:
                values = record[copy.argument]
                parts.append(np.gradient(values, record.time) if law.of_rate else values)
        found[f"{law.slot}|{law.argument}"] = np.concatenate(parts)
    return found
