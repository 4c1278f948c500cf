"""A linear and two static systems whose gain and distortion under a multisine are sums that can be carried out."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from pysim.excitation import LineGrid
from pysim.identify.multisine import Periods

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

SAMPLES, AMPLITUDE, PERIOD = 512, 0.3, 2.0
GRID = LineGrid(PERIOD, 0.5, 24.0, "random-odd", group=3, seed=5)
LINES = GRID.excited
_NUMERATOR, _DENOMINATOR = (0.1, 0.05), (1.0, -1.3, 0.6)


def gain(lines: NDArray[np.int64]) -> Complex:
    """Of the linear system, a second-order resonance, at harmonics of the period."""
    z = np.exp(-2j * np.pi * lines / SAMPLES)
    top, bottom = (np.polyval(c[::-1], z) for c in (_NUMERATOR, _DENOMINATOR))
    return np.asarray(top / bottom, dtype=np.complex128)


def linear(u: Array) -> Array:
    """Its steady state to one period."""
    lines = np.arange(SAMPLES // 2 + 1)
    return np.asarray(np.fft.irfft(np.fft.rfft(u) * gain(lines), SAMPLES), dtype=np.float64)


def measured(respond: Callable[[Array], Array], *, realisations: int, periods: int, noise: float, seed: int) -> Periods:
    """Periods of a steady test, with white noise of that standard deviation on the output."""
    rng = np.random.default_rng(seed)
    values = np.empty((realisations, periods, SAMPLES, 2))
    for m in range(realisations):
        spectrum = np.zeros(SAMPLES // 2 + 1, dtype=np.complex128)
        spectrum[LINES] = AMPLITUDE * np.exp(2j * np.pi * rng.random(LINES.size))
        values[m, :, :, 0] = np.fft.irfft(spectrum * SAMPLES / 2, SAMPLES)
        values[m, :, :, 1] = respond(values[m, 0, :, 0])
    values[..., 1] += noise * rng.standard_normal(values.shape[:3])
    return Periods(values, ("u", "y"), ("1", "1"), PERIOD)


def line_noise(noise: float, periods: int) -> float:
    """What white noise adds to a line, in gain unit squared."""
    return 4 * noise**2 / (SAMPLES * periods) / AMPLITUDE**2


def cubic_gain(strength: float) -> float:
    """Of u + strength u^3 under equal lines: 1 + strength (3 sigma^2 - 3/4 A^2), exactly for any number of lines."""
    return 1 + strength * AMPLITUDE**2 * (1.5 * LINES.size - 0.75)


def square_power() -> dict[int, float]:
    """Line -> E|amplitude|^2 of u^2 / A^2: each pair of signed lines (a, b) adds A / 2 squared per ordering."""
    signed = np.concatenate([LINES, -LINES])
    power: dict[int, float] = defaultdict(float)
    for i, a in enumerate(signed.tolist()):
        for b in signed[: i + 1].tolist():
            orderings = 1 if a == b else 2
            if a + b > 0:
                power[a + b] += (2 * orderings * (AMPLITUDE / 2) ** 2) ** 2 / AMPLITUDE**2
    return power


def cube_power() -> dict[int, float]:
    """The same of u^3, without the products that keep the phase of a line (those with a line and its mirror image)."""
    signed = np.concatenate([LINES, -LINES]).tolist()
    power: dict[int, float] = defaultdict(float)
    for i, a in enumerate(signed):
        for j, b in enumerate(signed[: i + 1]):
            for c in signed[: j + 1]:
                if a + b + c > 0 and 0 not in (a + b, a + c, b + c):
                    orderings = {1: 1, 2: 3, 3: 6}[len({a, b, c})]
                    power[a + b + c] += (2 * orderings * (AMPLITUDE / 2) ** 3) ** 2 / AMPLITUDE**2
    return power
