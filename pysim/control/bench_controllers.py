"""The thesis' two controllers of the test bench, each as one block, and the load controller made better."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from pysim.control._check import check_numbers
from pysim.control.pi import PI
from pysim.types import BadInput, Port

# thesis Tables 5.1 and 6.1 (manually tuned), Table 4 of the appendix; the library's Data.LoadCircuit has the same
_ALPHA_MAX = math.radians(15)
_MOTOR = 60e-6 / (2 * math.pi)
_K_P_PUMP = 71e-6 * 1450 / 60 / _ALPHA_MAX


@dataclass
class SpeedController:
    """Command of the pump's angle in percent: PI with feed forward, its PI part off near standstill.

    There the pulses say nothing: the PI part gives zero and keeps what it had for later. The angle's limit goes round
    the sum of both parts.

    Args:
        dt: s between two steps.
        K_p: s, rad per rad/s.
        T_i: s.
        feed: s, angle over speed.
        omega_zero: rad/s, measured speed below which the PI part is off.
        largest: rad, of the swash plate.
    Raises:
        BadInput: numbers that PI refuses, a threshold below zero, an angle that is not positive.
    Source: thesis Eq. 5.32 to 5.35, Tables 6.1 and 12. Its threshold is not published.
    """

    dt: float
    K_p: float = 1.06e-7
    T_i: float = 0.000159
    feed: float = _MOTOR / _K_P_PUMP
    omega_zero: float = 2.0
    largest: float = _ALPHA_MAX

    def __post_init__(self) -> None:
        check_numbers("speed controller", self, "dt", "K_p", "T_i", "feed", "omega_zero", "largest")
        if not self.omega_zero >= 0 or not 0 < self.largest < math.inf:
            raise BadInput(
                f"speed controller: omega_zero = {self.omega_zero:g} rad/s, largest = {self.largest:g} rad; give zero "
                "or more, and a positive angle"
            )
        self._pi = PI(self.K_p, self.T_i, self.dt, "rad/s", "rad")
        self.inputs = (Port("reference", "rad/s"), Port("measured", "rad/s"))
        self.outputs = (Port("alphaCMD", "%"), Port("pi", "rad"))

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, float]:
        """(reference, measured) -> (alphaCMD, pi)."""
        reference, measured = inputs
        feed, largest = self.feed * reference, self.largest
        if abs(measured) >= self.omega_zero:
            pi = self._pi.advance(reference - measured, -largest - feed, largest - feed)
        else:
            self._pi.rest()
            pi = 0.0
        return 100 * min(max(pi + feed, -largest), largest) / largest, pi


@dataclass
class LoadController:
    """Command of the servo valve within -1 ... 1: PI with feed forward of the reference speed.

    Args:
        dt: s between two steps.
        K_p: 1/Pa.
        T_i: s.
        feed: s/rad, opening over speed.
    Source: thesis Eq. 5.32, 5.33, 5.37, Tables 6.1 and 13.
    """

    dt: float
    K_p: float = 1.98e-9
    T_i: float = 0.03
    feed: float = _MOTOR / 0.0035

    def __post_init__(self) -> None:
        check_numbers("load controller", self, "dt", "K_p", "T_i", "feed")
        self._pi = PI(self.K_p, self.T_i, self.dt, "Pa", "1")
        self.inputs = (Port("reference", "Pa"), Port("measured", "Pa"), Port("speed", "rad/s"))
        self.outputs = (Port("u_ref", "1"), Port("pi", "1"))

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, float]:
        """(reference, measured, speed) -> (u_ref, pi)."""
        reference, measured, speed = inputs
        feed = -self.feed * speed
        pi = self._pi.advance(reference - measured, -1 - feed, 1 - feed)
        return min(max(pi + feed, -1.0), 1.0), pi


@dataclass
class CompensatedLoadController:
    """The load controller with the valve's characteristic turned round by measured pressures.

    PI and feed forward ask for a flow; the opening is what lets it through at the pressure drop that is there. So the
    loop's gain does not change with the load, and the motor's flow is fed forward as a flow. The integral keeps within
    what the fully open valve would let through.

    The load pressure that turns the characteristic round is smoothed. Taken as it is, it would also take away that the
    valve lets through less as the load pressure rises; this damps the shaft, which swings at 12 Hz.

    Args:
        dt: s between two steps.
        K_p: m3/(s Pa); that of the thesis' controller times K_qu, so that both loops are alike at its working point.
        T_i: s.
        motor: m3/rad of the load motor.
        valve: m2, flow over opening and root of pressure over density.
        rho: kg/m3.
        least: Pa, pressure drop below which the valve is taken to have this one.
        smoothing: s, time constant of the first-order lag of the load pressure for the characteristic; 0 is none.
    Raises:
        BadInput: numbers that PI refuses, a number of the valve or the motor that is not positive, or a smoothing
            below zero.
    Source: thesis Eq. 5.2 solved for the opening; proposed in its Section 6.1. Differs: the smoothing.
    """

    dt: float
    K_p: float = 1.98e-9 * 0.0035
    T_i: float = 0.03
    motor: float = _MOTOR
    valve: float = 1.863e-5
    rho: float = 875.0
    least: float = 5e5
    smoothing: float = 0.1

    def __post_init__(self) -> None:
        names = ("dt", "K_p", "T_i", "motor", "valve", "rho", "least", "smoothing")
        check_numbers("compensated load controller", self, *names)
        for name in ("motor", "valve", "rho", "least"):
            if not 0 < getattr(self, name) < math.inf:
                raise BadInput(f"compensated load controller: {name} = {getattr(self, name):g}; give a positive number")
        if not 0 <= self.smoothing < math.inf:
            raise BadInput(f"compensated load controller: smoothing = {self.smoothing:g} s; give zero or more")
        self._pi = PI(self.K_p, self.T_i, self.dt, "Pa", "m3/s")
        self._share, self._smooth = self.dt / max(self.smoothing, self.dt), 0.0
        self.inputs = (
            Port("reference", "Pa"),
            Port("measured", "Pa"),
            Port("speed", "rad/s"),
            Port("supply", "Pa"),
        )
        self.outputs = (Port("u_ref", "1"), Port("pi", "m3/s"))

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float, float]:
        """(reference, measured, speed, supply) -> (u_ref, pi)."""
        reference, measured, speed, supply = inputs
        self._smooth = smooth = self._share * measured + (1 - self._share) * self._smooth
        upwards = self.valve * math.sqrt(max(supply - smooth, self.least) / self.rho)
        downwards = self.valve * math.sqrt(max(supply + smooth, self.least) / self.rho)
        feed = -self.motor * speed
        pi = self._pi.advance(reference - measured, -downwards - feed, upwards - feed)
        flow = pi + feed
        return min(max(flow / (upwards if flow > 0 else downwards), -1.0), 1.0), pi
