"""An FMU's right-hand side and Jacobian at points of its run: by an importer that evaluates, and by our differences.

A Jacobian has a row per derivative and a column per state, then per input. What is compared is scaled: columns by the
largest value the state or input takes, rows by the largest term in them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from pysim.fmu_check.instance import Instance, opened
from pysim.fmu_check.subject import MODEL_EXCHANGE, Subject, read_subject
from pysim.io import read_model
from pysim.simulate import Rodas, simulate
from pysim.types import Experiment, Signal
from validation.importers.exported import EXPORTED, Exported

Array = NDArray[np.float64]
_EVERY = 10  # communication points from one point to the next
_STEP = 1e-6  # of a difference, as a share of the largest value: its truncation and round-off are both near 1e-10


@dataclass(frozen=True)
class Points:
    """Where to evaluate: states (n, n_x), and inputs (n_u,) that are the same at all."""

    time: Array
    states: tuple[str, ...]
    inputs: Mapping[str, float]
    x: Array

    @property
    def u(self) -> Array:
        """Inputs (n_u,)."""
        return np.array(list(self.inputs.values()), dtype=np.float64)

    @property
    def scale(self) -> Array:
        """Largest value of each state, then of each input (n_x + n_u,); 1 where it is always 0."""
        largest = np.concatenate([np.abs(self.x).max(axis=0), np.abs(self.u)])
        return np.where(largest > 0.0, largest, 1.0)


@cache
def points(name: str) -> Points:
    """States along the run of that FMU (FMI 2), by the native loop at tight tolerance."""
    exported = _by_name(name)
    model = read_model(exported.build(2))
    states = model.abilities.states
    inputs = {key: Signal.steps([0.0], [value]) for key, value in exported.inputs.items()}
    times = exported.times[::_EVERY]
    record = simulate(model, Experiment(times, states, inputs), solver=Rodas(rtol=1e-9, atol=1e-9))
    return Points(times, states, exported.inputs, record.values)


def by_differences(exported: Exported, fmi: int) -> Array:
    """Ours: derivatives, then their central differences, flat per point (n, n_x + n_x (n_x + n_u))."""
    there = points(exported.name)
    subject = read_subject(exported.build(fmi))
    inputs = _references(subject, there)
    with opened(subject, MODEL_EXCHANGE) as instance:
        instance.start(inputs, there.u)
        rows = []
        for x in there.x:
            columns = [_difference(instance, inputs, there, x, k) for k in range(there.scale.size)]
            rows.append(np.concatenate([_right(instance, inputs, x, there.u), np.column_stack(columns).ravel()]))
    return np.array(rows)


def _references(subject: Subject, there: Points) -> list[int]:
    reference = {variable.name: variable.valueReference for variable in subject.inputs}
    return [reference[name] for name in there.inputs]


def _right(instance: Instance, inputs: list[int], x: Array, u: Array) -> Array:
    instance.set_states(x)
    instance.set(inputs, u)
    return instance.dx


def _difference(instance: Instance, inputs: list[int], there: Points, x: Array, k: int) -> Array:
    """d dx / d (the k-th of states and inputs)."""
    point, step = np.concatenate([x, there.u]), _STEP * there.scale[k]
    both = []
    for sign in (1.0, -1.0):
        moved = point.copy()
        moved[k] += sign * step
        both.append(_right(instance, inputs, moved[: x.size], moved[x.size :]))
    return (both[0] - both[1]) / (2.0 * step)


def by_casadi(exported: Exported, fmi: int) -> Array:
    """The same by CasADi's FMU import: values by name, Jacobian by the FMU's own directional derivatives."""
    from validation.importers.casadi_import import imported

    there = points(exported.name)
    dae = imported(exported, fmi)
    if tuple(dae.x()) != there.states or tuple(dae.u()) != tuple(there.inputs):
        raise ValueError(f"states {dae.x()} and inputs {dae.u()} stand in another order than in the description")
    names, results = (["x", "u"], ["jac_ode_x", "jac_ode_u"]) if there.inputs else (["x"], ["jac_ode_x"])
    function = dae.create("partials", names, ["ode", *results])
    rows = []
    for x in there.x:
        dx, *parts = (np.array(value) for value in function(*(x, there.u)[: len(names)]))
        rows.append(np.concatenate([dx.ravel(), np.hstack(parts).ravel()]))
    return np.array(rows)


def apart(name: str, mine: Array, other: Array) -> tuple[float, float]:
    """Largest differences of derivatives, as a share of the largest each takes, and of scaled Jacobians."""
    there = points(name)
    n = there.x.shape[1]
    size = np.abs(mine[:, :n]).max(axis=0)
    derivatives = np.abs(other[:, :n] - mine[:, :n]) / np.where(size > 0.0, size, 1.0)
    a, b = (values[:, n:].reshape(-1, n, there.scale.size) * there.scale for values in (mine, other))
    largest = np.maximum(np.abs(a).max(axis=(0, 2)), np.finfo(float).tiny)
    return float(derivatives.max()), float((np.abs(a - b) / largest[None, :, None]).max())


def _by_name(name: str) -> Exported:
    return next(exported for exported in EXPORTED if exported.name == name)
