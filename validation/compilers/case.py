"""The same Modelica by two compilers: what is the same in both FMUs has to move the same."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fmu_build import BuildError
from fmu_build.openmodelica import what_is_missing
from pysim.io import read_model
from pysim.types import Model
from validation.examples.catalogue import REFUSED, Example, examples
from validation.examples.runs import built, by_cosimulation, by_cvode, columns, off
from validation.findings import Finding

Array = NDArray[np.float64]

TOLERANCE = 1e-9  # of CVODE, on both FMUs
WIDER = 10.0  # times an example's own limit: accelerations and other rates swing more than the states stored there
COSIMULATION = 1e-3  # CVODE inside of OpenModelica's FMU at its default tolerance of 1e-6, ours at its own


def run() -> Iterator[Finding]:
    """Each example by both, where OpenModelica is there."""
    missing = what_is_missing()
    if missing:
        yield Finding("every example by both compilers", 0.0, 0.0, "", skipped=missing)
        return
    for example in examples():
        yield from compared(example)


def compared(example: Example) -> Iterator[Finding]:
    """Model exchange over all variables in common, and co-simulation over those that are stored."""
    try:
        theirs = built(example, "openmodelica")
        ours = built(example) if example.short not in REFUSED else None
    except LookupError as missing:
        yield Finding(example.short, 0.0, 0.0, "", skipped=str(missing))
        return
    except BuildError as error:
        yield Finding(f"{example.short} does not build: {error}", 1.0, 0.0, "")
        return
    if ours is None:
        yield _runs(example, theirs)
        return
    one, other = read_model(ours), read_model(theirs)
    names = common(one, other)
    lost = sorted(set(one.abilities.states) - set(names))
    yield Finding(f"{example.short}: states that OpenModelica's has not {', '.join(lost)}", len(lost), 0.0, "")
    limit = WIDER * example.limit.tolerance
    by_us, by_them = (by_cvode(fmu, example.times, names, TOLERANCE) for fmu in (ours, theirs))
    yield furthest(f"{example.short}, model exchange", by_us, by_them, one, limit)
    stored = tuple(name for name in columns(one) if name in names)
    by_us, by_them = (by_cosimulation(fmu, example.times, stored) for fmu in (ours, theirs))
    yield furthest(f"{example.short}, co-simulation", by_us, by_them, one, max(COSIMULATION, limit))


def common(one: Model, other: Model) -> tuple[str, ...]:
    """Continuous reals that both have by the same name and that are neither set nor time."""
    theirs = {variable.name for variable in other.variables if variable.type == "Real"}
    return tuple(
        variable.name
        for variable in one.variables
        if variable.type == "Real"
        and variable.variability == "continuous"
        and variable.causality in ("local", "output")
        and variable.name in theirs
    )


def furthest(claim: str, ours: Mapping[str, Array], theirs: Mapping[str, Array], model: Model, limit: float) -> Finding:
    """The variable that differs most."""
    differences = {name: off(theirs[name], ours[name], model[name].nominal) for name in ours}
    worst = max(differences, key=lambda name: np.nan_to_num(differences[name], nan=np.inf))
    return Finding(f"{claim}: {worst}, of {len(differences)}", differences[worst], limit, "of the span")


def _runs(example: Example, fmu: Path) -> Finding:
    """What our own compiler refuses at least runs."""
    model = read_model(fmu)
    names = columns(model)
    values = by_cvode(fmu, example.times, names, TOLERANCE)
    bad = [name for name in names if not np.isfinite(values[name]).all()]
    return Finding(f"{example.short} by OpenModelica alone: variables that are not finite", len(bad), 0.0, "")
