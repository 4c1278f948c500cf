"""What is simulated: our models that run by themselves, and the FMUs of others in a folder."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy import read_model_description
from numpy.typing import NDArray

from pysim.types import Model
from validation.examples.catalogue import Example, examples
from validation.examples.runs import built, columns

Array = NDArray[np.float64]

FOLDER = "FOREIGN_FMUS"  # environment variable: a folder with model-exchange FMUs of others
ROW, HORIZON = 1e-4, 5.0  # s: rows that are compared, and how much of a run is
_TEXTS = ("String", "Binary", "Clock")
_NO_STOP = 1.0  # s, of an FMU that states no experiment


@dataclass(frozen=True)
class Subject:
    """One FMU and how long it runs, in s; `example` where it is one of our classes."""

    name: str
    stop: float
    example: Example | None = None
    file: Path | None = None

    def fmu(self) -> Path:
        """The archive. Raises BuildError, and LookupError where it needs a library that is not there."""
        if self.example is not None:
            return built(self.example)
        assert self.file is not None
        return self.file

    @property
    def times(self) -> Array:
        """(n_t,) s."""
        return np.arange(round(self.stop / ROW) + 1, dtype=np.float64) * ROW


def own() -> tuple[Subject, ...]:
    """Every model of the packages Examples and Validation, as far as two solvers go the same way."""
    return tuple(Subject(e.short, min(e.stop, e.limit.until or e.stop, HORIZON), example=e) for e in examples())


def foreign() -> tuple[Subject, ...]:
    """The FMUs of the folder that the environment names; none where it names none."""
    folder = os.environ.get(FOLDER)
    found = []
    for file in sorted(Path(folder).glob("*.fmu")) if folder else ():
        description = read_model_description(str(file), validate=False)
        if description.modelExchange is None:
            continue
        experiment = description.defaultExperiment
        stop = float(experiment.stopTime) if experiment is not None and experiment.stopTime else _NO_STOP
        found.append(Subject(f"{file.stem} (foreign)", min(stop, HORIZON), file=file))
    return tuple(found)


def recorded(model: Model) -> tuple[str, ...]:
    """What is compared: states, thinned out where there are many; without states what changes, outputs first of all."""
    numbers = (v.name for v in model.variables if v.causality == "output" and v.type not in _TEXTS)
    return columns(model) or tuple(numbers)
