"""The commands of thesis Section 2.1.1 against their definition."""

import numpy as np
import pytest

from pysim.identify import SteppedSine, command, stepped_sine
from pysim.types import BadInput, SineTest

TEST = SineTest(75.0, 5.0, "a", "y")


def test_command_follows_the_thesis_step_by_step() -> None:
    signal = command(SineTest(-50.0, 10.0, "a", "y"), 3.0, SteppedSine())
    np.testing.assert_allclose(signal.value(np.array([-1.0, 0.0, 0.49, 0.75, 1.0, 1.99])), [0, 0, 0, -25, -50, -50])
    t = np.linspace(2.0, 4.0, 101)
    np.testing.assert_allclose(signal.value(t), -50 + 10 * np.sin(2 * np.pi * 3.0 * (t - 2.0)), atol=1e-12)


def test_rate_input_follows_the_command() -> None:
    assert dict(stepped_sine(TEST, 8.0, rate_input="a_t").rates) == {"a_t": "a"}
    assert not stepped_sine(TEST, 8.0).rates


def test_records_whole_periods_after_settling() -> None:
    plan = SteppedSine(settle_time=0.5, settle_periods=2, fit_periods=3, points=20)
    slow = stepped_sine(TEST, 0.5, plan=plan).times
    fast = stepped_sine(TEST, 30.0, plan=plan).times
    assert slow[0] == pytest.approx(2.0 + 2 / 0.5)
    assert fast[0] == pytest.approx(2.0 + 15 / 30.0)
    for times, f in ((slow, 0.5), (fast, 30.0)):
        assert times.size == 60
        np.testing.assert_allclose(np.diff(times), 1 / (20 * f), rtol=1e-9)


def test_no_rest_and_no_hold_leave_a_ramp_and_a_sine() -> None:
    signal = command(SineTest(10.0, 1.0, "a", "y"), 1.0, SteppedSine(rest=0.0, hold=0.0))
    np.testing.assert_allclose(signal.value(np.array([0.0, 0.25, 0.5, 0.75])), [0.0, 5.0, 10.0, 11.0])


@pytest.mark.parametrize(("amplitude", "frequency"), [(0.0, 1.0), (5.0, 0.0), (5.0, -1.0), (np.nan, 1.0)])
def test_refuses_a_test_without_a_sine(amplitude: float, frequency: float) -> None:
    with pytest.raises(BadInput, match="must be positive"):
        stepped_sine(SineTest(25.0, amplitude, "a", "y"), frequency)


@pytest.mark.parametrize(
    "wrong",
    [{"rest": -1.0}, {"ramp": 0.0}, {"fit_periods": 0}, {"settle_periods": 0}, {"settle_limit": -1.0}, {"points": 4}],
)
def test_refuses_impossible_plans(wrong: dict[str, float]) -> None:
    with pytest.raises(BadInput, match="stepped sine"):
        SteppedSine(**wrong)  # type: ignore[arg-type]
