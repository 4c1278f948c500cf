"""What can be said without running the FMU: its description against schema and rules, by FMPy's validation."""

from __future__ import annotations

from collections.abc import Iterator

from fmpy.validation import validate_fmu

from pysim.fmu_check.result import CheckResult, none_of
from pysim.fmu_check.subject import Subject

NAME = "description"


def check_description(subject: Subject) -> Iterator[CheckResult]:
    """modelDescription.xml: schema, names, units, start values, model structure."""
    problems = [" ".join(problem.split()) for problem in validate_fmu(str(subject.path))]
    yield none_of(NAME, "modelDescription.xml keeps FMI's rules (FMPy)", problems)
    low = [v.name for v in subject.reals if _outside(v.start, v.min, v.max)]
    yield none_of(NAME, "start values are within min and max", low)


def _outside(start: str | None, low: str | None, high: str | None) -> bool:
    if start in (None, ""):
        return False
    value = float(str(start))
    return (low not in (None, "") and value < float(str(low))) or (high not in (None, "") and value > float(str(high)))
