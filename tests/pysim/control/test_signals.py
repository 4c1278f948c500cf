import math

import pytest

from pysim.control import Gain, Limiter, NormalizeSignal, ZeroSwitch, load_feed_forward, speed_feed_forward
from pysim.types import BadInput


def test_gain() -> None:
    assert Gain(-2.0).step(0.0, (3.0,)) == (-6.0,)
    with pytest.raises(BadInput, match="finite"):
        Gain(math.inf)


def test_feed_forward_of_the_thesis() -> None:
    K_s, K_P, K_L, K_qu = 9.5493e-6, 0.0066, 9.5493e-6, 0.0035  # thesis Table 5.1
    assert speed_feed_forward(K_s, K_P).step(0.0, (100.0,))[0] == pytest.approx(0.144686, rel=1e-5)
    assert load_feed_forward(K_L, K_qu).step(0.0, (100.0,))[0] == pytest.approx(-0.272837, rel=1e-5)
    assert speed_feed_forward(K_s, K_P).outputs[0].unit == "rad"


@pytest.mark.parametrize(("value", "limited"), [(-3.0, -1.0), (0.5, 0.5), (7.0, 2.0)])
def test_limiter(value: float, limited: float) -> None:
    assert Limiter(-1.0, 2.0).step(0.0, (value,)) == (limited,)


def test_limits_have_an_order() -> None:
    with pytest.raises(BadInput, match="exchange them"):
        Limiter(1.0, 1.0)


@pytest.mark.parametrize(("speed", "out"), [(0.5, (0.0, 0.0)), (-2.0, (4.0, 1.0)), (1.0, (4.0, 1.0))])
def test_zero_switch(speed: float, out: tuple[float, float]) -> None:
    assert ZeroSwitch(1.0).step(0.0, (4.0, speed)) == out


def test_a_threshold_is_not_negative() -> None:
    with pytest.raises(BadInput, match="zero or more"):
        ZeroSwitch(-1.0)


@pytest.mark.parametrize(("angle", "percent"), [(math.radians(7.5), 50.0), (-1.0, -100.0), (1.0, 100.0)])
def test_normalize(angle: float, percent: float) -> None:
    assert NormalizeSignal(math.radians(15)).step(0.0, (angle,))[0] == pytest.approx(percent)


def test_the_largest_angle_is_positive() -> None:
    with pytest.raises(BadInput, match="positive"):
        NormalizeSignal(0.0)
