"""Which tests a term is looked for in: those that show most of the misfit for the time they take."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.laws import Law
from pysim.diagnose.residuals import Ruler
from pysim.identify.greybox.evaluation import Evaluation
from pysim.identify.greybox.sine_target import SineTarget
from pysim.identify.greybox.target import Target
from pysim.simulate import Esdirk, Rodas, simulate_many
from pysim.types import Experiment

Array = NDArray[np.float64]

# Share of the simulated time that is run.
_SHARE = 0.22
# How strongly long tests are shunned: misfit over time to this power.
_POWER = 1.5
# A run with a term may take so many times the steps of the longest without: a term that drives a model wild is wrong.
_PATIENCE = 20
# Between two looks at a variable, s.
_STEP = 4e-3


def thinned(ruler: Ruler, point: Evaluation) -> Ruler:
    """A ruler of some of the runs: logs over time, and those stepped sines that show most of the misfit for their time.

    Args:
        point: of the ruler's own model, with its residuals.
    """
    rows = list(_pieces(ruler, point.residual))
    whole = sum(time for _, time, _, _ in rows)
    used, kept = 0.0, dict[int, list[int]]()
    for _, time, target, log in sorted(rows, key=lambda row: -row[0] / row[1] ** _POWER):
        if not kept or used + time <= _SHARE * whole:
            used += time
            kept.setdefault(target, []).append(log)
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


def _pieces(ruler: Ruler, residual: Array) -> Iterator[tuple[float, float, int, int]]:
    """Misfit beyond noise, simulated time, number of the target, number of the run in it."""
    rest = residual
    for number, (target, whitening) in enumerate(zip(ruler.targets, ruler.whitenings, strict=True)):
        own, rest = rest[: whitening.size], rest[whitening.size :]
        if not isinstance(target, SineTarget):
            times = [_duration(run.experiment) for run in target.runs]
            yield (np.inf, sum(times), number, 0) if len(times) == 1 else (float(own @ own), sum(times), number, -1)
            continue
        for log, run in enumerate(target.runs):
            part, own = own[: target.logs[log].harmonics.size], own[target.logs[log].harmonics.size :]
            yield float(part @ part) - part.size, _duration(run.experiment), number, log


def _duration(experiment: Experiment) -> float:
    return float(experiment.times[-1]) - experiment.start


def _part(target: Target, logs: list[int]) -> Target:
    if not isinstance(target, SineTarget):
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
