"""The flow of an axial piston pump from the geometry alone, apart from the library's equations.

The position of a piston is where its axis meets the swash plate's radius vector (the vector loop of thesis Eq. 3.24),
solved as a linear system; its velocity is a complex step. Thesis Section 3.4.4 gives the numbers.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SPEED = 1450 * 2 * np.pi / 60  # rad/s
LITRES = 60e3  # l/min of m3/s


@dataclass(frozen=True)
class Geometry:
    pistons: int = 9
    diameter: float = 20.5e-3
    cone: float = np.deg2rad(85)
    carry_over: float = np.deg2rad(20)
    port_radius: float = 33.1e-3
    displacement: float = 71e-6
    largest: float = np.deg2rad(15)

    @property
    def opens(self) -> float:
        return self.carry_over - self.diameter / (2 * self.port_radius)

    @property
    def closes(self) -> float:
        opening = np.pi - self.diameter / self.port_radius
        return opening + self.carry_over + self.diameter / (2 * self.port_radius)

    @property
    def area(self) -> float:
        return np.pi / 4 * self.diameter**2

    @property
    def r_0(self) -> float:
        """From the stroke between opening and closing: Eq. 3.32 and 3.33."""
        unit = self.position(np.array([self.opens, self.closes]), self.largest, 1.0).real
        return float(self.displacement / (self.pistons * self.area * (unit[0] - unit[1])))

    def position(self, theta: NDArray, alpha: complex, r_0: float | None = None) -> NDArray:
        """Piston along its axis, at its own angle theta (n,): r_0 e + x axis = r joint, in the plane it turns in."""
        length = self.r_0 if r_0 is None else r_0
        tilt = alpha * np.cos(theta)
        axis = np.stack([np.full_like(tilt, -np.cos(self.cone)), np.full_like(tilt, -np.sin(self.cone))], axis=-1)
        joint = np.stack([np.cos(tilt), np.sin(tilt)], axis=-1)
        system = np.stack([joint, axis], axis=-1)
        rim = np.zeros((*tilt.shape, 2, 1), dtype=system.dtype)
        rim[..., 0, 0] = length
        return np.linalg.solve(system, rim)[..., 1, 0]

    def velocity(self, theta: Array, alpha: float, speed: float, alpha_t: float) -> Array:
        h = 1e-30
        return self.position(theta + 1j * h * speed, alpha + 1j * h * alpha_t).imag / h

    def flow(self, theta: Array, alpha: float, speed: float = SPEED, alpha_t: float = 0.0) -> tuple[Array, Array]:
        """Out of ports A and B (n,), for angles of piston 1 theta (n,)."""
        each = theta[:, None] + 2 * np.pi / self.pistons * np.arange(self.pistons)
        out = -self.area * self.velocity(each, alpha, speed, alpha_t)
        turned = np.mod(each, 2 * np.pi)
        to_a = (turned >= self.opens) & (turned < self.closes)
        return (to_a * out).sum(axis=1), (~to_a * out).sum(axis=1)

    @property
    def mean(self) -> float:
        return SPEED / (2 * np.pi) * self.displacement

    def ripple(self) -> tuple[float, float]:
        """Largest flow above the mean and depth of the spikes below it, in m3/s, at the largest angle."""
        just_before = np.arange(self.pistons) * 2 * np.pi / self.pistons + self.opens + np.array([[-1e-12], [1e-12]])
        theta = np.concatenate([np.linspace(0, 2 * np.pi, 20001), just_before.ravel()])
        ripple = self.flow(theta, self.largest)[0] - self.mean
        return float(ripple.max()), float(-ripple.min())
