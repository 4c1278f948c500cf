"""Gains of a PI controller from a phase margin and a crossover frequency."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.control.tuning.margins import Margins, margins
from pysim.control.tuning.plant import Plant
from pysim.types import BadInput

Array = NDArray[np.float64]

_TIMES = 400  # integration times that are tried
_ALIKE = 0.99  # of the largest K_p/T_i: as fast
_SHARES = np.linspace(1.0, _ALIKE, 11)  # of the gain that the frequencies of the grid allow
_ON_AXIS = 1e-6  # of a root's size: further on the right than that it is unstable, and not rounded


@dataclass(frozen=True)
class Gains:
    """A PI controller K_p (1 + 1/(T_i s)) and the loop it makes.

    Args:
        plant: what it controls.
        K_p: command's unit per unit of what is controlled.
        T_i: s.
        loop: all margins of the loop.
    """

    plant: Plant
    K_p: float
    T_i: float
    loop: Margins

    @property
    def integral(self) -> float:
        """K_p/T_i; all that counts where T_i is much shorter than the loop."""
        return self.K_p / self.T_i


def known_pi(plant: Plant, K_p: float, T_i: float) -> Gains:
    """Gains that somebody chose, with the margins they have here.

    Raises:
        BadInput: a gain of zero, or an integration time that is not positive.
    """
    return Gains(plant, K_p, T_i, margins(plant, K_p, T_i))


def reachable_phase_margins(plant: Plant, crossover: float) -> tuple[float, float]:
    """Least and largest phase margin, rad, that a PI controller can give at a crossover, both open ends.

    The controller turns by -90 degrees (integral alone) to 0 (gain alone).
    """
    if not 0 < crossover < math.inf:
        raise BadInput(f"crossover: {crossover:g} rad/s; give a positive frequency")
    most = float(_phase(plant, np.array([crossover]))[0]) + math.pi
    return most - math.pi / 2, most


def tune_pi(plant: Plant, *, crossover: float, phase_margin: float) -> Gains:
    """The one PI controller with this phase margin (rad) at this crossover (rad/s).

    With phi = phase_margin - pi - arg G(j crossover), between -90 and 0 degrees: T_i = -1/(crossover tan phi) and
    K_p = cos phi/|G|.

    Returns:
        gains, with all margins of the loop; whether the loop is stable stands there.
    Raises:
        BadInput: no PI controller does it; tells which phase margins it can give there.
    """
    least, most = reachable_phase_margins(plant, crossover)
    if not least < phase_margin < most:
        low, high = (f"{math.degrees(x):.4g}" for x in (least, most))
        raise BadInput(
            f"phase margin: {math.degrees(phase_margin):.4g} degrees at {crossover:g} rad/s are out of a PI "
            f"controller's reach on the {plant.name}; ask for {low} to {high} degrees there, or another crossover"
        )
    phi = phase_margin - most
    K_p = math.cos(phi) / abs(plant.response(np.array([crossover]))[0])
    T_i = -1 / (crossover * math.tan(phi))
    return known_pi(plant, _steady_sign(plant) * K_p, T_i)


def fastest_pi(plant: Plant, *, phase_margin: float, gain_margin: float = 2.0) -> Gains:
    """The loop with the largest K_p/T_i that keeps both margins, which rejects slow disturbances best.

    At a given T_i the gain ends where the first frequency whose phase would leave too little margin comes to |L| = 1,
    or one of those in antiphase to 1/gain_margin. So |L| < 1 wherever the phase is beyond the margin, but for the
    lowest frequencies of a plant with an integrator, where |L| has to be above 1.

    Where an integral alone is as fast as any (a plant that is quick beside its resonance), all short T_i with the same
    K_p/T_i are alike; of those within a hundredth the longest is taken. Both gains have four digits.

    Args:
        plant: without poles to the right.
        phase_margin: rad, the least at any crossover.
        gain_margin: by how much the gain may rise, at least.
    Raises:
        BadInput: a plant that is unstable by itself or lets no constant through, or margins that no gain keeps.
    """
    if (plant.poles().real > 0).any():
        raise BadInput(f"{plant.name}: it is unstable by itself; choose a crossover and use tune_pi")
    if plant.numerator[-1] == 0:
        raise BadInput(f"{plant.name}: nothing of a constant comes through it; an integral of the error cannot settle")
    if not (0 < phase_margin < math.pi / 2 and gain_margin > 1):
        raise BadInput(
            f"margins: {math.degrees(phase_margin):.4g} degrees and {gain_margin:.3g}; give 0 to 90 degrees, above 1"
        )
    omega = plant.frequencies()
    response, phase = plant.response(omega) * _steady_sign(plant), _phase(plant, omega)
    steps = np.geomspace(1e-2 / omega[-1], 1 / omega[0], _TIMES)
    integrals = []
    for T_i in steps:
        loop, turned = response * (T_i + 1 / (1j * omega)), phase + np.arctan(omega * T_i) - math.pi / 2
        integrals.append(_largest_integral(loop, turned, phase_margin, gain_margin))
    best = int(np.argmax(integrals))
    if integrals[best] == math.inf:
        raise BadInput(f"{plant.name}: nothing limits the gain; add the dead time of the loop (delay)")
    alike = np.array(integrals) > _ALIKE * integrals[best]
    if alike[0]:  # an integral alone is as fast: of all that are, the one with the most phase
        best = int(np.argmin(alike)) - 1
    for gain in _SHARES * integrals[best] * steps[best] * _steady_sign(plant) if integrals[best] else ():
        found = known_pi(plant, float(f"{gain:.3e}"), float(f"{steps[best]:.3e}"))
        if found.loop.stable and found.loop.phase_margin >= phase_margin and found.loop.gain_margin >= gain_margin:
            return found
    raise BadInput(f"{plant.name}: no gain keeps these margins; ask for smaller ones")


def _largest_integral(loop: NDArray[np.complex128], phase: Array, phase_margin: float, gain_margin: float) -> float:
    """K_p/T_i, at most so large that a loop (n,) of continuous phase (n,) at K_p/T_i = 1 keeps both margins."""
    size = np.abs(loop)
    short = phase + math.pi < phase_margin
    first = int(np.argmin(short)) if short[0] else 0  # so many at the low end are in antiphase for two integrators
    if short.all():
        return 0.0
    turned = np.signbit(loop.imag[1:]) != np.signbit(loop.imag[:-1])
    antiphase = np.append(False, turned & (loop.real[1:] < 0))
    antiphase[: first + 1] = False
    most = max(size[first:][short[first:]].max(initial=0.0), gain_margin * size[antiphase].max(initial=0.0))
    if first and most >= size[:first].min():
        return 0.0
    return float(1 / most) if most > 0 else math.inf


def _steady_sign(plant: Plant) -> float:
    """Sign of the plant at low frequency, its integrators taken off."""
    return float(np.sign(np.trim_zeros(plant.numerator, "b")[-1] / np.trim_zeros(plant.denominator, "b")[-1]))


def _phase(plant: Plant, omega: Array) -> Array:
    """Continuous phase (n,) at frequencies (n,), rad, counted from the sign and the integrators at low frequency.

    The roots tell which of all turns it is: one on the left, at zero or on the axis turns forward, one on the right
    back.
    """
    zeros = np.asarray(np.roots(plant.numerator), dtype=np.complex128)
    near = _turned(zeros, omega) - _turned(plant.poles(), omega) - omega * plant.delay
    phase = np.angle(plant.response(omega) * _steady_sign(plant))
    return np.asarray(phase + 2 * math.pi * np.round((near - phase) / (2 * math.pi)), dtype=np.float64)


def _turned(roots: NDArray[np.complex128], omega: Array) -> Array:
    """By how much the product of all (1 - j omega/root) turns up to each frequency (n,), rad; a root of 0 by pi/2."""
    turned = np.zeros(omega.size)
    for root in roots:
        forward = 1.0 if root.real <= _ON_AXIS * abs(root) else -1.0
        turned += forward * np.arctan2(omega - root.imag, abs(root.real))
    return turned
