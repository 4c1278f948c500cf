"""The linear system closest to a non-linear one under a given excitation, and how far it is from being all there is."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from pysim.types.errors import BadInput

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class MultisineTest:
    """What was done: which signal was excited how, and how often.

    Args:
        input: name of the exciting signal.
        output: name of the responding one.
        input_unit, output_unit: "1" where there is none.
        offset: mean of the input, in its unit.
        rms: of the input without its mean, in its unit.
        period: s; the length of the record where the excitation is not periodic.
        realisations: independent draws of the random phases.
        periods: used of each realisation; 1 where the excitation is not periodic.
    Raises:
        BadInput: an excitation without size, or a number that is not finite.
    """

    input: str
    output: str
    input_unit: str
    output_unit: str
    offset: float
    rms: float
    period: float
    realisations: int
    periods: int

    def __post_init__(self) -> None:
        if not (self.rms > 0 and self.period > 0 and np.isfinite([self.offset, self.rms, self.period]).all()):
            raise BadInput(
                f"multisine test: {self.input} must move with a positive period, got rms {self.rms} and {self.period} s"
            )


@dataclass(frozen=True)
class Level:
    """The mean power of what is not linear in the input, line by line, divided by the input's power on that line.

    All levels are those of one realisation averaged over its periods, so that noise and distortion add up.

    Args:
        frequency: (n,) Hz, increasing.
        variance: (n,) gain unit squared. A difference of two estimates may come out negative: below what can be seen.
        low, high: (n,) ends of the 95 percent interval.
    Raises:
        BadInput: shapes that do not match or frequencies that do not increase.
    """

    frequency: Array
    variance: Array
    low: Array
    high: Array

    def __post_init__(self) -> None:
        n = np.size(self.frequency)
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, float | int):
                continue
            array = np.array(value, dtype=np.float64)
            array.setflags(write=False)
            object.__setattr__(self, field.name, array)
            if array.shape != (n,):
                raise BadInput(f"level: {field.name} needs shape ({n},), got {array.shape}")
        if np.any(np.diff(self.frequency) <= 0):
            raise BadInput("level: frequencies must increase")


@dataclass(frozen=True)
class Distortion(Level):
    """A level found as power on a line less the noise expected there.

    Args:
        power, noise: (n,) both, gain unit squared.
        degrees, noise_degrees: (n,) their degrees of freedom, counted in real numbers.
        shared, noise_shared: neighbouring lines whose estimates share data; 1 where none do.
    """

    power: Array
    noise: Array
    degrees: Array
    noise_degrees: Array
    shared: float = 1.0
    noise_shared: float = 1.0

    @property
    def ratio(self) -> Array:
        """(n,) power over noise: F distributed about 1 where nothing but noise is there."""
        with np.errstate(divide="ignore", invalid="ignore"):
            nothing = np.where(self.power > 0, np.inf, 1.0)
            return np.asarray(np.where(self.noise > 0, self.power / self.noise, nothing))


@dataclass(frozen=True)
class BestLinearApproximation:
    """G(f) under a random-phase multisine or another broadband signal: the G that makes E|y - G u|^2 least.

    Args:
        frequency: (n_f,) Hz, increasing.
        gain: (n_f,) complex, output unit per input unit.
        variance: (n_f,) E|error|^2 of the gain, by noise and distortion together; its real and imaginary parts have
            half of it each and are not correlated.
        degrees: (n_f,) degrees of freedom of `variance`, counted in real numbers.
        noise_variance: (n_f,) the noise's share of `variance`, or None where it cannot be separated.
        test: what was done.
        method: how it was found, in a few words.
        origin: of the records.
        amplitude: (n_f,) of the input's lines (root mean square over the realisations), in its unit.
        mean: of the output, in its unit.
        mean_variance: of `mean`.
        total: noise and distortion together on the excited lines, or None where only noise can be seen.
        noise: its noise, or None where it cannot be separated.
        on_lines: distortion on the excited lines, which disturbs the gain.
        even, odd: distortion by even and odd powers, each on the lines where it alone can be; None where no such lines
            were left free.
        distortion: the whole of it around each excited line, even and odd.
        apart: places, from low frequency up, of gains that share no data; None where no two gains do.
    """

    frequency: Array
    gain: Complex
    variance: Array
    degrees: Array
    noise_variance: Array | None
    test: MultisineTest
    method: str
    origin: str
    amplitude: Array
    mean: float
    mean_variance: float
    total: Level | None = None
    noise: Level | None = None
    on_lines: Distortion | None = None
    even: Distortion | None = None
    odd: Distortion | None = None
    distortion: Level | None = None
    apart: tuple[int, ...] | None = None

    def __post_init__(self) -> None:
        n_f = np.size(self.frequency)
        for name in ("frequency", "gain", "variance", "degrees", "noise_variance", "amplitude"):
            value = getattr(self, name)
            if value is None:
                continue
            array = np.array(value, dtype=np.complex128 if name == "gain" else np.float64)
            array.setflags(write=False)
            object.__setattr__(self, name, array)
            if array.shape != (n_f,):
                raise BadInput(f"best linear approximation: {name} needs shape ({n_f},), got {array.shape}")
            if not np.isfinite(array).all():
                raise BadInput(f"best linear approximation: every number of {name} must be finite")
        if n_f == 0 or self.frequency[0] <= 0 or np.any(np.diff(self.frequency) <= 0):
            raise BadInput("best linear approximation: frequencies must be positive and increase")
