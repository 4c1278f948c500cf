"""What the loop does over time, under the sampled controller itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.control.pi import PI
from pysim.control.tuning.plant import Plant
from pysim.types import BadInput

Array = NDArray[np.float64]

_OFF = 1e100  # an answer beyond that has gone off; its squares overflow


@dataclass(frozen=True)
class LoopResponse:
    """To a step of the reference by 1, or of a disturbance at the plant's input by 1.

    Args:
        time: (n,) s.
        output: (n,) in the plant's output unit.
        command: (n,) of the controller.
    """

    time: Array
    output: Array
    command: Array


def loop_response(
    plant: Plant,
    K_p: float,
    T_i: float,
    *,
    dt: float,
    stop: float,
    reference: float = 1.0,
    disturbance: float = 0.0,
    parts: int = 1,
) -> LoopResponse:
    """Plant, exactly discretised, under the difference equation of the PI controller.

    A plant that answers at once, in part or whole, is looked at just before its input changes, as a card reads before
    it writes. Its dead time counts in full, also where it ends within a step.

    Args:
        dt: s between the controller's steps.
        stop: s; a loop that has gone off to beyond 1e100 ends there.
        reference, disturbance: steps at time 0, the latter added to the command, and so ahead of the dead time.
        parts: of dt, at whose ends the plant is looked at.
    Raises:
        BadInput: times or parts that are not positive.
    Source: thesis Eq. 5.33.
    """
    if not 0 < dt < stop < np.inf:
        raise BadInput(f"loop response: dt = {dt:g} s and stop = {stop:g} s; give 0 < dt < stop")
    if parts < 1:
        raise BadInput(f"loop response: {parts} parts of a step of {dt:g} s; give 1 or more")
    fine = dt / parts
    held = sampled(plant, fine)
    controller = PI(K_p, T_i, dt)
    # the error before the step is zero, so that the step itself passes the gain as well
    controller.step(0.0, (0.0, 0.0, 0.0, 1.0))
    count, lag = round(stop / dt) * parts + 1, held.lag
    x, output, command, u = np.zeros(held.A.shape[0]), np.zeros(count), np.zeros(count + lag), 0.0
    driven = 0.0
    for k in range(count):
        output[k] = held.C @ x + held.D * driven
        if not abs(output[k]) < _OFF:
            count = k
            break
        if k % parts == 0:
            (u,) = controller.step(k * fine, (reference, output[k], 0.0, 1.0))
        command[k + lag] = u
        before, driven = driven, command[k] + disturbance * (k >= lag)
        x = held.A @ x + held.late * before + held.B * driven
    return LoopResponse(np.arange(count, dtype=np.float64) * fine, output[:count], command[lag : lag + count])


@dataclass(frozen=True)
class Sampled:
    """x(k+1) = A x(k) + late u(k-lag-1) + B u(k-lag), y(k) = C x(k) + D u(k-lag-1): a plant whose input is held.

    Args:
        A, late, B, C, D: (n, n), (n,), (n,), (n,), scalar.
        lag: whole steps of the dead time; within the next one the input changes.
    """

    A: Array
    late: Array
    B: Array
    C: Array
    D: float
    lag: int


def sampled(plant: Plant, dt: float) -> Sampled:
    """A plant, exactly discretised, its states in a time scaled to its poles."""
    from scipy.linalg import expm  # 0.2 s to import

    order = len(plant.denominator) - 1
    scale = max(float(np.abs(plant.poles()).max(initial=0.0)), 1e-12 / dt)
    powers = scale ** np.arange(order + 1)
    denominator = np.asarray(plant.denominator) / plant.denominator[0] / powers
    padded = np.zeros(order + 1)
    padded[order + 1 - len(plant.numerator) :] = plant.numerator
    numerator = padded / plant.denominator[0] / powers
    system = np.zeros((order + 1, order + 1))
    system[:order, :order] = np.eye(order, k=-1)
    system[:1, :order] = -denominator[1:]
    system[0, order] = 1.0
    lag = int(round(plant.delay / dt, 9))  # dead time that near to whole steps is of whole steps
    rest = max(plant.delay / dt - lag, 0.0)
    first, then = (expm(system * (scale * dt * part)) for part in (rest, 1.0 - rest))
    A, B = then[:order, :order], then[:order, order]
    C, D = numerator[1:] - numerator[0] * denominator[1:], float(numerator[0])
    return Sampled(A @ first[:order, :order], A @ first[:order, order], B, C, D, lag)
