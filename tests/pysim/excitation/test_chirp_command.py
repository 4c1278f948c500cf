import numpy as np
import pytest

from pysim.excitation import Chirp
from pysim.types import BadInput


@pytest.mark.parametrize(("start", "stop"), [(0.1, 30.0), (30.0, 0.1)])
def test_is_equation_2_2(start: float, stop: float) -> None:
    test = Chirp(50.0, 20.0, start, stop, 60.0)
    t = np.linspace(0.0, 60.0, 2001)[:-1]
    rate = (stop - start) / 60.0
    expected = 20 * np.sin(2 * np.pi * (start + rate / 2 * t) * t) + 50
    np.testing.assert_allclose(test.signal().value(t + 2.0), expected, atol=1e-9)  # phases of 5700 rad in 16 digits
    assert test.rate == pytest.approx(rate)


def test_runs_at_the_stop_frequency_at_its_end() -> None:
    test = Chirp(0.0, 1.0, 0.0, 25.0, 40.0)
    h = 1e-3
    t = test.end - np.array([2 * h, h, 0.0]) - 1e-9
    value, rate = test.signal().value(t), test.signal().derivative(t)
    angle = np.unwrap(np.arctan2(value, rate / (2 * np.pi * 25.0)))
    assert (angle[2] - angle[0]) / (2 * h) / (2 * np.pi) == pytest.approx(25.0, rel=1e-3)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"sweep": 0.0}, "the sweep is 0 s"),
        ({"amplitude": -1.0}, "the amplitude"),
        ({"start_hz": -0.1}, "not negative"),
        ({"stop_hz": 0.1}, "use a stepped sine"),
    ],
)
def test_refuses_what_is_no_chirp(wrong: dict[str, float], words: str) -> None:
    good = {"offset": 0.0, "amplitude": 1.0, "start_hz": 0.1, "stop_hz": 30.0, "sweep": 10.0}
    with pytest.raises(BadInput, match=words):
        Chirp(**(good | wrong))
