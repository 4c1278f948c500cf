"""How often 95 percent intervals hold the truth, on logs of stepped sines drawn from known transfer functions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import stats

from pysim.identify import TransferFunction, frequency_response
from pysim.identify.blackbox import ComplexResponse, Structure, complex_response, fit_transfer_function
from pysim.types import Record, SineTest
from validation.thesis import FREQUENCIES_HZ

Array = NDArray[np.float64]

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
    truth = [*function.numerator, *function.denominator[1:]] + [function.dead_time] * structure.delayed
    inside, names = np.zeros(len(truth), dtype=np.int64), tuple[str, ...]()
    for _ in range(runs):
        fit = fit_transfer_function(
            log.response(function, test, rng), structure, weights="covariance" if noise_known else "uniform"
        )
        estimates = fit.estimates(LEVEL)
        names = tuple(e.name for e in estimates)
        inside += [e.low <= value <= e.high for e, value in zip(estimates, truth, strict=True)]
    return Coverage(f"{test.label}, {structure.label}", names, inside, runs)
