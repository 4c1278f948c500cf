"""Systems whose best linear approximation and distortion are known exactly, and multisines to drive them."""

from __future__ import annotations

import itertools
from collections import Counter, defaultdict
from collections.abc import Callable

import numpy as np
from scipy.signal import freqz, lfilter

from pysim.identify.multisine import Periods
from pysim.types import Record

N = 512  # samples per period
PERIOD = 2.0  # s
AMPLITUDE = 0.3  # of every excited line
B, A = (0.1, 0.05), (1.0, -1.3, 0.6)  # a resonance at a tenth of the sampling rate, over within half a period
ODD = np.arange(1, 101, 2)
FULL = np.arange(1, 61)


def with_free_lines(odd: np.ndarray, seed: int, group: int = 3) -> np.ndarray:
    """Odd lines of which one in each group, drawn at random, is left free."""
    rng = np.random.default_rng(seed)
    whole = odd[: odd.size // group * group].reshape(-1, group)
    free = [row[rng.integers(group)] for row in whole[1:-1]]  # the outermost ones stay, so that the band does
    return np.setdiff1d(odd, free)


def gain(lines: np.ndarray, n: int = N) -> np.ndarray:
    """The linear system's gain at harmonics of a period of n samples."""
    return freqz(B, A, 2 * np.pi * np.asarray(lines) / n)[1]


def multisine(lines: np.ndarray, rng: np.random.Generator, n: int = N, amplitude: float = AMPLITUDE) -> np.ndarray:
    """One period (n,) of sum A cos(2 pi k t + phi_k), phases independent and uniform."""
    spectrum = np.zeros(n // 2 + 1, dtype=complex)
    spectrum[lines] = amplitude * np.exp(2j * np.pi * rng.random(len(lines)))
    return np.fft.irfft(spectrum * n / 2, n)


def through(values: np.ndarray) -> np.ndarray:
    """The linear system's steady state (n,) to one period of its input: exact, by its gain at each line."""
    n = values.size
    return np.fft.irfft(np.fft.rfft(values) * gain(np.arange(n // 2 + 1), n), n)


def measure(
    lines: np.ndarray,
    *,
    realisations: int,
    periods: int,
    noise: float = 0.0,
    seed: int,
    respond: Callable[[np.ndarray], np.ndarray] = through,
    amplitude: float = AMPLITUDE,
) -> Periods:
    """Steady periods of a test, with white noise of that standard deviation on the output."""
    rng = np.random.default_rng(seed)
    values = np.empty((realisations, periods, N, 2))
    for m in range(realisations):
        u = multisine(lines, rng, amplitude=amplitude)
        values[m, :, :, 0], values[m, :, :, 1] = u, respond(u)
    values[..., 1] += noise * rng.standard_normal(values.shape[:3])
    return Periods(values, ("u", "y"), ("V", "m"), PERIOD, "a known system")


def from_rest(lines: np.ndarray, *, periods: int, noise: float, seed: int, before: np.ndarray | None = None) -> Periods:
    """The same linear system with a transient: it stands still when the periods start, or runs on after `before`."""
    rng = np.random.default_rng(seed)
    u = np.tile(multisine(lines, rng), periods)
    lead = np.zeros(0) if before is None else before
    y = lfilter(B, A, np.concatenate([lead, u]))[lead.size :] + noise * rng.standard_normal(u.size)
    return Periods(np.stack([u, y], -1).reshape(1, periods, N, 2), ("u", "y"), ("V", "m"), PERIOD)


def record(periods: Periods) -> Record:
    """The first realisation as a log."""
    values = periods.values[0].reshape(-1, len(periods.names))
    step = periods.period / periods.values.shape[2]
    return Record(step * np.arange(values.shape[0]), values, periods.names, periods.units, origin="log")


def line_noise(noise: float, periods: int, n: int = N) -> float:
    """E|.|^2 of a line's complex amplitude by white noise, over that many periods: 4 sigma^2 / samples."""
    return 4 * noise**2 / (n * periods)


def cubic_gain(lines: np.ndarray, strength: float, amplitude: np.ndarray | float = AMPLITUDE) -> np.ndarray:
    """The gain of u + strength u^3, exactly, for any number of lines of any amplitude.

    Of the products of three lines, those with a line and its mirror image keep the phase of the third:
    1 + strength (3 sigma^2 - 3/4 A_k^2), sigma^2 = sum A^2 / 2; Gaussian signals are the limit of many lines.
    """
    a = np.broadcast_to(np.asarray(amplitude, dtype=float), (len(lines),))
    return 1 + strength * (1.5 * np.sum(a**2) - 0.75 * a**2)


def product_power(lines: np.ndarray, degree: int, amplitude: float = AMPLITUDE) -> dict[int, float]:
    """Harmonic -> E|amplitude|^2 of those products in u^degree that do not keep the phase of a line.

    u = sum over +-k of (A/2) e^{j(...)}: every multiset of `degree` signed lines without a line and its mirror image
    has a phase of its own, so powers add. Multisets that are one line after mirror images cancel are the gain's.
    """
    signed = [int(s) for s in np.concatenate([lines, -np.asarray(lines)])]
    classes: dict[tuple[int, ...], float] = defaultdict(float)
    for chosen in itertools.combinations_with_replacement(sorted(signed), degree):
        orderings = np.prod(np.arange(1, degree + 1)) / np.prod([_factorial(c) for c in Counter(chosen).values()])
        classes[_cancelled(chosen)] += float(orderings) * (amplitude / 2) ** degree
    power: dict[int, float] = defaultdict(float)
    for left, height in classes.items():
        if len(left) > 1 and sum(left) > 0:
            power[sum(left)] += (2 * height) ** 2
    return power


def _cancelled(chosen: tuple[int, ...]) -> tuple[int, ...]:
    left = list(chosen)
    for k in chosen:
        if k in left and -k in left:
            left.remove(k)
            left.remove(-k)
    return tuple(left)


def _factorial(n: int) -> int:
    return int(np.prod(np.arange(1, n + 1)))
