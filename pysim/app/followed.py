"""One log beside the model, at whatever values its parameters have: a run each, so that curves follow a slider."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pysim.identify.greybox import Problem, Simulation
from pysim.identify.greybox.comparison import compared
from pysim.identify.greybox.parameters import ParameterSpace
from pysim.types import BadInput, Dataset, Model
from pysim.workflow import fit_problem

_POINTS = 800  # of a curve that moves


@dataclass(frozen=True)
class Followed:
    """What does not change while parameters do. What cannot be simulated is a `BadInput`.

    Args:
        problem: the model beside the log.
        states: where the log begins, estimated once.
        at: samples that are shown.
    """

    problem: Problem
    states: Mapping[int, Any] = field(repr=False)
    at: NDArray[np.intp] = field(repr=False)

    @classmethod
    def of(cls, model: Model, dataset: Dataset, number: int, values: Mapping[str, float]) -> Followed:
        """A log, by its number among those of the data set."""
        if not 0 <= number < len(dataset.logs()):
            raise BadInput("there is no such log; choose another one")
        log = replace(dataset.logs()[number], use="fit")
        problem = fit_problem(model, [replace(dataset, records=(log,))], values=values, nothing_free=True)
        found = compared(problem, np.zeros(0), Simulation())
        if not found.records:
            raise BadInput(f"{log.source} cannot be simulated with these values; change them")
        count = found.records[0].measured.time.size
        return cls(problem, found.states, np.unique(np.linspace(0, count - 1, _POINTS).astype(np.intp)))

    def curves(self, values: Mapping[str, float]) -> dict[str, Any]:
        """Names, units, time, measured, simulated and residual over noise per signal, and its root mean square."""
        held = replace(self.problem, space=ParameterSpace.held(values))
        found = compared(held, np.zeros(0), Simulation(), self.states)
        if not found.records:
            raise BadInput("the model cannot be simulated with these values; change them")
        one = found.records[0]
        left = (one.measured.values - one.simulated.values) / np.array(one.noise)
        return {
            "names": one.measured.names, "units": one.measured.units, "time": one.measured.time[self.at],
            "measured": one.measured.values[self.at].T, "simulated": one.simulated.values[self.at].T,
            "left": left[self.at].T, "rms": np.sqrt(np.nanmean(left**2, axis=0)).tolist(),
        }  # fmt: skip
