"""A hose between a pump and its end, in closed form: the wave equation, and its segments one by one.

Both with friction of the mean flow, linearised, and a wall whose pressure lags behind its volume; the wave
equation with friction that depends on the frequency too.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.special import jve

Array = NDArray[np.float64]
Complex = NDArray[np.complexfloating]


@dataclass(frozen=True)
class Hose:
    """Line of `Examples.RippleHose`; SI units throughout."""

    length: float = 3.0
    diameter: float = 10e-3
    oil: float = 1.4e9  # Pa, stiffness
    wall: float = 350e6  # Pa, stiffness
    lag: float = 1e-4  # s, T_w of the wall
    density: float = 875.0
    viscosity: float = 46e-6
    roughness: float = 1e-4
    end: float = 0.0  # Pa.s/m3, resistance at the end; 0 is a tank
    unsteady: bool = False  # friction that depends on the frequency

    def with_lag(self, lag: float) -> Hose:
        """The same hose with another wall."""
        return replace(self, lag=lag)

    @property
    def area(self) -> float:
        return float(np.pi / 4 * self.diameter**2)

    @property
    def sound(self) -> float:
        """Speed of sound, m/s."""
        return float(np.sqrt(1 / (1 / self.oil + 1 / self.wall) / self.density))

    def series(self, omega: Array, flow: float) -> Complex:
        """Impedance per length (n,), Pa.s/m4.

        Unsteady friction is that of laminar flow; what turbulence of the mean flow adds is added as it is when steady.
        """
        step = 1e-4 * flow
        slope = (self.gradient(flow + step) - self.gradient(flow - step)) / (2 * step)
        if self.unsteady:
            return laminar_impedance(omega, self.diameter / 2, self.density, self.viscosity) + (slope - self.poiseuille)
        return 1j * omega * self.density / self.area + slope

    @property
    def poiseuille(self) -> float:
        """Loss of pressure over length and flow of steady laminar flow, Pa.s/m4."""
        return 8 * self.density * self.viscosity / (self.area * (self.diameter / 2) ** 2)

    def shunt(self, omega: Array) -> Complex:
        """Admittance per length (n,), m2/(Pa.s)."""
        compliance = self.area * (1 / self.oil + 1 / self.wall)
        return 1j * omega * compliance / (1 + 1j * omega * self.lag)

    def gradient(self, flow: float) -> float:
        """Loss of pressure over length by Churchill's friction factor, Pa/m."""
        speed = flow / self.area
        reynolds = abs(speed) * self.diameter / self.viscosity
        a = (2.457 * np.log(1 / ((7 / reynolds) ** 0.9 + 0.27 * self.roughness))) ** 16
        b = (37530 / reynolds) ** 16
        friction = 8 * ((8 / reynolds) ** 12 + (a + b) ** -1.5) ** (1 / 12)  # Darcy's
        return float(friction * self.density / (2 * self.diameter) * speed * abs(speed))

    def passed(self, hertz: Array, flow: float) -> Array:
        """Ripple at the end over ripple at the pump (n,), of the wave equation."""
        omega = 2 * np.pi * np.asarray(hertz, dtype=np.float64)
        series, shunt = self.series(omega, flow), self.shunt(omega)
        gamma = np.sqrt(series * shunt) * self.length
        return np.abs(1 / (np.cosh(gamma) + self.end * np.sqrt(shunt / series) * np.sinh(gamma)))

    def passed_by_segments(self, segments: int, hertz: Array, flow: float) -> Array:
        """The same (n,) of `segments` columns of oil between nodes, half a node at either end."""
        omega = 2 * np.pi * np.asarray(hertz, dtype=np.float64)
        series = self.series(omega, flow) * self.length / segments
        shunt = self.shunt(omega) * self.length / segments
        q = np.ones_like(series)
        p = self.end * q
        q = q + p * shunt / 2
        for left in range(segments, 0, -1):
            p = p + series * q
            q = q + p * shunt * (1.0 if left > 1 else 0.5)
        return np.abs(1 / q)


def laminar_impedance(omega: Array, radius: float, density: float, viscosity: float) -> Complex:
    """Series impedance per length (n,) of laminar flow in a round bore, Pa.s/m4.

    Args:
        omega: (n,) rad/s, above 0.
        radius: m.
        density: kg/m3.
        viscosity: kinematic, m2/s.
    Source: W. Zielke 1968, Frequency-dependent friction in transient pipe flow, J. Basic Eng. 90: j omega rho / A over
    1 - 2 J_1(z) / (z J_0(z)), z = sqrt(-j omega / nu) r.
    """
    z = radius * np.sqrt(-1j * np.asarray(omega, dtype=np.float64) / viscosity)
    inertia = 1j * omega * density / (np.pi * radius**2)
    return np.asarray(inertia / (1 - 2 * jve(1, z) / (z * jve(0, z))))
