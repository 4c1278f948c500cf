"""Many instances in one process: none knows of another, and a reset forgets all."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from pysim.fmu_check.instance import CallFailed, Instance, opened
from pysim.fmu_check.points import Points
from pysim.fmu_check.result import DOUBTFUL, CheckResult, none_of, skipped
from pysim.fmu_check.stepping import stepped
from pysim.fmu_check.subject import CO_SIMULATION, MODEL_EXCHANGE, Subject, moved, number, references

Array = NDArray[np.float64]
NAME = "instances"
_STEPS, _MANY = 8, 50


def check_instances(subject: Subject) -> Iterator[CheckResult]:
    """Another instance with other parameters, states and inputs beside the first; the first after a reset; and many."""
    for kind in subject.kinds:
        interface = subject.description.modelExchange if kind == MODEL_EXCHANGE else subject.description.coSimulation
        if interface.canBeInstantiatedOnlyOncePerProcess:
            yield skipped(NAME, f"instances do not know each other ({kind})", "the FMU allows one instance per process")
            continue
        alone = _seen(subject, kind)
        beside = _seen(subject, kind, company=True)
        names = [name for name, a, b in zip(_names(subject), alone.T, beside.T, strict=True) if _differ(a, b)]
        yield none_of(NAME, f"instances do not know each other ({kind})", names)
        again = _after_reset(subject, kind)
        if again is None:
            yield CheckResult(NAME, f"a reset gives the first run again ({kind})", DOUBTFUL, "the FMU refuses to reset")
        else:
            names = [name for name, a, b in zip(_names(subject), alone.T, again.T, strict=True) if _differ(a, b)]
            yield none_of(NAME, f"a reset gives the first run again ({kind})", names)
    yield _many(subject)


def _names(subject: Subject) -> list[str]:
    return [v.name for v in (*subject.derivatives, *subject.outputs, *subject.states)]


def _differ(a: Array, b: Array) -> bool:
    return not np.array_equal(a, b, equal_nan=True)


def _seen(subject: Subject, kind: str, *, company: bool = False) -> Array:
    """What one instance shows (rows, n), alone or with another that does something else in between."""
    with opened(subject, kind, "first") as first:
        first.start()
        if not company:
            return _trace(subject, first, None)
        with opened(subject, kind, "second") as second:
            start = np.array([number(v.start) for v in subject.parameters])
            try:
                second.start(references(subject.parameters), moved(subject.parameters, start, 0.05))
            except CallFailed:  # these values together are none it can start from
                with opened(subject, kind, "third") as third:
                    return _trace(subject, first, third.start())
            return _trace(subject, first, second)


def _trace(subject: Subject, first: Instance, other: Instance | None) -> Array:
    rows = references((*subject.derivatives, *subject.outputs, *subject.states))
    if first.kind == MODEL_EXCHANGE:
        points, found = Points(subject, first), []
        company = Points(subject, other) if other is not None else None
        for at in points.around(_STEPS, 0.05):
            points.put(at)
            if company is not None:
                company.values(company.home + 0.3 * company.sizes)
            found.append(first.get(rows))
        return np.array(found)
    size, inputs = (subject.stop - subject.start) / (4 * _STEPS), subject.excitation()
    found = []
    for k in range(_STEPS):
        found.append(stepped(subject, first, rows, size, 1, inputs, k)[0])
        if other is not None:
            stepped(subject, other, rows, size, 1, subject.excitation(-0.2), k)
    return np.array(found)


def _after_reset(subject: Subject, kind: str) -> Array | None:
    """The trace of an instance that has lived before, with other values; None where it cannot be reset."""
    with opened(subject, kind) as instance:
        start = np.array([number(v.start) for v in subject.parameters])
        try:
            instance.start(references(subject.parameters), moved(subject.parameters, start, 0.05))
            _trace(subject, instance, None)
            instance.raw.reset()
            return _trace(subject, instance.start(), None)
        except CallFailed:
            return None


def _many(subject: Subject) -> CheckResult:
    kind = MODEL_EXCHANGE if MODEL_EXCHANGE in subject.kinds else CO_SIMULATION
    claim = f"{_MANY} instances can live at once, started and freed"
    interface = subject.description.modelExchange or subject.description.coSimulation
    if interface.canBeInstantiatedOnlyOncePerProcess:
        return skipped(NAME, claim, "the FMU allows one instance per process")
    living: list[Instance] = []
    try:
        for k in range(_MANY):
            living.append(Instance(subject, kind, f"number{k}"))
            living[-1].instantiate()
            living[-1].start()
    finally:
        for instance in living:
            instance.raw.freeInstance()
    return none_of(NAME, claim, [])
