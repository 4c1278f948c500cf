"""The suggested order is the true one, for known and unknown noise, with and without dead time."""

import numpy as np
import pytest

from pysim.identify.blackbox import ComplexResponse, suggest_orders
from pysim.types import BadInput
from tests.pysim.identify.blackbox.systems import exact, from_roots, noisy, pairs

F = np.geomspace(0.2, 25, 40)


@pytest.mark.parametrize("known", [True, False])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_finds_three_poles_and_a_zero(seed: int, known: bool) -> None:
    data = noisy(from_roots([-20.0], [-8.0, *pairs(-3 + 60j)], 1500.0), F, 0.003, seed)
    data = data if known else ComplexResponse(F, data.values)
    found = suggest_orders(data, most_poles=4)
    assert found.noise_trusted == known
    assert (found.suggested.fit.structure.poles, found.suggested.fit.structure.zeros) == (3, 1)
    assert (found.by_bic.fit.structure.poles, found.by_bic.fit.structure.zeros) == (3, 1)
    assert [c.aicc for c in found.candidates] == sorted(c.aicc for c in found.candidates)


@pytest.mark.slow
def test_tells_a_dead_time_from_another_lag() -> None:
    right = 0
    for seed in range(4):  # AICc keeps a needless zero about once in ten
        data = noisy(from_roots([], [-12.0, -30.0], 360.0, dead_time=0.03), F[::2], 0.003, seed)
        found = suggest_orders(data, most_poles=3, dead_time_max=0.06).suggested.fit
        right += (found.structure.poles, found.structure.zeros, found.structure.delayed) == (2, 0, True)
        assert found.structure.delayed
        assert found.function.dead_time == pytest.approx(0.03, abs=0.004)
    assert right >= 3


def test_noise_is_not_trusted_where_nothing_explains_the_response() -> None:
    true = noisy(from_roots([], pairs(-3 + 60j), 3600.0), F, 0.003, seed=5)
    assert true.covariance is not None
    tight = ComplexResponse(F, true.values, true.covariance / 100)
    found = suggest_orders(tight, most_poles=3)
    assert not found.noise_trusted
    assert found.suggested.fit.structure.poles == 2


def test_criteria_by_hand() -> None:
    data = exact(from_roots([], [-5.0], 5.0), F)
    rough = ComplexResponse(F, data.values * (1 + 0.01 * np.cos(np.arange(40))))
    found = suggest_orders(rough, most_poles=1)
    (only,) = found.candidates
    n, k = 80, 3  # measured numbers; b0, a0 and the size of the noise
    likelihood = n * np.log(only.fit.misfit / n)
    assert only.aicc == pytest.approx(likelihood + 2 * k + 2 * k * (k + 1) / (n - k - 1))
    assert only.bic == pytest.approx(likelihood + k * np.log(n))


def test_more_poles_than_the_points_allow_are_not_even_listed() -> None:
    data = exact(from_roots([], [-5.0], 5.0), np.array([0.3, 1.0, 3.0]))
    found = suggest_orders(data, most_poles=10**9)
    assert max(c.fit.structure.parameters for c in found.candidates) == 3  # of six numbers


def test_refuses_too_few_points() -> None:
    with pytest.raises(BadInput, match="too few for any structure"):
        suggest_orders(exact(from_roots([], [-5.0], 5.0), np.array([1.0, 2.0])))
