"""The free and the locked model fitted to Table 4.1 again, beside Tables 4.5 to 4.8."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from matplotlib.figure import Figure

from pysim.identify.greybox import FREQUENCY, NOISE, InteriorPoint, Objective, Parameter, fit, problem
from pysim.thesis import pump_model
from pysim.types import Dataset, Fit, FitOutcome
from validation.findings import Finding
from validation.fit_thesis import time_part
from validation.fit_thesis.time_part import LOCKED, NAMES, responses


@dataclass(frozen=True)
class Redone:
    """One of the thesis' models fitted with one objective; the cost of the thesis' own values by the same objective."""

    label: str
    objective: str
    thesis_cost: float
    fit: Fit

    def __str__(self) -> str:
        means = [[r.comparison.deviations[i].value for r in self.fit.responses] for i in range(4)]
        passes = sum(r.comparison.passes for r in self.fit.responses)
        lines = [
            f"{self.label}, {self.objective}: cost {self.fit.cost:.1f}, thesis' values {self.thesis_cost:.1f}; "
            f"{passes} of {len(self.fit.responses)} tests pass; means "
            + ", ".join(f"{sum(m) / len(m):.2f}" for m in means)
        ]
        lines += [f"  {e.name:8}{e.value:12.5g}  thesis {e.start:12.5g}  {e.at}" for e in self.fit.estimates]
        return "\n".join(lines)


def run() -> Iterator[Finding]:
    """Both models, both objectives, from the thesis' values."""
    done = []
    for label, objective in ((label, objective) for objective in (NOISE, FREQUENCY) for label in ("free", "locked")):
        one = redo(label, objective, responses())
        done.append(one)
        print(one, flush=True)
        yield Finding(
            f"{one.label}, {one.objective}: cost over that of the thesis' values", one.fit.cost / one.thesis_cost, 1, ""
        )
        yield Finding(
            f"{one.label}, {one.objective}: the search ended early", float(_ended_early(one.fit.outcome)), 0, ""
        )
    free, locked = (
        next(d for d in done if (d.label, d.objective) == (label, "frequency")) for label in ("free", "locked")
    )
    yield Finding("free set: its cost is below the locked one's by a factor of", free.fit.cost / locked.fit.cost, 1, "")
    yield from _passing(free, locked)
    yield from time_part.findings()


def pictures() -> Mapping[str, Figure]:
    """What the valve's log does to the locked model."""
    return {"The locked model by Eq. 2.26, over how many samples of the valve's log count.": time_part.picture()}


def redo(label: str, objective: Objective, dataset: Dataset) -> Redone:
    """Fit one model; the start is the thesis' result, so that no other optimum is mistaken for a better one."""
    model = pump_model(label)
    free = [name for name in NAMES if label == "free" or name not in LOCKED]
    task = problem(model, [dataset], [Parameter(name) for name in free])
    start = task.residuals(objective).evaluate(model, task.space, task.space.to_search(task.space.start))
    optimiser = None if objective.squares else InteriorPoint(tolerance=1e-3)
    return Redone(label, objective.name, start.cost, fit(task, objective=objective, optimiser=optimiser))


def _ended_early(outcome: FitOutcome) -> bool:
    return outcome not in (FitOutcome.CONVERGED,)


def _passing(free: Redone, locked: Redone) -> Iterator[Finding]:
    counts = {one.label: sum(r.comparison.passes for r in one.fit.responses) for one in (free, locked)}
    yield Finding("free set: tests that fail Table 1.3 (Table 4.8: 2 of 18)", 18.0 - counts["free"], 2, "")
