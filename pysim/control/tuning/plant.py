"""A linear plant: a ratio of polynomials in s, and a dead time."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from pysim.types import BadInput

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Plant:
    """numerator(s) / denominator(s) exp(-s delay), from a command to what is controlled.

    Args:
        numerator, denominator: coefficients from the highest power of s down.
        delay: dead time, s.
        name: for tables and pictures.
        input_unit, output_unit: SI.
    Raises:
        BadInput: coefficients that are not finite, an improper ratio, a dead time that is negative.
    """

    numerator: tuple[float, ...]
    denominator: tuple[float, ...]
    delay: float = 0.0
    name: str = "plant"
    input_unit: str = "1"
    output_unit: str = "1"

    def __post_init__(self) -> None:
        for name in ("numerator", "denominator"):
            polynomial = tuple(float(x) for x in np.trim_zeros(np.ravel(getattr(self, name)), "f"))
            if not polynomial or not np.isfinite(polynomial).all():
                raise BadInput(f"{self.name}: the {name} is {getattr(self, name)}; give finite numbers, not all zero")
            object.__setattr__(self, name, polynomial)
        if len(self.numerator) > len(self.denominator):
            raise BadInput(
                f"{self.name}: the numerator has degree {len(self.numerator) - 1}, the denominator "
                f"{len(self.denominator) - 1}; a plant cannot differentiate, give a denominator of at least that degree"
            )
        if not 0 <= self.delay < np.inf:
            raise BadInput(f"{self.name}: the dead time is {self.delay:g} s; give zero or more")

    def response(self, omega: Array) -> Complex:
        """At angular frequencies (n,) rad/s: complex gain (n,)."""
        s = 1j * np.asarray(omega, dtype=np.float64)
        ratio = np.polyval(self.numerator, s) / np.polyval(self.denominator, s)
        return np.asarray(ratio * np.exp(-s * self.delay), dtype=np.complex128)

    def poles(self) -> Complex:
        """Roots of the denominator, rad/s."""
        return np.asarray(np.roots(self.denominator), dtype=np.complex128)

    def behind(self, first: Plant) -> Plant:
        """This plant fed by another; the name stays."""
        return replace(
            self,
            numerator=tuple(np.polymul(self.numerator, first.numerator)),
            denominator=tuple(np.polymul(self.denominator, first.denominator)),
            delay=self.delay + first.delay,
            input_unit=first.input_unit,
        )

    def delayed(self, seconds: float) -> Plant:
        """The same with so much more dead time."""
        return replace(self, delay=self.delay + seconds)

    def frequencies(self) -> Array:
        """Angular frequencies (n,) rad/s that resolve all it does: a wide grid, closer about each resonance."""
        zeros = np.roots(self.numerator)
        sizes = [abs(root) for root in (*self.poles(), *zeros) if abs(root) > 0] or [1.0]
        high = max(1e3 * max(sizes), 100 / self.delay) if self.delay > 0 else 1e3 * max(sizes)
        parts = [np.geomspace(1e-5 * min(sizes), high, 8000)]
        for root in (*self.poles(), *zeros):
            if root.imag > 0:
                width = 30 * max(abs(root.real), 1e-6 * root.imag)
                parts.append(root.imag + width * np.linspace(-1, 1, 601) ** 3)
        omega = np.unique(np.concatenate(parts))
        return np.asarray(omega[omega > 0], dtype=np.float64)
