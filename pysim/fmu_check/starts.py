"""Start values: those of the description are those in force, and those that are set are taken."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from fmpy.model_description import ModelVariable
from numpy.typing import NDArray

from pysim.fmu_check.instance import CallFailed, opened
from pysim.fmu_check.result import DOUBTFUL, CheckResult, none_of, skipped
from pysim.fmu_check.subject import Subject, moved, number, references

Array = NDArray[np.float64]
NAME = "start values"
_CLOSE = 1e-12  # relative; a start value goes through decimal text


def check_starts(subject: Subject) -> Iterator[CheckResult]:
    """All at once with their declared values; then one by one with another value."""
    variables = [v for v in subject.reals if _settable(v)]
    if not variables:
        yield skipped(NAME, "start values that are set are taken", "no real variable has a start value that can be set")
        return
    kind = subject.kinds[0]
    declared = np.array([number(v.start) for v in variables])
    found = _in_force(subject, kind, variables)
    other = [
        f"{v.name} is {value:g}, declared {start:g}"
        for v, value, start in zip(variables, found, declared, strict=True)
        if not _same(value, start)
    ]
    yield none_of(NAME, "start values of the description are in force after initialisation", other)
    ignored, refused = [], []
    for variable, start in zip(variables, declared, strict=True):
        wanted = moved([variable], np.array([start]), 0.05)
        try:
            value = _in_force(subject, kind, [variable], wanted)
        except CallFailed:
            refused.append(variable.name)
            continue
        if not _same(value[0], wanted[0]):
            ignored.append(f"{variable.name} is {value[0]:g} after {wanted[0]:g} was set")
    yield none_of(NAME, "start values that are set are taken", ignored, note=f"{len(variables)} variables tried")
    yield none_of(NAME, "start values a little off the declared ones can be set", refused, otherwise=DOUBTFUL)


def _in_force(
    subject: Subject, kind: str, variables: Sequence[ModelVariable], given: Sequence[float] | Array = ()
) -> Array:
    """Values (n,) after initialisation; of discrete variables before its end, as the first event may change them.

    Args:
        given: what the variables are set to before (n,); by default nothing is set.
    """
    rows = references(variables)
    with opened(subject, kind) as instance:
        instance.begin(rows if len(given) else (), given)
        before = instance.get(rows)
        instance.finish()
        return np.where([v.variability == "discrete" for v in variables], before, instance.get(rows))


def _settable(variable: ModelVariable) -> bool:
    """Whether the value that is set before initialisation has to be there behind it."""
    if variable.start in (None, "") or variable.variability == "constant":
        return False
    return variable.causality in ("parameter", "input") or variable.initial == "exact"


def _same(a: float, b: float) -> bool:
    return bool(abs(a - b) <= _CLOSE * max(abs(a), abs(b)))
