"""What a fit takes, from names and numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from pysim.diagnosis.adequacy import shortcomings
from pysim.identify.greybox import Measurements, Parameter, Problem, Tie, Treatment, problem
from pysim.io import in_model_units
from pysim.types import BadInput, Dataset, Model
from pysim.workflow.free import Bounds, free_parameters


def fit_problem(
    model: Model,
    datasets: Sequence[Dataset],
    *,
    free: Sequence[str] = (),
    bounds: Bounds | None = None,
    values: Mapping[str, float] | None = None,
    fixed: Mapping[str, float] | None = None,
    starts: Mapping[str, float] | None = None,
    ties: Sequence[Tie] = (),
    outputs: Sequence[str] = (),
    reference_hz: float | None = None,
) -> Problem:
    """A model beside data sets, with the parameters to fit.

    Args:
        free: parameters to fit; all to which the model gives min, max and nominal and that are not set by default.
        bounds: parameter -> lower and upper bound in its unit, in place of the model's; frees it too.
        values: of parameters, in their units: where those that are fitted begin, and what all others are.
        fixed: of parameters that are not fitted; wins over `values`.
        starts: of parameters that are fitted; wins over `values`.
        ties: parameters that follow fitted ones.
        outputs: to compare; all that are measured by default.
        reference_hz: whose gain counts as 0 dB in responses; None for absolute gains.
    Raises:
        BadInput: no parameter to fit, a start or bounds of one that is not fitted, logs in none of which an input
            moves, or what `problem` refuses.
    """
    bounds, values, held = bounds or {}, values or {}, fixed or {}
    tied = [tie.name for tie in ties]
    names = [name for name in free_parameters(model, free, bounds, {**values, **held}) if name not in tied]
    begin = {name: value for name, value in values.items() if name in names} | dict(starts or {})
    rest = {name: value for name, value in values.items() if name not in (*names, *tied)} | dict(held)
    for name in (*begin, *bounds):
        if name not in names:
            raise BadInput(f"{name} has a start or bounds but is not free; add it to --free, or use --set")
    _refuse_still(datasets)
    data = [Measurements(in_model_units(one, model), outputs=tuple(outputs) or None) for one in datasets]
    parameters = [Parameter(name, begin.get(name), *bounds.get(name, (None, None))) for name in names]
    return problem(model, data, parameters, fixed=rest, ties=ties, treatment=Treatment(reference_hz=reference_hz))


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
