"""What a fit takes, from names and numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from pysim.diagnosis import Settings
from pysim.identify.adequacy import shortcomings
from pysim.identify.greybox import (
    NOISE,
    Effort,
    Objective,
    Parameter,
    Problem,
    Simulation,
    Tie,
    Treatment,
    fit,
    problem,
)
from pysim.identify.greybox.optimiser import Optimiser
from pysim.identify.greybox.search import Progress
from pysim.identify.greybox.settings import FitSettings
from pysim.io import in_model_units
from pysim.types import BadInput, Dataset, Fit, Model, Record
from pysim.types.dataset import INITIAL
from pysim.types.kinds import number_of
from pysim.workflow.free import Bounds, free_parameters

Initial = str | Mapping[str, float] | None  # "rest", "estimate", state -> value, or None as the data say


def fit_problem(
    model: Model,
    datasets: Sequence[Dataset],
    *,
    free: Sequence[str] = (),
    bounds: Bounds | None = None,
    priors: Bounds | None = None,
    values: Mapping[str, float] | None = None,
    fixed: Mapping[str, float] | None = None,
    starts: Mapping[str, float] | None = None,
    ties: Sequence[Tie] = (),
    reference_hz: float | None = None,
    initial: Initial = None,
    nothing_free: bool = False,
) -> Problem:
    """A model beside data sets, with the parameters to fit.

    Args:
        free: parameters to fit; all to which the model gives min, max and nominal and that are not set by default.
        bounds: parameter -> lower and upper bound in its unit, in place of the model's; frees it too.
        priors: fitted parameter -> mean and standard deviation of what is known of it beforehand, in its unit.
        values: of parameters, in their units: where those that are fitted begin, and what all others are.
        fixed: of parameters that are not fitted; wins over `values`.
        starts: of parameters that are fitted; wins over `values`.
        ties: parameters that follow fitted ones.
        reference_hz: whose gain counts as 0 dB in responses; None for absolute gains.
        initial: of the model at each log's first sample: "rest", as its equations come to it at the first input;
            "estimate", from each log; "model", as its start values say; state -> value; None as the data say, else
            near rest.
        nothing_free: the model is only compared as it is.
    Raises:
        BadInput: no parameter to fit, a start or bounds of one that is not fitted, logs in none of which an input
            moves, or what `problem` refuses.
    """
    bounds, values, held = bounds or {}, values or {}, dict(fixed or {})
    treatment = Treatment(reference_hz=reference_hz)
    if isinstance(initial, Mapping):
        held, treatment = held | initial_values(model, initial), replace(treatment, rest=None)
    datasets = [beginning(one, "rest" if isinstance(initial, Mapping) else initial) for one in datasets]
    tied = [tie.name for tie in ties]
    chosen = () if nothing_free else free_parameters(model, free, bounds, {**values, **held})
    names = [name for name in chosen if name not in tied]
    begin = {name: value for name, value in values.items() if name in names} | dict(starts or {})
    rest = {name: value for name, value in values.items() if name not in (*names, *tied)} | dict(held)
    for name in (*begin, *bounds):
        if name not in names:
            raise BadInput(f"{name} has a start or bounds but is not free; set it only, or add it to --free (free it)")
    if not nothing_free:
        _refuse_still(datasets)
    data = [in_model_units(one, model) for one in datasets]
    known, ends = priors or {}, {name: bounds.get(name, (None, None)) for name in names}
    parameters = [Parameter(n, begin.get(n), low, high, prior=known.get(n)) for n, (low, high) in ends.items()]
    return problem(model, data, parameters, fixed=rest, ties=ties, treatment=treatment)


def fitted(
    problem: Problem,
    *,
    objective: Objective = NOISE,
    optimiser: Optimiser | None = None,
    simulation: Simulation | None = None,
    effort: Effort | None = None,
    progress: Progress | None = None,
) -> Fit:
    """The fit of a problem, gone on with by ten times finer integrations, until one gains no more than ends a search.

    However small beside the noise, errors of the integration are the same in every sample, and so add up.

    Args:
        problem, objective, optimiser, simulation, effort, progress: as of `pysim.identify.greybox.fit`.
    Raises:
        BadInput: what that refuses.
    """
    simulation = simulation or Simulation()
    found = fit(
        problem, objective=objective, optimiser=optimiser, simulation=simulation, effort=effort, progress=progress
    )
    only = Effort(nominal=False, rough=False)  # an earlier log is of the rougher integration
    for _ in range(Settings().refinements):
        simulation = simulation.finer()
        here = np.array([found[key].value for key in problem.space.keys])
        problem = replace(problem, space=replace(problem.space, start=here))
        again = fit(problem, objective=objective, optimiser=optimiser, simulation=simulation, effort=only,
                    progress=_further(progress, found.iterations + 1))  # fmt: skip
        begun = {one.name: one.start for one in found.estimates}
        estimates = tuple(replace(one, start=begun[one.name]) for one in again.estimates)
        found = replace(again, estimates=estimates, starts=found.starts, start_cost=found.start_cost,
                        iterations=found.iterations + again.iterations)  # fmt: skip
        last = again.starts[0]  # in what its objective counts
        if last.first_cost - last.cost < FitSettings().tolerance:
            break
    return found


def _further(progress: Progress | None, tried: int) -> Progress | None:
    """Progress of a search that goes on after so many points."""
    return None if progress is None else lambda told: progress(told._replace(tried=tried + told.tried))


def beginning(dataset: Dataset, initial: str | None) -> Dataset:
    """The data set, of whose logs this is known at their first sample; as it is where None.

    Raises:
        BadInput: a word that is not known.
    """
    if initial is None:
        return dataset
    refuse_unknown(initial)
    records = (replace(one, initial=initial) if isinstance(one.data, Record) else one for one in dataset.records)
    return replace(dataset, records=tuple(records))


def refuse_unknown(initial: Initial) -> None:
    """Raise BadInput where that is neither one of the words, nor state -> value, nor None."""
    if not (initial is None or isinstance(initial, Mapping) or initial in INITIAL):
        raise BadInput(
            f"initial = {initial!r} is not known; write {' or '.join(map(repr, INITIAL))}, or state: value",
            argument="initial",
        )


def initial_values(model: Model, initial: Mapping[str, float]) -> dict[str, float]:
    """The same, once each is a state of the model.

    Raises:
        BadInput: one is not.
    """
    states = model.abilities.states
    for name in initial:
        if name not in states:
            raise BadInput(
                f"initial: {name} is no state of {model.label}; its states: {', '.join(states) or 'none'}",
                argument="initial",
            )
    return {name: number_of(value, "initial") for name, value in initial.items()}


def _refuse_still(datasets: Sequence[Dataset]) -> None:
    """Logs in none of which an input moves tell nothing of what moves."""
    refusals = []
    for dataset in datasets:
        if any(record.use == "fit" for record in dataset.records):
            try:
                shortcomings(dataset, ())
            except BadInput as error:
                refusals.append(error)
            else:
                return
    if refusals:
        raise refusals[0]
