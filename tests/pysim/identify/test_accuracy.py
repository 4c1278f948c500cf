"""Deviations and verdicts against hand calculation."""

import numpy as np
import pytest

from pysim.identify import frequency_deviations, response_difference, time_deviations
from pysim.types import BadInput, FrequencyResponse, SineTest


def response(
    gain: list[float], degrees: list[float], frequency: tuple[float, ...] = (0.1, 1.0, 10.0)
) -> FrequencyResponse:
    return FrequencyResponse(
        np.array(frequency), np.array(gain), np.radians(degrees), SineTest(25.0, 5.0, "a", "y"), origin="by hand"
    )


MEASURED = response([1.0, 1.0, 0.5], [0.0, -20.0, -100.0])


def test_the_four_numbers_by_hand() -> None:
    # twice the gain everywhere is no deviation: magnitudes count from 0.1 Hz
    simulated = response([2.0, 2.0 * 10 ** (-0.6 / 20), 1.0 * 10 ** (1.2 / 20)], [1.0, -22.0, -106.0])
    deviations = frequency_deviations(simulated, MEASURED)
    np.testing.assert_allclose([d.value for d in deviations], [0.6, 1.2, 3.0, 6.0], rtol=1e-12)
    assert [d.passes for d in deviations] == [False, True, True, True]
    absolute, _ = response_difference(simulated, MEASURED, reference_hz=None)
    np.testing.assert_allclose(absolute[0], 20 * np.log10(2.0))


def test_a_value_on_its_limit_passes_and_nan_does_not() -> None:
    limits = [d.criterion.limit for d in frequency_deviations(MEASURED, MEASURED)]
    assert limits == [0.5, 2.0, 5.0, 35.0]
    first = frequency_deviations(MEASURED, MEASURED)[0]
    assert type(first)(first.criterion, 0.5).passes
    assert not type(first)(first.criterion, 0.5000001).passes
    assert not type(first)(first.criterion, float("nan")).passes


def test_whole_turns_between_two_phases_do_not_count() -> None:
    # written as 0..360 degrees and unwrapped, the lag of 1, 22 and 106 degrees starts at 359
    turned = response([1.0, 1.0, 0.5], [359.0, 338.0, 254.0])
    for simulated in (turned, response([1.0, 1.0, 0.5], [-721.0, -742.0, -826.0])):
        _, phase = response_difference(simulated, MEASURED)
        np.testing.assert_allclose(phase, [-1.0, -2.0, -6.0], atol=1e-9)


def test_a_turn_within_the_band_stays_a_deviation() -> None:
    _, phase = response_difference(response([1.0, 1.0, 0.5], [0.0, -20.0, -460.0]), MEASURED)
    np.testing.assert_allclose(phase, [0.0, 0.0, -360.0], atol=1e-9)


def test_refuses_other_frequencies() -> None:
    with pytest.raises(BadInput, match="the same frequencies"):
        frequency_deviations(response([1.0] * 3, [0.0] * 3, (0.1, 1.0, 9.0)), MEASURED)


def test_time_deviations_in_percent_of_full_scale() -> None:
    mean, largest = time_deviations(np.array([0.1, -0.3]), np.array([0.0, 0.0]), full_scale=2.0)
    assert (mean.value, largest.value) == (pytest.approx(10.0), pytest.approx(15.0))
    assert (mean.criterion.limit, largest.criterion.limit) == (2.0, 10.0)
