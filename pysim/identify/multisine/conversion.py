"""A best linear approximation as a frequency response, to compare it with stepped sines or to fit models to it."""

from __future__ import annotations

import math

import numpy as np

from pysim.types import BestLinearApproximation, FrequencyResponse, SineTest


def as_frequency_response(bla: BestLinearApproximation) -> FrequencyResponse:
    """Gain and unwrapped phase with their covariance, of points whose errors are independent, as a fit takes them.

    Where gains come from windows over neighbouring lines only those in `apart` are in it.

    Returns:
        a response of a test whose sine has the multisine's power, sqrt(2) rms around the same offset; the covariance is
        to first order in error / gain, its rows and columns of the mean are those of the whole test, and it is None
        where the test did not tell how sure the mean is.
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
