"""A saved state that is restored gives the same run again, bit for bit."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pysim.fmu_check.instance import opened
from pysim.fmu_check.points import Points
from pysim.fmu_check.result import CheckResult, none_of, skipped
from pysim.fmu_check.stepping import stepped
from pysim.fmu_check.subject import CO_SIMULATION, MODEL_EXCHANGE, Subject, references

NAME = "restore"
_STEPS = 10


def check_restore(subject: Subject) -> Iterator[CheckResult]:
    """Both kinds, and the state as bytes where it can be written."""
    for kind, try_out in ((CO_SIMULATION, _run_again), (MODEL_EXCHANGE, _point_again)):
        claim = f"a restored state gives the same again ({kind})"
        interface = subject.description.coSimulation if kind == CO_SIMULATION else subject.description.modelExchange
        if interface is None or not interface.canGetAndSetFMUstate:
            yield skipped(NAME, claim, "no such kind" if interface is None else "the FMU cannot save its state")
            continue
        yield none_of(NAME, claim, try_out(subject, as_bytes=False))
        if interface.canSerializeFMUstate:
            yield none_of(NAME, f"so does one that was written as bytes ({kind})", try_out(subject, as_bytes=True))


def _run_again(subject: Subject, *, as_bytes: bool) -> list[str]:
    """Shown variables that differ in the second run."""
    rows, size = references(subject.shown), (subject.stop - subject.start) / (4 * _STEPS)
    with opened(subject, CO_SIMULATION) as instance:
        instance.start()
        stepped(subject, instance, rows, size, _STEPS, subject.excitation())
        state = instance.save()
        runs = []
        for _ in range(2):
            runs.append(stepped(subject, instance, rows, size, _STEPS, subject.excitation(0.3), _STEPS))
            if as_bytes:
                state = instance.raw.deserializeFMUState(instance.raw.serializeFMUState(state))
            instance.restore(state)
    differs = np.any((runs[0] != runs[1]) & ~np.isnan(runs[0]), axis=0)
    return [v.name for v, other in zip(subject.shown, differs, strict=True) if other]


def _point_again(subject: Subject, *, as_bytes: bool) -> list[str]:
    """States, derivatives and outputs that are not what they were."""
    with opened(subject, MODEL_EXCHANGE) as instance:
        points = Points(subject, instance.start())
        here, there = points.around(2, 0.05)
        before = np.concatenate([points.values(here), instance.x])
        state = instance.save()
        points.values(there)
        if as_bytes:
            state = instance.raw.deserializeFMUState(instance.raw.serializeFMUState(state))
        instance.restore(state)
        after = np.concatenate([instance.get(references(points.unknowns)), instance.x])
    names = [*(v.name for v in points.unknowns), *(v.name for v in subject.states)]
    return [name for name, a, b in zip(names, before, after, strict=True) if a != b and not (a != a and b != b)]
