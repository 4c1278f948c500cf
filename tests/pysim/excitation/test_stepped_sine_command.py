import math

import numpy as np
import pytest

from pysim.excitation import LeadIn, SteppedSineCommand
from pysim.types import BadInput


def test_is_equation_2_1_from_the_onset_to_the_end() -> None:
    test = SteppedSineCommand(-50.0, 10.0, 3.0, periods=6, lead=LeadIn(0.1, 0.2, 0.3))
    assert (test.onset, test.end) == (pytest.approx(0.6), pytest.approx(2.6))
    t = np.linspace(test.onset, test.end - 1e-9, 500)
    np.testing.assert_allclose(test.signal().value(t), -50 + 10 * np.sin(2 * np.pi * 3 * (t - 0.6)), atol=1e-11)


def test_may_have_no_end() -> None:
    test = SteppedSineCommand(0.0, 1.0, 1.0, periods=math.inf)
    assert test.duration == math.inf
    assert test.signal().value(np.array([1e5 + 0.25])) == pytest.approx([1.0])


@pytest.mark.parametrize(
    "wrong", [{"amplitude": 0.0}, {"frequency": -1.0}, {"periods": 0.0}, {"offset": math.nan}, {"frequency": math.inf}]
)
def test_refuses_what_is_no_sine(wrong: dict[str, float]) -> None:
    with pytest.raises(BadInput, match="stepped sine"):
        SteppedSineCommand(**({"offset": 0.0, "amplitude": 1.0, "frequency": 1.0} | wrong))
