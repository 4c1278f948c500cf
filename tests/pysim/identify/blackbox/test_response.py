"""Complex gains: their covariance and their weights."""

import numpy as np
import pytest

from pysim.identify.blackbox import ComplexResponse, complex_response
from pysim.identify.blackbox.response import whiten, whitening
from pysim.types import BadInput, FrequencyResponse, SineTest

TEST = SineTest(0.0, 5.0, "u", "y")


def test_covariance_agrees_with_drawn_amplitudes_and_phases() -> None:
    amplitude, phase = 3.0, -2.0
    polar = np.array([[4e-4, 1e-5, 0.0], [1e-5, 1e-4, 0.0], [0.0, 0.0, 1.0]])
    response = FrequencyResponse(
        np.array([1.0]), np.array([amplitude / 5]), np.array([phase]), TEST, "measured", covariance=polar[None]
    )
    found = complex_response(response)
    assert found.values[0] == pytest.approx(0.6 * np.exp(-2j))
    draws = np.random.default_rng(3).multivariate_normal([amplitude, phase], polar[:2, :2], size=200_000)
    gains = draws[:, 0] / 5 * np.exp(1j * draws[:, 1])
    assert found.covariance is not None
    np.testing.assert_allclose(found.covariance[0], np.cov(gains.real, gains.imag), rtol=0.02, atol=2e-7)


def test_white_deviations_have_unit_covariance() -> None:
    covariance = np.array([[[4.0, 1.5], [1.5, 1.0]], [[0.01, 0.0], [0.0, 9.0]]])
    response = ComplexResponse(np.array([1.0, 2.0]), np.array([1 + 1j, 2.0]), covariance)
    roots = whitening(response, "covariance")
    np.testing.assert_allclose(roots @ covariance @ np.swapaxes(roots, 1, 2), np.tile(np.eye(2), (2, 1, 1)), atol=1e-12)
    white = whiten(roots, np.array([[2.0 + 0j], [0.1 + 3j]])).reshape(2, 2)
    np.testing.assert_allclose(np.sum(white**2, axis=1), [4 * np.linalg.inv(covariance[0])[0, 0], 2.0])


def test_relative_weights_count_a_percent_alike_everywhere() -> None:
    response = ComplexResponse(np.array([1.0, 2.0]), np.array([10j, 0.1]))
    white = whiten(whitening(response, "relative"), 0.01 * response.values[:, None]).reshape(2, 2)
    np.testing.assert_allclose(np.linalg.norm(white, axis=1), 0.01)
    uniform = whitening(response, "uniform")
    np.testing.assert_allclose(uniform[0], uniform[1])


@pytest.mark.parametrize(
    ("values", "covariance", "weights", "words"),
    [
        ([1.0, 1.0], None, "covariance", "has no covariance; use the weights uniform"),
        ([1.0, 1.0], np.zeros((2, 2, 2)), "covariance", "not positive definite"),
        ([1.0, 0.0], None, "relative", "a gain of zero"),
        ([1.0, 1.0], None, "best", "'best' is not known"),
    ],
)
def test_refuses_weights_that_cannot_be(values: list[float], covariance: object, weights: str, words: str) -> None:
    response = ComplexResponse(np.array([1.0, 2.0]), np.array(values), covariance)  # type: ignore[arg-type]
    with pytest.raises(BadInput, match=words):
        whitening(response, weights)


@pytest.mark.parametrize(
    ("frequency", "values", "words"),
    [
        ([1.0, 1.0], [1.0, 1.0], "increase"),
        ([1.0], [1.0, 2.0], "shape"),
        ([1.0], [np.nan], "finite"),
        ([], [], "pos"),
        ([1.0], [0.0], "zero at every"),
    ],
)
def test_refuses_damaged_responses(frequency: list[float], values: list[float], words: str) -> None:
    with pytest.raises(BadInput, match=words):
        ComplexResponse(np.array(frequency), np.array(values))
