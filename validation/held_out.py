"""The error of a model on logs that nobody fitted it to, their initial states free."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from pysim.identify.greybox import Nuisance, NuisanceKind, Simulation, problem
from pysim.identify.greybox.beginning import settled_initial_states
from pysim.simulate import Esdirk
from pysim.types import BadInput, Dataset, Model
from pysim.types.answer import SensorError

FINE = Simulation(solver=Esdirk(rtol=1e-7, atol=1e-7))
"""A lightly damped swing of nine seconds comes out within a tenth of its encoder's step."""


def held_out_rms(
    model: Model,
    dataset: Dataset,
    values: Mapping[str, float],
    use: str = "test",
    simulation: Simulation = FINE,
    sensors: Sequence[SensorError] = (),
) -> dict[str, float]:
    """Root mean square residual of each signal over all logs of one use, in the signal's unit.

    Initial states are estimated from these logs themselves: they say where the plant stood, and nothing of its
    parameters.

    Args:
        values: parameters that differ from the model's own.
        use: of the logs to judge.
        sensors: their errors, as the model has them.
    Raises:
        BadInput: no log has that use, or the model cannot be simulated there.
    """
    records = tuple(replace(record, use="fit") for record in dataset.records if record.use == use)
    judged = problem(model, [replace(dataset, records=records)], (), fixed=values)
    known = tuple((Nuisance(NuisanceKind(one.kind), one.dataset, one.signal, 1.0), one.size) for one in sensors)
    residuals = replace(judged.residuals(simulation=simulation), known=known)
    found = settled_initial_states(residuals, judged.model, judged.space, np.zeros(0))
    if not found.good:
        raise BadInput(f"held-out logs of {model.name}: {found.failure}")
    sizes = np.sqrt(found.squares / residuals.samples)
    return {name: float(size) for (_, name), size in zip(residuals.channels, sizes, strict=True)}
