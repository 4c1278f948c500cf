"""Conversion of a best linear approximation to a frequency response, for comparison with stepped sines or for fits."""

from __future__ import annotations

import math

import numpy as np

from pysim.types import BestLinearApproximation, FrequencyResponse, SineTest


def as_frequency_response(bla: BestLinearApproximation) -> FrequencyResponse:
    """Gain and unwrapped phase with their covariance, at points with independent errors, as a fit assumes.

    If gains come from windows over neighbouring lines, only those in `apart` are used.

    Returns:
        a response of a test with a sine of the multisine's power: amplitude sqrt(2) rms, same offset. The covariance is
        to first order in error / gain, with the variance of the mean of the whole test; it is None if that variance is
        unknown.
    """
    test = SineTest(bla.test.offset, math.sqrt(2) * bla.test.rms, bla.test.input, bla.test.output)
    places = list(range(bla.gain.size) if bla.apart is None else bla.apart)
    gain, half = np.abs(bla.gain[places]), bla.variance[places] / 2
    covariance = np.zeros((gain.size, 3, 3))
    covariance[:, 0, 0] = half * test.amplitude**2
    covariance[:, 1, 1] = half / gain**2
    covariance[:, 2, 2] = bla.mean_variance
    return FrequencyResponse(
        bla.frequency[places],
        gain,
        np.unwrap(np.angle(bla.gain))[places],
        test,
        bla.origin,
        mean=np.full(gain.size, bla.mean),
        covariance=covariance if math.isfinite(bla.mean_variance) else None,
    )
