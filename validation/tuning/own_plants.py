"""The plants of both loops from our own model of the bench, linearised by the FMU's derivatives."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from pysim.control.tuning import Plant
from validation.load_circuit.case import LOAD, SUPPLY, WAYS, Way, at_working_point
from validation.load_circuit.linearised import Linear

Array = NDArray[np.float64]


def own_plants() -> Mapping[str, Plant]:
    """Load pressure (Pa) over the valve's command (1); speed (rad/s) over the pump's command (rad)."""
    model = at_working_point()
    pressure, _, _, speed = WAYS
    return {
        "load": _plant(model, pressure, LOAD, "Pa", "1"),
        "speed": _plant(model, speed, SUPPLY, "rad/s", "rad"),
    }


def off_the_model(model: Linear, way: Way, plant: Plant, omega: Array) -> float:
    """The largest difference of a plant and the linearised model at frequencies (n,) in rad/s, as a share."""
    exact = model.response((1j * omega).astype(np.complex128), way.kept, way.of, way.output) * way.scale
    return float(np.abs(plant.response(omega) / exact - 1).max())


def _plant(model: Linear, way: Way, sides: tuple[str, str], output: str, command: str) -> Plant:
    """The states that the thesis keeps, both sides of a circuit as the difference of their pressures.

    A circuit's sides are alike, so that their sum has no part in the difference; it would be a pole and a zero at 0.
    """
    rows = [model.states.index(name) for name in way.kept]
    a, b = model.a[np.ix_(rows, rows)], model.b[rows, model.inputs.index(way.of)] * way.scale
    c = np.array([way.output.get(name, 0.0) for name in way.kept])
    i, j = (way.kept.index(name) for name in sides)
    down, up = np.eye(len(rows)), np.eye(len(rows))
    down[i, j] = -1.0  # the difference d = p_i - p_j
    up[i, i], up[j, i] = 0.5, -0.5  # p_i = d / 2, p_j = -d / 2
    kept = [k for k in range(len(rows)) if k != j]
    down, up = down[kept], up[:, kept]
    return _ratio(down @ a @ up, down @ b, c @ up, way.name, command, output)


def _ratio(a: Array, b: Array, c: Array, name: str, command: str, output: str) -> Plant:
    """c (s - a)^-1 b: det(s - a + b c) is the sum of numerator and denominator.

    The numerator is a constant, as there is no zero in Eq. 5.14 and 5.28; the powers of s are what rounding leaves.
    """
    denominator = np.poly(a)
    gain = -float(c @ np.linalg.solve(a, b))
    return Plant((gain * denominator[-1],), tuple(denominator), name=name, input_unit=command, output_unit=output)
