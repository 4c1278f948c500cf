"""Parameters that change nothing."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from fmpy.model_description import ModelVariable
from numpy.typing import NDArray

from pysim.fmu_check.instance import CallFailed, opened
from pysim.fmu_check.points import SEED, Points
from pysim.fmu_check.result import DOUBTFUL, CheckResult, none_of, skipped
from pysim.fmu_check.stepping import stepped
from pysim.fmu_check.subject import CO_SIMULATION, MODEL_EXCHANGE, Subject, moved, number, references

Array = NDArray[np.float64]
NAME = "parameters"
_MOST = 200  # parameters looked at
_DRAWS = 3  # surroundings in which a parameter may show: as declared, and with all others moved
_STEPS = 40  # of a run
_SHARES = (0.05, 0.5, 5.0)  # how far off the start points are: far enough to come to end stops


def check_effects(subject: Subject) -> Iterator[CheckResult]:
    """Each parameter moved by itself; first among declared values, then among others, as a factor of it may be zero."""
    claim = "every parameter has an effect"
    parameters = subject.parameters[:_MOST]
    if not parameters:
        yield skipped(NAME, claim, "there are no real parameters")
        return
    start = np.array([number(v.start) for v in parameters])
    idle, hidden = list(range(len(parameters))), []
    for draw in range(_DRAWS):
        values = start if draw == 0 else _drawn(parameters, start, draw)
        before = _answer(subject, parameters, values)
        if before is None:
            continue
        showing = [k for k in idle if _shows(subject, parameters, values, k, before)]
        hidden += showing if draw else []
        idle = [k for k in idle if k not in showing]
        if not idle:
            break
    tried = f"{len(parameters)} of {len(subject.parameters)} tried"
    where = f"{tried}, in {_DRAWS} surroundings, at points near and far and in a run"
    yield none_of(NAME, claim, [parameters[k].name for k in idle], otherwise=DOUBTFUL, note=where)
    only = [parameters[k].name for k in hidden]
    yield none_of(NAME, "every parameter has an effect at the declared values of the others", only, otherwise=DOUBTFUL)


def _shows(subject: Subject, parameters: Sequence[ModelVariable], values: Array, k: int, before: Array) -> bool:
    other = values.copy()
    other[k] = moved([parameters[k]], values[k : k + 1], 0.1)[0]
    if other[k] == values[k]:
        return True  # its bounds leave it no room
    after = _answer(subject, parameters, other)
    return after is None or not np.array_equal(after, before, equal_nan=True)


def _drawn(parameters: Sequence[ModelVariable], start: Array, draw: int) -> Array:
    rng = np.random.default_rng(SEED + draw)
    shares = rng.uniform(0.02, 0.3, start.size)
    return np.array([moved([p], start[k : k + 1], shares[k])[0] for k, p in enumerate(parameters)])


def _answer(subject: Subject, parameters: Sequence[ModelVariable], values: Array) -> Array | None:
    """All that can be seen with these values: starts, derivatives and outputs at points, and a run; None if refused."""
    rows = references(parameters)
    others = references([v for v in subject.reals if v.causality != "parameter" and v.variability != "constant"])
    seen: list[Array] = []
    try:
        if MODEL_EXCHANGE in subject.kinds:
            with opened(subject, MODEL_EXCHANGE) as instance:
                points = Points(subject, instance.start(rows, values))
                seen.append(instance.get(others))
                for at in (point for share in _SHARES for point in points.around(2, share)):
                    seen += [points.values(at), instance.indicators()]
        if CO_SIMULATION in subject.kinds:
            with opened(subject, CO_SIMULATION) as instance:
                instance.start(rows, values)
                size = (subject.stop - subject.start) / _STEPS
                seen.append(stepped(subject, instance, others, size, _STEPS, subject.excitation()).ravel())
    except CallFailed:
        return None
    return np.concatenate(seen)
