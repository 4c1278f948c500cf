"""The FMU under test: its unpacked folder and its variables by what they are for."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from fmpy.model_description import ModelDescription, ModelVariable, read_model_description
from numpy.typing import NDArray

from pysim.io import extracted, read_model
from pysim.types import BadInput

Array = NDArray[np.float64]
MODEL_EXCHANGE, CO_SIMULATION = "me", "cs"
_REAL = ("Real", "Float64")
_LONGEST = 2000  # communication steps in one run


def _silent() -> None:
    """Nobody waits for a sign of life."""


@dataclass(frozen=True)
class Subject:
    """Only scalar real variables are looked at; whole numbers, texts and arrays keep their start values.

    Args:
        path: of the file.
        folder: where it is unpacked.
        description: what it says of itself.
        alive: called whenever the FMU has answered, as a check of a large one takes long.
    """

    path: Path
    folder: Path
    description: ModelDescription
    alive: Callable[[], None] = _silent

    @property
    def fmi(self) -> int:
        """2 or 3."""
        return int(self.description.fmiMajorVersion)

    @cached_property
    def kinds(self) -> tuple[str, ...]:
        """What the FMU offers of "me" and "cs"."""
        offers = ((MODEL_EXCHANGE, self.description.modelExchange), (CO_SIMULATION, self.description.coSimulation))
        return tuple(kind for kind, interface in offers if interface is not None)

    @cached_property
    def reals(self) -> tuple[ModelVariable, ...]:
        """Every real scalar but time."""
        return tuple(
            v
            for v in self.description.modelVariables
            if v.type in _REAL and not v.dimensions and v.causality != "independent"
        )

    @cached_property
    def states(self) -> tuple[ModelVariable, ...]:
        """In the order of the state vector.

        Raises:
            BadInput: a derivative does not say of which state, or one is an array; nothing of it can be run then.
        """
        found = tuple(unknown.variable.derivative for unknown in self.description.derivatives)
        if None in found:
            name = self.derivatives[found.index(None)].name
            raise BadInput(f"{name} stands among the derivatives without the attribute derivative: of which state?")
        array = next((state.name for state in found if state.dimensions), None)
        if array is not None:
            raise BadInput(f"{array} is an array; only scalar states are tried here")
        return found

    @cached_property
    def derivatives(self) -> tuple[ModelVariable, ...]:
        """Of the states, in their order."""
        return tuple(unknown.variable for unknown in self.description.derivatives)

    @cached_property
    def parameters(self) -> tuple[ModelVariable, ...]:
        """Real parameters a user may set."""
        return tuple(v for v in self.reals if v.causality == "parameter" and v.variability in ("fixed", "tunable"))

    @cached_property
    def inputs(self) -> tuple[ModelVariable, ...]:
        """Continuous inputs."""
        return self._continuous("input")

    @cached_property
    def outputs(self) -> tuple[ModelVariable, ...]:
        """Continuous outputs."""
        return self._continuous("output")

    @cached_property
    def shown(self) -> tuple[ModelVariable, ...]:
        """What a run is judged by: outputs and states; every continuous variable where there are none."""
        chosen = {v.name: v for v in (*self.outputs, *self.states)}
        return tuple(chosen.values()) or tuple(v for v in self.reals if v.variability in (None, "continuous"))

    @property
    def has_events(self) -> bool:
        """Whether there are event indicators."""
        return bool(self.description.numberOfEventIndicators or getattr(self.description, "eventIndicators", None))

    @cached_property
    def stop(self) -> float:
        """s, of the default experiment as far as it is not too long; 1 s where there is none."""
        experiment = self.description.defaultExperiment
        stop = float(experiment.stopTime) if experiment is not None and experiment.stopTime else 1.0
        start = self.start
        return min(stop, start + _LONGEST * self.step) if stop > start else start + 1.0

    @cached_property
    def start(self) -> float:
        """s."""
        experiment = self.description.defaultExperiment
        return float(experiment.startTime) if experiment is not None and experiment.startTime else 0.0

    @cached_property
    def step(self) -> float:
        """s: the smallest communication step to be used; the FMU's own where it names one."""
        experiment = self.description.defaultExperiment
        if experiment is not None and experiment.stepSize:
            return float(experiment.stepSize)
        length = float(experiment.stopTime) - self.start if experiment is not None and experiment.stopTime else 1.0
        return (length if length > 0 else 1.0) / 400

    def _continuous(self, causality: str) -> tuple[ModelVariable, ...]:
        return tuple(v for v in self.reals if v.causality == causality and v.variability in (None, "continuous"))

    def excitation(self, share: float = 0.2) -> Array:
        """Values of the inputs (n_inputs,) off their starts by a share of their range, or of their nominal value."""
        return moved(self.inputs, np.array([number(v.start) for v in self.inputs]), share)


def read_subject(path: Path, alive: Callable[[], None] = _silent) -> Subject:
    """Unpack an FMU, one whose description is at fault too.

    Args:
        alive: called whenever it has answered.
    Raises:
        BadInput: no such file, or no FMU of FMI 2 or 3.
    """
    model = read_model(path, faulty=True)
    return Subject(model.path, extracted(model.path), read_model_description(str(model.path), validate=False), alive)


def references(variables: Sequence[ModelVariable]) -> list[int]:
    """Value references."""
    return [v.valueReference for v in variables]


def number(text: object) -> float:
    """An attribute as a number, 0 where there is none."""
    return float(str(text)) if text not in (None, "") else 0.0


def limit(variable: ModelVariable, name: str) -> float | None:
    """The attribute min, max or nominal, of the variable or of its declared type."""
    own = getattr(variable, name)
    if own in (None, "") and variable.declaredType is not None:
        own = getattr(variable.declaredType, name, None)
    return None if own in (None, "") else float(own)


def sizes(variables: Sequence[ModelVariable], values: Array) -> Array:
    """How large each variable is: its value or its nominal value, whichever is larger."""
    nominal = np.array([abs(limit(v, "nominal") or 1.0) for v in variables])
    return np.maximum(np.abs(values), nominal) if len(variables) else np.zeros(0)


def moved(variables: Sequence[ModelVariable], values: Array, share: float) -> Array:
    """Values moved by a share of the range between min and max, or of the value's size, and kept inside min and max."""
    found = []
    for variable, value, size in zip(variables, values, sizes(variables, values), strict=True):
        low, high = limit(variable, "min"), limit(variable, "max")
        span = high - low if low is not None and high is not None else size
        step = share * span
        outside = (high is not None and value + step > high) or (low is not None and value + step < low)
        found.append(value - step if outside else value + step)
        if low is not None:
            found[-1] = max(found[-1], low)
        if high is not None:
            found[-1] = min(found[-1], high)
    return np.array(found)
