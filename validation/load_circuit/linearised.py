"""A model linearised about a state by the FMU's own directional derivatives."""

from __future__ import annotations

import ctypes
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Model
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Linear:
    """d x/dt = A x + B u of the states and inputs named."""

    states: tuple[str, ...]
    inputs: tuple[str, ...]
    a: Array  # (n_x, n_x)
    b: Array  # (n_x, n_u)

    def response(self, s: Complex, kept: Sequence[str], input_name: str, output: Mapping[str, float]) -> Complex:
        """Transfer function (n,) with the `kept` states alone, all others held; output as weights of states."""
        rows = [self.states.index(name) for name in kept]
        a = self.a[np.ix_(rows, rows)]
        b = self.b[rows, self.inputs.index(input_name)]
        c = np.array([output.get(name, 0.0) for name in kept])
        systems = s[:, None, None] * np.eye(len(rows)) - a
        return np.linalg.solve(systems, np.broadcast_to(b[:, None], (s.size, b.size, 1)))[..., 0] @ c


def linearised(path: Path, states: Mapping[str, float], inputs: Mapping[str, float]) -> Linear:
    """Of an FMI 2 FMU at a state (others at their start values) and inputs."""
    description = read_model_description(path)
    folder = extract(path)
    model = FMU2Model(
        guid=description.guid,
        unzipDirectory=folder,
        modelIdentifier=description.modelExchange.modelIdentifier,
        instanceName="linearised",
    )
    try:
        model.instantiate()
        model.setupExperiment()
        model.enterInitializationMode()
        model.exitInitializationMode()
        references = {variable.name: variable.valueReference for variable in description.modelVariables}
        derivatives = [item.variable for item in description.derivatives]
        names = tuple(variable.derivative.name for variable in derivatives)
        start = dict(zip(names, model.getReal([references[name] for name in names]), strict=True))
        model.setReal([references[name] for name in inputs], list(inputs.values()))
        model.enterContinuousTimeMode()
        values = np.array([states.get(name, start[name]) for name in names], dtype=np.float64)
        model.setContinuousStates(values.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), values.size)
        slopes = [item.valueReference for item in derivatives]
        columns = [model.getDirectionalDerivative(slopes, [references[name]], [1.0]) for name in (*names, *inputs)]
        model.terminate()
        model.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    both = np.array(columns).T
    return Linear(names, tuple(inputs), both[:, : len(names)], both[:, len(names) :])
