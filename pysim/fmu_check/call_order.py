"""Calls that FMI forbids: they have to end in an error, and never in a crash."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator, Mapping
from functools import partial

from pysim.fmu_check.instance import CallFailed, Instance, opened
from pysim.fmu_check.result import DOUBTFUL, HOLDS, CheckResult, skipped
from pysim.fmu_check.subject import CO_SIMULATION, MODEL_EXCHANGE, Subject

NAME = "call order"
_UNKNOWN = 0x7FFFFFF0  # a value reference nobody has
Abuse = Callable[[Instance], object]


def _states(instance: Instance) -> None:
    n = max(1, len(instance.subject.states))
    instance.raw.setContinuousStates((ctypes.c_double * n)(), n)


def _started(call: Abuse) -> Abuse:
    return lambda instance: call(instance.start())


def _ended(call: Abuse) -> Abuse:
    def abuse(instance: Instance) -> None:
        instance.start().raw.terminate()
        call(instance)

    return abuse


def _null(instance: Instance) -> None:
    prefix, kind, more = ("fmi2", "Real", ()) if instance.subject.fmi == 2 else ("fmi3", "Float64", (1,))
    getattr(instance.raw, f"{prefix}Get{kind}")(instance.raw.component, None, 1, None, *more)


def _no_instance(instance: Instance) -> None:
    getattr(instance.raw, f"fmi{instance.subject.fmi}Terminate")(None)


# Words for the call -> the call; before each, the instance has only been made. The values are legal C.
ABUSES: Mapping[str, Mapping[str, Abuse]] = {
    MODEL_EXCHANGE: {
        "states set before initialisation": _states,
        "derivatives asked for before initialisation": lambda i: i.dx,
        "continuous time entered before initialisation": lambda i: i.raw.enterContinuousTimeMode(),
        "initialisation left before it was entered": lambda i: i.raw.exitInitializationMode(),
        "initialisation entered twice": _started(lambda i: i.begin()),
        "an unknown value reference": _started(lambda i: i.get([_UNKNOWN])),
        "null pointers for a value": _started(_null),
        "no instance at all": _no_instance,
        "time set after the end": _ended(lambda i: i.raw.setTime(1.0)),
        "terminated twice": _ended(lambda i: i.raw.terminate()),
    },
    CO_SIMULATION: {
        "a step before initialisation": lambda i: i.raw.doStep(i.subject.start, i.subject.step),
        "initialisation left before it was entered": lambda i: i.raw.exitInitializationMode(),
        "initialisation entered twice": _started(lambda i: i.begin()),
        "a step backwards": _started(lambda i: i.raw.doStep(i.subject.start, -i.subject.step)),
        "an unknown value reference": _started(lambda i: i.get([_UNKNOWN])),
        "null pointers for a value": _started(_null),
        "a step after the end": _ended(lambda i: i.raw.doStep(i.subject.start, i.subject.step)),
    },
}


def abuse_checks() -> dict[str, Callable[[Subject], Iterator[CheckResult]]]:
    """A check per forbidden call, so that a crash tells which it was."""
    return {
        f"{NAME}: {words} ({kind})": partial(_refused, kind, words, call)
        for kind, calls in ABUSES.items()
        for words, call in calls.items()
    }


def _refused(kind: str, words: str, call: Abuse, subject: Subject) -> Iterator[CheckResult]:
    claim = f"{words} ({kind}) is refused"
    if kind not in subject.kinds:
        yield skipped(NAME, claim, "the FMU does not offer it")
        return
    with opened(subject, kind) as instance:
        try:
            call(instance)
        except CallFailed:
            yield CheckResult(NAME, claim, HOLDS)
            return
    yield CheckResult(NAME, claim, DOUBTFUL, "the FMU says OK, so a mistake of its user goes unnoticed")
