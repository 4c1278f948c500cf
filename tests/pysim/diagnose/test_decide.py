"""Chance, price and shares against closed forms."""

import math

import numpy as np
import pytest
from scipy import stats

from pysim.diagnose import decide
from pysim.diagnose.screen import Footprint
from pysim.identify.greybox.evaluation import Evaluation
from tests.pysim.diagnose.toy import CATALOGUE


def footprint(name: str, left: np.ndarray, gain: float) -> Footprint:
    return Footprint(CATALOGUE[name], {}, left, left, float(left @ left), gain, 1.0)


def test_one_direction_of_either_sign_is_chi_square() -> None:
    left = np.array([0.0, 3.0, 4.0])
    found = decide.chance([footprint("toy.bias", left, 4.0)], scale=1.0, seed=1, draws=200_000)
    assert found.limit == pytest.approx(stats.chi2.isf(decide.ALARM, 1), rel=0.03)
    assert found.p_value == pytest.approx(stats.chi2.sf(4.0, 1), rel=0.03)


def test_one_sign_alone_halves_the_chance_and_noise_scales_it() -> None:
    left = np.array([1.0, 2.0, 2.0])
    found = decide.chance([footprint("toy.friction", left, 6.0)], scale=1.5, seed=1, draws=200_000)
    assert found.limit == pytest.approx(1.5 * stats.chi2.isf(2 * decide.ALARM, 1), rel=0.03)
    assert found.p_value == pytest.approx(0.5 * stats.chi2.sf(4.0, 1), rel=0.03)


def test_orthogonal_candidates_add_their_chances_and_equal_ones_do_not() -> None:
    one, other = np.array([1.0, 0.0]), np.array([0.0, 1.0])
    gain = 9.0
    apart = decide.chance([footprint("toy.bias", v, gain) for v in (one, other)], scale=1.0, seed=2, draws=200_000)
    same = decide.chance([footprint("toy.bias", one, gain)] * 2, scale=1.0, seed=2, draws=200_000)
    single = stats.chi2.sf(gain, 1)
    assert apart.p_value == pytest.approx(1 - (1 - single) ** 2, rel=0.06)
    assert same.p_value == pytest.approx(single, rel=0.08)


def test_nothing_to_try_is_no_evidence() -> None:
    assert decide.chance([], scale=1.0, seed=0).p_value == 1.0


def test_score_and_share() -> None:
    assert decide.score(150.0, 100.0, 2, 1000) == pytest.approx(50 - 2 * math.log(1000))
    assert decide.explained(30.0, 160.0, 100) == pytest.approx(0.5)
    assert decide.explained(80.0, 160.0, 100) == 1.0
    assert decide.explained(3.0, 90.0, 100) == 0.0  # nothing was avoidable


def test_excess_and_inflation() -> None:
    residual = np.full(202, math.sqrt(1.2 * 200 / 202))
    point = Evaluation(np.zeros(2), float(residual @ residual), residual, np.zeros((202, 2)))
    assert decide.inflation(point) == pytest.approx(1.2)
    assert decide.excess(point) == pytest.approx(0.2 * 200 / math.sqrt(400))
