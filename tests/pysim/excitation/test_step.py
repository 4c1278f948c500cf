import numpy as np
import pytest

from pysim.excitation import LeadIn, Step
from pysim.types import BadInput


def test_steps_at_the_onset_and_back() -> None:
    test = Step(50.0, -20.0, 1.5, back=True)
    np.testing.assert_allclose(test.signal().value(np.array([1.999, 2.0, 3.499, 3.5, 4.999])), [50, 30, 30, 50, 50])
    assert (test.end, test.duration) == (5.0, 5.5)


def test_without_back_the_new_level_is_the_last() -> None:
    test = Step(0.0, 10.0, 1.0, lead=LeadIn(rest=1.0, ramp=0.0, hold=0.0, ramp_down=0.0))
    np.testing.assert_allclose(test.signal().value(np.array([0.5, 1.0, 100.0])), [0.0, 10.0, 10.0])
    assert test.duration == 2.0


def test_a_ramp_without_a_hold_ends_at_the_level_to_step_from() -> None:
    test = Step(5.0, 2.0, 1.0, lead=LeadIn(rest=1.0, ramp=0.5, hold=0.0))
    np.testing.assert_allclose(test.signal().value(np.array([1.5 - 1e-9, 1.5])), [5.0, 7.0], atol=1e-7)


def test_refuses_what_is_no_step() -> None:
    with pytest.raises(BadInput, match="the height is 0"):
        Step(0.0, 0.0, 1.0)
    with pytest.raises(BadInput, match="no level to step from"):
        Step(0.0, 1.0, 1.0, lead=LeadIn.none())
    with pytest.raises(BadInput, match="from 0, not from its offset 5; give a ramp or a hold"):
        Step(5.0, 2.0, 1.0, lead=LeadIn(rest=1.0, ramp=0.0, hold=0.0))
    with pytest.raises(BadInput, match="the length is 0 s"):
        Step(0.0, 1.0, 0.0)
