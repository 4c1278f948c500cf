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
    it writes.

    Args:
        dt: s between the controller's steps.
        stop: s; a loop that has gone off to beyond 1e100 ends there.
        reference, disturbance: steps at time 0, the latter added to the command, and so ahead of the dead time.
        parts: of dt, at whose ends the plant is looked at, and to which its dead time is rounded.
    Raises:
        BadInput: times or parts that are not positive.
    Source: thesis Eq. 5.33.
    """
    if not 0 < dt < stop < np.inf:
        raise BadInput(f"loop response: dt = {dt:g} s and stop = {stop:g} s; give 0 < dt < stop")
    if parts < 1:
        raise BadInput(f"loop response: {parts} parts of a step of {dt:g} s; give 1 or more")
    fine = dt / parts
    A, B, C, D = _sampled(plant, fine)
    controller = PI(K_p, T_i, dt)
    # the error before the step is zero, so that the step itself passes the gain as well
    controller.step(0.0, (0.0, 0.0, 0.0, 1.0))
    count, lag = round(stop / dt) * parts + 1, round(plant.delay / fine)
    x, output, command, u = np.zeros(A.shape[0]), np.zeros(count), np.zeros(count + lag), 0.0
    driven = 0.0
    for k in range(count):
        output[k] = C @ x + D * driven
        if not abs(output[k]) < _OFF:
            count = k
            break
        if k % parts == 0:
            (u,) = controller.step(k * fine, (reference, output[k], 0.0, 1.0))
        command[k + lag] = u
        driven = command[k] + disturbance * (k >= lag)
        x = A @ x + B * driven
    return LoopResponse(np.arange(count, dtype=np.float64) * fine, output[:count], command[lag : lag + count])


def _sampled(plant: Plant, dt: float) -> tuple[Array, Array, Array, float]:
    """x(k+1) = A x(k) + B u(k), y = C x + D u of the rational part, its input held; in a time scaled to its poles."""
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
    held = expm(system * (scale * dt))
    C, D = numerator[1:] - numerator[0] * denominator[1:], float(numerator[0])
    return held[:order, :order], held[:order, order], C, D
