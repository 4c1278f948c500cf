"""What the native loop keeps between two calls: the state of a run as a value."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

# How a run stands; above RUNNING in the order of pysim.types.Outcome.
RUNNING = -1
DONE, STEP_TOO_SMALL, NOT_FINITE, MODEL_ERROR, TERMINATED, TOO_MANY_STEPS, TOO_MANY_EVENTS = range(7)

RUN = np.dtype(
    [
        ("start", np.float64),  # s
        ("t", np.float64),  # s, last accepted point
        ("h", np.float64),  # s, step to try next
        ("error_before", np.float64),  # error norm of the last accepted step
        ("grid", np.int64),  # fixed step: number of the last grid point reached
        ("segment", np.int64),  # index of the next break
        ("horizon", np.float64),  # s, its time: inputs are smooth up to here
        ("next_event", np.float64),  # s, the model's next time event
        ("row", np.int64),  # next row to record
        ("status", np.int64),  # worst status the FMU returned when the run stopped
        ("crowd", np.int64),  # events since time last moved on
        ("steps", np.int64),
        ("rejected", np.int64),
        ("derivatives", np.int64),
        ("jacobians", np.int64),
        ("events", np.int64),
    ]
)

STATISTICS = ("steps", "rejected", "derivatives", "jacobians", "events")


class Control(NamedTuple):
    """Step rule, the part of a solver's settings that every method shares."""

    step: float  # s, fixed step; 0 where the error rules
    rtol: float  # of a state's magnitude
    atol: float  # of a state's nominal value
    max_step: float  # s
    max_steps: int


class Work(NamedTuple):
    """Arrays of one run; n states, m event indicators, s stages, d coefficients of the interpolant."""

    x: Any  # (n,) at run.t
    dx: Any  # (n,) derivative there
    x_new: Any  # (n,) at the end of the step
    x_try: Any  # (n,) where a stage or an interpolation looks
    k: Any  # (s + 1, n) stages; the last row is the derivative at the end of the step
    error: Any  # (n,)
    dense: Any  # (d, n) coefficients of theta, theta^2, ...
    nominal: Any  # (n,)
    z: Any  # (m,) event indicators at run.t
    z_new: Any  # (m,) at the end of the step
    z_try: Any  # (m,)
    jacobian: Any  # (n, n) d dx / d x; row per derivative
    matrix: Any  # (n, n) factorised
    pivots: Any  # (n,) int64
    slope: Any  # (n,) partial derivative of dx by time
    seed: Any  # (1,)
    state_references: Any  # (n,) uint32
    derivative_references: Any  # (n,) uint32
    flags: Any  # (32,) uint8, answers of the FMU
    time: Any  # (1,)


def new_work(n: int, m: int, stages: int, terms: int, references: Any, derivative_references: Any, implicit: bool) -> Work:
    """Arrays for a run, all zero."""
    square = n if implicit else 0
    return Work(
        x=np.zeros(n),
        dx=np.zeros(n),
        x_new=np.zeros(n),
        x_try=np.zeros(n),
        k=np.zeros((stages + 1, n)),
        error=np.zeros(n),
        dense=np.zeros((terms, n)),
        nominal=np.ones(n),
        z=np.zeros(m),
        z_new=np.zeros(m),
        z_try=np.zeros(m),
        jacobian=np.zeros((square, square)),
        matrix=np.zeros((square, square)),
        pivots=np.zeros(square, dtype=np.int64),
        slope=np.zeros(square),
        seed=np.ones(1),
        state_references=np.array(references, dtype=np.uint32),
        derivative_references=np.array(derivative_references, dtype=np.uint32),
        flags=np.zeros(4).view(np.uint8),
        time=np.zeros(1),
    )
