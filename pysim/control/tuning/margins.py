"""How far a loop is from instability, and what it does in closed form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pysim.control.tuning.loop_response import sampled
from pysim.control.tuning.plant import Plant
from pysim.types import BadInput

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_SMALL = 1e-3  # of the loop gain, below which antiphase is of no interest
_NEAR = 0.7  # of the loop gain, below which dead time turns 1 + L by less than a quarter
_TURN = 0.5  # rad that the dead time may turn a loop of such a gain from one frequency to the next
_MOST = 300_000  # frequencies
_BISECTIONS = 60  # each halves the bracket of a crossing; ends at rounding
_ON_AXIS = 1e-9  # of a pole's size: nearer to the imaginary axis than that it lies there


@dataclass(frozen=True)
class Margins:
    """Of an open loop L = PI times plant.

    Args:
        crossovers: (n,) rad/s where |L| = 1, rising.
        phase_margins: (n,) rad at these, within -pi ... pi.
        phase_crossovers: (m,) rad/s where L is real and negative, and more than a thousandth, rising.
        gain_margins: (m,) 1/|L| there.
        delay_margin: s of dead time that the loop bears; infinite without crossover. Zero where it is not stable, and
            where |L| stays above 1 at the end, which a plant that answers at once can do.
        peak_sensitivity: largest 1/|1 + L|.
        bandwidth: rad/s, where the closed loop first crosses -3 dB; infinite where it does not.
        stable: whether the closed loop is; `stable_when_sampled` asks for the controller as it is run.
    """

    crossovers: Array
    phase_margins: Array
    phase_crossovers: Array
    gain_margins: Array
    delay_margin: float
    peak_sensitivity: float
    bandwidth: float
    stable: bool

    @property
    def crossover(self) -> float:
        """rad/s, the one with the least phase margin; not a number without any."""
        return float(self.crossovers[np.argmin(self.phase_margins)]) if self.crossovers.size else np.nan

    @property
    def phase_margin(self) -> float:
        """rad, the least; infinite without crossover."""
        return float(self.phase_margins.min()) if self.crossovers.size else np.inf

    @property
    def gain_margin(self) -> float:
        """By how much the gain may rise, infinite where nothing near stops it; of an unstable loop the least."""
        above = self.gain_margins[(self.gain_margins > 1) | (not self.stable)]
        return float(above.min()) if above.size else np.inf


def open_loop(plant: Plant, K_p: float, T_i: float, omega: Array) -> Complex:
    """K_p (1 + 1/(T_i s)) times the plant at angular frequencies (n,).

    Source: thesis Eq. 5.32.
    """
    return np.asarray(K_p * (1 + 1 / (1j * omega * T_i)) * plant.response(omega), dtype=np.complex128)


def margins(plant: Plant, K_p: float, T_i: float) -> Margins:
    """All margins of a plant under K_p (1 + 1/(T_i s)).

    Raises:
        BadInput: a gain of zero or an integration time that is not positive.
    """
    _check(K_p, T_i)
    omega = _frequencies(plant, K_p, T_i)
    loop = open_loop(plant, K_p, T_i, omega)

    def log_size(w: Array) -> Array:
        return np.asarray(np.log(np.abs(open_loop(plant, K_p, T_i, w))))

    def turned(w: Array) -> Array:
        return np.asarray(open_loop(plant, K_p, T_i, w).imag)

    crossovers = _roots(omega, np.log(np.abs(loop)), log_size)
    at = open_loop(plant, K_p, T_i, crossovers)
    phase_margins = np.angle(-at)
    real_axis = _roots(omega, loop.imag, turned, _undamped(plant))  # L changes sides through infinity there
    values = open_loop(plant, K_p, T_i, real_axis).real
    negative = values < -_SMALL
    stable = _is_stable(plant, K_p, T_i, omega)
    edges = _roots(omega, _beyond_3_db(loop), lambda w: _beyond_3_db(open_loop(plant, K_p, T_i, w)))
    return Margins(
        crossovers,
        phase_margins,
        real_axis[negative],
        -1 / values[negative],
        _delay_margin(crossovers, phase_margins) if stable and _last(plant, K_p) < 1 else 0.0,
        float(1 / np.abs(1 + loop).min()),
        float(edges[0]) if edges.size else np.inf,
        stable,
    )


def _check(K_p: float, T_i: float) -> None:
    if not (K_p != 0 and np.isfinite(K_p) and 0 < T_i < np.inf):
        raise BadInput(f"margins: K_p = {K_p:g}, T_i = {T_i:g} s; give a gain other than zero, a positive time")


def _last(plant: Plant, K_p: float) -> float:
    """|L| at the highest frequencies: zero but for a plant that answers at once."""
    at_once = len(plant.numerator) == len(plant.denominator)
    return abs(K_p * plant.numerator[0] / plant.denominator[0]) if at_once else 0.0


def _delay_margin(crossovers: Array, phase_margins: Array) -> float:
    """Dead time turns L by omega T: a turn from the margin's angle, counted as positive, to the critical point."""
    delays = np.mod(phase_margins, 2 * np.pi) / crossovers
    return float(delays.min()) if delays.size else np.inf


def _beyond_3_db(loop: Complex) -> Array:
    """Positive where the closed loop |L/(1 + L)| is above -3 dB."""
    return np.asarray(np.abs(loop / (1 + loop)) - np.sqrt(0.5))


def _frequencies(plant: Plant, K_p: float, T_i: float) -> Array:
    """The plant's, and far enough on either side for the controller's corner, a slow integral and a high gain."""
    own = plant.frequencies()
    slow, fast = min(own[0], 1e-4 / T_i), max(own[-1], 1e3 / T_i)
    low, high = np.abs(open_loop(plant, K_p, T_i, np.array([slow, fast])))
    slow *= min(1.0, 1e-3 * low)  # down there the loop falls with the frequency at least
    falls = len(plant.denominator) - len(plant.numerator)  # and up there with this power of it
    if falls:
        fast *= max(1.0, high / _SMALL) ** (1 / falls)
    omega = np.unique(np.concatenate([own, np.geomspace(slow, fast, 4000)]))
    omega = omega[~np.isclose(omega[:, None], _undamped(plant), rtol=_ON_AXIS, atol=0.0).any(axis=1)]
    return _close_enough(omega, np.abs(open_loop(plant, K_p, T_i, omega)), plant.delay)


def _close_enough(omega: Array, size: Array, delay: float) -> Array:
    """More frequencies where a loop of gain `size` (n,) counts and the dead time would turn it too far between two."""
    counts = np.maximum(size[1:], size[:-1]) > _NEAR
    parts = np.where(counts, np.ceil(np.diff(omega) * delay / _TURN), 1.0).clip(min=1.0)
    place = np.append(0.0, np.cumsum(parts))
    if place[-1] > _MOST:  # so many turns with a gain above one are beyond all margins
        return omega
    return np.interp(np.arange(place[-1] + 1), place, omega)


def _undamped(plant: Plant) -> Array:
    """Angular frequencies of the poles on the imaginary axis, where the loop is infinite."""
    poles = plant.poles()
    return np.asarray(poles.imag[(np.abs(poles.real) <= _ON_AXIS * np.abs(poles)) & (poles.imag > 0)])


def _roots(omega: Array, values: Array, of: Callable[[Array], Array], poles: Array | tuple[()] = ()) -> Array:
    """Frequencies where `values` changes its sign, each bisected; not where it does so through a pole."""
    signs = np.signbit(values)
    k = np.flatnonzero(signs[1:] != signs[:-1])
    k = k[~((omega[k, None] < poles) & (omega[k + 1, None] > poles)).any(axis=1)]
    low, high, left = omega[k], omega[k + 1], signs[k]
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        same = np.signbit(of(middle)) == left
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return np.asarray(0.5 * (low + high), dtype=np.float64)


def _is_stable(plant: Plant, K_p: float, T_i: float, omega: Array) -> bool:
    """Whether the closed loop's roots, those of F = D T_i s + N K_p (1 + T_i s) exp(-s delay), lie on the left.

    With dead time by the argument principle: of a polynomial's degree n, F turns by n pi/2 along the positive imaginary
    axis, and by pi less for each root on the right. Unlike 1 + L, it has no poles, which could lie on that axis. N of
    the degree of D leaves it swinging by less than pi/2 there, or, with a gain above one, roots on the right.

    Where |L| > 1 it turns with the dead time. All else together cannot turn it back by more than 3 n + 2 half turns:
    n for each of D and N, one for each crossover and both ends.
    """
    forward = np.polymul(plant.numerator, (K_p * T_i, K_p))
    own = np.polymul(plant.denominator, (T_i, 0.0))
    if forward[-1] == 0.0:  # the plant's zero at 0 hides the integral, a root at 0
        return False
    if plant.delay == 0:
        return bool((np.roots(np.polyadd(own, forward)).real < 0).all())
    if forward.size == own.size and abs(forward[0]) >= abs(own[0]):
        return False
    s = 1j * omega
    free, fed = np.polyval(own, s), np.polyval(forward, s)
    above = np.abs(fed) > np.abs(free)
    if plant.delay * np.diff(omega)[above[1:] & above[:-1]].sum() > 4 * own.size * np.pi:
        return False
    turn = np.unwrap(np.angle(free + fed * np.exp(-s * plant.delay)))
    return bool(abs(turn[-1] - turn[0] - (own.size - 1) * np.pi / 2) < np.pi / 2)


def stable_when_sampled(plant: Plant, K_p: float, T_i: float, *, dt: float) -> bool:
    """Whether the closed loop is stable under the difference equation of the controller, stepped every dt (s).

    By the argument principle, over the upper half of the unit circle: F, the characteristic polynomial over its highest
    power of z, is (1 - 1/z) prod(1 - p/z) (1 + L) of the plant's poles p, has all its poles at 0, and turns by pi less
    for each root on or outside the circle. Where |L| > 1 it turns with the dead time, as in `margins`.

    Raises:
        BadInput: a gain of zero, or a time that is not positive.
    Source: thesis Eq. 5.33.
    """
    _check(K_p, T_i)
    if not 0 < dt < np.inf:
        raise BadInput(f"sampling time: {dt:g} s; give a positive number")
    if plant.numerator[-1] == 0.0:  # the plant's zero at 0 hides the integral, a root at 1
        return False
    held = sampled(plant, dt)
    poles = np.asarray(np.linalg.eigvals(held.A), dtype=np.complex128)

    def loop(angle: Array) -> Complex:
        back = np.exp(-1j * angle)
        inner = np.eye(poles.size) / back[:, None, None] - held.A
        driven = held.B + held.late * back[:, None]
        answer = np.linalg.solve(inner, driven[..., None])[..., 0] @ held.C + held.D * back
        controller = K_p + K_p * dt / T_i * back / (1 - back)
        return np.asarray(controller * answer * np.exp(-1j * angle * held.lag), dtype=np.complex128)

    near = [abs(np.angle(p)) + 30 * max(abs(1 - abs(p)), _ON_AXIS) * np.linspace(-1, 1, 600) ** 3 for p in poles]
    angle = np.concatenate([_frequencies(plant, K_p, T_i) * dt, np.linspace(0, np.pi, 2001), *near])
    angle = np.unique(angle[(angle > 0) & (angle <= np.pi)])
    size = np.abs(loop(angle))
    if held.lag * np.diff(angle)[(size[1:] > 1) & (size[:-1] > 1)].sum() > 4 * (poles.size + 2) * np.pi:
        return False
    angle = _close_enough(angle, size, held.lag)
    back = np.exp(-1j * angle)
    turn = np.unwrap(np.angle((1 - poles * back[:, None]).prod(axis=1) * (1 - back) * (1 + loop(angle))))
    return bool(abs(turn[-1] - turn[0]) < np.pi / 2)
