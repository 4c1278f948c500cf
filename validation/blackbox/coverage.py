"""How often 95 percent intervals hold the truth, on logs of stepped sines drawn from known transfer functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from pysim.identify import TransferFunction, frequency_response
from pysim.identify.blackbox import (
    ComplexResponse,
    Root,
    Structure,
    TransferFunctionFit,
    complex_response,
    fit_transfer_function,
)
from pysim.thesis import FREQUENCIES_HZ
from pysim.types import Record, SineTest

Array = NDArray[np.float64]

T = TypeVar("T")

LEVEL = 0.95


@dataclass(frozen=True)
class BenchLog:
    """What a bench records per frequency.

    Args:
        noise: standard deviation of a sample, percent of angle.
        rate: samples per second.
        shortest, periods: a log lasts so many seconds, and so many periods, at least.
        samples: of every log alike, in place of the rate.
    """

    noise: float = 0.1
    rate: float = 250.0
    shortest: float = 1.0
    periods: int = 2
    samples: int | None = None

    def times(self, frequency: float) -> Array:
        """Of one log, s."""
        length = max(self.shortest, self.periods / frequency)
        return np.linspace(0.0, length, self.samples or int(self.rate * length) + 1)

    def response(self, function: TransferFunction, test: SineTest, rng: np.random.Generator) -> ComplexResponse:
        """One noisy frequency response test, by the sine fit of every log; its covariance is the sine fit's."""
        records = []
        for f in FREQUENCIES_HZ:
            gain = complex(function.at(np.array([f]))[0])
            time = self.times(f)
            angle = test.offset + test.amplitude * np.imag(gain * np.exp(2j * np.pi * f * time))
            noisy = angle + self.noise * rng.standard_normal(time.size)
            records.append(_record(time, noisy, test))
        return complex_response(frequency_response(records, FREQUENCIES_HZ, test, onset=0.0, noise=self.noise))


def _record(time: Array, angle: Array, test: SineTest) -> Record:
    return Record(time, angle[:, None], (test.output,), ("%",), origin="drawn")


@dataclass(frozen=True)
class Coverage:
    """Of one system: per number how many of the runs' intervals held its true value."""

    label: str
    names: tuple[str, ...]
    inside: NDArray[np.int64]
    runs: int

    @property
    def rare(self) -> Array:
        """Two-sided binomial probability of counts at least as far off, per number."""
        return np.array([stats.binomtest(int(k), self.runs, LEVEL).pvalue for k in self.inside])


def coverage(
    function: TransferFunction,
    structure: Structure,
    test: SineTest,
    *,
    runs: int,
    seed: int,
    log: BenchLog = BenchLog(),
    noise_known: bool = True,
) -> Coverage:
    """Draw, fit and count.

    Args:
        structure: the true one.
        noise_known: weigh by the covariance of the sine fits; else uniformly, with the noise from the residuals.
    """
    rng = np.random.default_rng(seed)
    truth = _true_numbers(function, structure)
    inside = dict.fromkeys(truth, 0)
    for _ in range(runs):
        response = log.response(function, test, rng)
        fit = fit_transfer_function(response, structure, weights="covariance" if noise_known else "uniform")
        for name, (low, high) in _intervals(fit).items():
            inside[name] += low <= truth[name] <= high
    return Coverage(f"{test.label}, {structure.label}", tuple(inside), np.array(list(inside.values())), runs)


def _true_numbers(function: TransferFunction, structure: Structure) -> dict[str, float]:
    """By the names of `_intervals`."""
    m, n = len(function.numerator), len(function.denominator) - 1
    truth = {f"b{m - 1 - k}": b for k, b in enumerate(function.numerator)}
    truth |= {f"a{n - 1 - k}": a for k, a in enumerate(function.denominator[1:])}
    truth |= {"dead_time": function.dead_time} if structure.delayed else {}
    truth["gain"] = function.gain
    for i, pole in enumerate(function.poles):
        truth |= _of_pole(i, Root(complex(pole), np.zeros((2, 2))), 0.0, lambda low, high: (low + high) / 2)
    return truth


def _intervals(fit: TransferFunctionFit) -> dict[str, tuple[float, float]]:
    """Of every coefficient, the dead time, the gain, and of each pole above or on the real axis size and damping."""
    found = {e.name: e.interval for e in (*fit.estimates(LEVEL), fit.gain(LEVEL))}
    for i, pole in enumerate(fit.poles):
        found |= _of_pole(i, pole, fit.quantile(LEVEL), lambda low, high: (low, high))
    return found


def _of_pole(i: int, pole: Root, quantile: float, as_wanted: Callable[[float, float], T]) -> dict[str, T]:
    """Size, and of a pair damping; nothing for the one below the axis."""
    if pole.value.imag < 0:
        return {}
    size, half = pole.frequency_hz, quantile * pole.frequency_deviation_hz
    numbers = {f"pole {i} Hz": as_wanted(size - half, size + half)}
    if pole.value.imag > 0:
        half = quantile * pole.damping_deviation
        numbers[f"pole {i} damping"] = as_wanted(pole.damping - half, pole.damping + half)
    return numbers
