import numpy as np
import pytest

from pysim.rig import HeaveTest
from validation.rig_control.ways import _drum_speed, _nearest, _share


def test_drum_turns_against_the_vessel() -> None:
    test, at = HeaveTest(length=20.0), np.linspace(0, 23, 50)
    assert _drum_speed(test).value(at) == pytest.approx(-test.velocity().value(at) / 0.03, abs=1e-12)


def test_a_row_may_show_either_sample_and_no_third() -> None:
    before, after = np.array([1.0, 2.0, 4.0]), np.array([2.0, 4.0, 8.0])
    assert _nearest(np.array([1.0, 4.0, 4.0]), after, before) == 0.0
    assert _nearest(np.array([1.0, 3.0, 4.0]), after, before) == pytest.approx(1 / 8)
    assert _share(np.array([0.5, -2.0]), np.array([-8.0, 1.0])) == pytest.approx(0.25)
