"""Logs of chirps through a linear second-order system, and its closed form."""

from functools import cache

import numpy as np
from scipy.signal import cont2discrete, lfilter

from pysim.excitation import Chirp
from pysim.types import MeasuredRecord, Record


def response(frequency: np.ndarray, natural_hz: float = 8.0, damping: float = 0.6, delay: float = 0.0) -> np.ndarray:
    omega, s = 2 * np.pi * natural_hz, 2j * np.pi * np.asarray(frequency)
    return omega**2 / (s**2 + 2 * damping * omega * s + omega**2) * np.exp(-s * delay)


def log(
    rate: float,
    *,
    natural_hz: float = 8.0,
    damping: float = 0.6,
    noise: float = 0.0,
    seed: int = 0,
    down: bool = False,
    delay: float = 0.0,
    offset: float = 50.0,
    stop_hz: float = 25.0,
    sampling: int = 250,
) -> MeasuredRecord:
    """A sweep between 0.1 Hz and `stop_hz` at a rate in Hz/s; delay (s) is a multiple of 0.25 ms."""
    time, swept = _swept(rate, natural_hz, damping, down, delay, offset, stop_hz, sampling)
    values = swept.copy()
    values[:, 1] += noise * np.random.default_rng(seed).standard_normal(values.shape[0])
    return MeasuredRecord("chirp.txt", "chirp", "fit", Record(time, values, ("u", "y"), ("%", "%")))


@cache
def _swept(
    rate: float,
    natural_hz: float,
    damping: float,
    down: bool,
    delay: float,
    offset: float,
    stop_hz: float,
    sampling: int,
) -> tuple[np.ndarray, np.ndarray]:
    """Times (n_t,) in s, and command and answer (n_t, 2) without noise; exact for a command of straight pieces."""
    ends = (stop_hz, 0.1) if down else (0.1, stop_hz)
    chirp = Chirp(offset, 10.0, *ends, (stop_hz - 0.1) / rate)
    omega = 2 * np.pi * natural_hz
    t = np.arange(0, chirp.end, 1 / 4000)
    u = chirp.signal().value(t)
    above, below, _ = cont2discrete(([omega**2], [1, 2 * damping * omega, omega**2]), 1 / 4000, "foh")
    y = lfilter(above.ravel(), below, u)
    y = np.concatenate([np.zeros(round(4000 * delay)), y])[: t.size]
    part = slice(8000, None, 4000 // sampling)
    return np.round(t[part], 5), np.column_stack([np.round(u, 5), y])[part]
