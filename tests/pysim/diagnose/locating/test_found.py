"""Evidence and shares, against their closed forms in a linear model."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.found import Base
from pysim.identify.greybox.residuals import Point

N = 4000


def point(residual: np.ndarray, columns: int) -> Point:
    slopes = np.random.default_rng(3).standard_normal((residual.size, columns))
    return Point(np.zeros(columns), float(residual @ residual), residual, slopes)


@pytest.fixture
def base() -> Base:
    """Residuals of twice the noise, and two parameters."""
    rng = np.random.default_rng(1)
    return Base.of(Fitted(SimpleNamespace(), point(2 * rng.standard_normal(N), 2)))


def effect(cost: float, numbers: int) -> SimpleNamespace:
    at = SimpleNamespace(point=SimpleNamespace(cost=cost, x=np.zeros(2 + numbers)))
    return SimpleNamespace(at=at)


def test_what_parameters_can_do_is_not_left(base: Base) -> None:
    slopes, residual = base.at.point.jacobian, base.at.point.residual
    best = np.linalg.lstsq(slopes, -residual, rcond=None)[0]
    assert base.left == pytest.approx(float(np.sum((residual + slopes @ best) ** 2)))


def test_an_effect_that_leaves_noise_takes_all_at_schwarz_price(base: Base) -> None:
    named = base.named(effect(N - 3.0, 1))
    assert named.evidence == pytest.approx(0.5 * N * math.log(base.left / (N - 3)) - 0.5 * math.log(N))
    assert named.share == pytest.approx(1.0, abs=1e-3)


def test_an_effect_of_two_numbers_has_to_take_more(base: Base) -> None:
    one, two = base.named(effect(base.left - 100, 1)), base.named(effect(base.left - 100, 2))
    assert one.evidence - two.evidence == pytest.approx(0.5 * math.log(N))
    assert two.share < one.share == pytest.approx((100 - base.left / N) / (base.left - N), rel=0.03)


def test_what_is_not_worth_its_number_is_left_out(base: Base) -> None:
    """Schwarz's price is half the logarithm of 4000 rows, a fall of 8.3 of the sum of squares over the noise left."""
    noise = base.left / N
    little, much, more = (effect(base.left - fall * noise, 1) for fall in (7.0, 10.0, 50.0))
    assert [named.one for named in base.worth([little, much, more])] == [more, much]


def test_where_nothing_is_avoidable_the_share_is_nothing() -> None:
    quiet = Base.of(Fitted(SimpleNamespace(), point(0.5 * np.random.default_rng(1).standard_normal(N), 2)))
    assert quiet.named(effect(0.2 * N, 1)).share == 0
