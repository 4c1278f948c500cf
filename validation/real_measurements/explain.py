"""Fit each hypothesis to the published responses."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import fmu_build
from pysim.effects import STANDARD_LIBRARY, variant
from pysim.identify.greybox import Effort, GaussNewton, Parameter, fit, problem
from pysim.io import read_model
from pysim.thesis import CLASSES, pump_model
from pysim.types import Dataset, Fit, Model
from validation.real_measurements.hypotheses import LOCKED, Hypothesis, hypotheses

# A known number's fit starts where it stands and this much to either side: the valley between is long and bent.
_FACTORS = (1.0,)
# Points of a search at most; what is gained later is below the reference's own error.
_POINTS = 40


@dataclass(frozen=True)
class Explained:
    """One hypothesis at its best.

    Args:
        misfit: root mean square of deviations over the reference's own misfit; 1 is as good as the reference.
        passes: tests of nine within Table 1.3.
        changed: what was freed or added, by name, in SI units.
        bent: parameters at a bound.
    """

    hypothesis: Hypothesis
    misfit: float
    passes: int
    changed: Mapping[str, float]
    bent: tuple[str, ...]
    fit: Fit

    def __str__(self) -> str:
        changed = ", ".join(f"{name} = {value:.4g}" for name, value in self.changed.items())
        bent = f"; at a bound: {', '.join(self.bent)}" if self.bent else ""
        name = self.hypothesis.name
        return f"{name:18} misfit {self.misfit:.2f}, {self.passes} of 9 tests pass; {changed or '-'}{bent}"


def explain(dataset: Dataset, wanted: Callable[[Hypothesis], bool] = lambda h: True) -> Iterator[Explained]:
    """Every hypothesis, the locked model first; the others start where that ended, and at the thesis' values."""
    locked = pump_model("locked")
    known = {v.name: v.start for v in locked.variables if v.causality == "parameter" and v.start is not None}
    start: dict[str, float] = {}
    for hypothesis in hypotheses(known):
        if hypothesis.kind != "as it is" and not wanted(hypothesis):
            continue
        one = explained(hypothesis, dataset, locked, start)
        start = start or {e.name: e.value for e in one.fit.estimates}
        yield one


def explained(hypothesis: Hypothesis, dataset: Dataset, locked: Model, start: Mapping[str, float]) -> Explained:
    """Fit one hypothesis.

    Args:
        start: values to start from; what the model says where there are none.
    """
    model, own = locked, hypothesis.freed
    if hypothesis.effect is not None:
        model, place = _with(hypothesis)
        strengths = {p.name for p in hypothesis.effect.strengths}
        own = tuple(
            Parameter(f"{place}.{p.name}", 0.3 * p.nominal if p.name in strengths else None, p.min, p.max)
            for p in hypothesis.effect.parameters
        )
    names = {parameter.name for parameter in own}
    usual = [Parameter(name, start.get(name)) for name in LOCKED if name not in names]
    fits = []
    for factor in _FACTORS if hypothesis.kind == "known number" else (1.0,):
        moved = [replace(one, start=None if one.start is None else factor * one.start) for one in own]
        task = problem(model, [dataset], [*usual, *moved], ties=hypothesis.ties)
        fits.append(fit(task, optimiser=GaussNewton(max_iterations=_POINTS), effort=Effort(nominal=factor == 1.0)))
    found = min(fits, key=lambda one: one.cost)
    values = {e.name: e.value for e in found.estimates}
    residuals = sum(2 * r.comparison.measured.frequency.size - 1 for r in found.responses)
    return Explained(
        hypothesis,
        math.sqrt(2 * found.cost / residuals),  # half their sum of squares: tables have known levels
        sum(r.comparison.passes for r in found.responses),
        {name: values[name] for name in values if name in names},
        tuple(e.name for e in found.estimates if e.at),
        found,
    )


def _with(hypothesis: Hypothesis) -> tuple[Model, str]:
    assert hypothesis.effect is not None
    name = "LockedWithEffect"
    made = variant(CLASSES["locked"], [hypothesis.effect], [STANDARD_LIBRARY], name=name)
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / f"{name}.mo"
        source.write_text(made.text, encoding="utf-8")
        built = fmu_build.build(name, libraries=[STANDARD_LIBRARY, source])
    return read_model(built), made.places[hypothesis.effect.name]
