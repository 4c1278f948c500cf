import math

import numpy as np
import pytest

from pysim.rig import StepTest, step_figures
from pysim.types import BadInput, Record


def answered(test: StepTest, share: np.ndarray, time: np.ndarray) -> Record:
    base = test.speed if test.kind == "speed" else test.load
    values = np.where(time < test.at, base, base + test.size * share)
    return Record(time, values[:, None], (test.output,), ("rad/s" if test.kind == "speed" else "Pa",))


def test_figures_of_a_lag_in_closed_form() -> None:
    test = StepTest("load", 40e5, load=10e5, at=2.0, length=20.0)
    time = np.arange(0.0, 22.0001, 0.001)
    found = step_figures(answered(test, 1 - np.exp(-(time - 2.0) / 0.5), time), test, band=0.02)
    assert found.rise_time == pytest.approx(0.5 * math.log(9), abs=1e-3)
    assert found.settling_time == pytest.approx(0.5 * math.log(50), abs=2e-3)
    assert found.overshoot == 0.0
    assert found.steady_error == pytest.approx(0.0, abs=1e-3)


def test_figures_of_an_oscillation_in_closed_form() -> None:
    """1 - exp(-t) cos 10 t, and an error of 1 percent that stays."""
    test = StepTest("speed", -30.0, speed=10.0, at=5.0, length=10.0)
    time = np.arange(0.0, 15.0001, 0.0005)
    since = time - 5.0
    found = step_figures(answered(test, 1.01 - np.exp(-since) * np.cos(10 * since), time), test)
    peak = (np.pi - math.atan(0.1)) / 10
    assert found.overshoot == pytest.approx(0.01 - math.exp(-peak) * math.cos(10 * peak), abs=1e-5)
    assert found.steady_error == pytest.approx(-0.3, abs=5e-3)
    assert step_figures(answered(test, 0 * time + 0.5, time), test).settling_time != found.settling_time
    assert math.isnan(step_figures(answered(test, 0 * time + 0.5, time), test).settling_time)
    assert math.isnan(step_figures(answered(test, 0 * time + 0.5, time), test).rise_time)


def test_references_ramp_up_and_one_steps() -> None:
    test = StepTest("load", 40e5, speed=30.0, load=5e5, at=3.0, length=1.0)
    run = test.experiment()
    at = np.array([0.0, 0.5, 2.0, 2.999, 3.001, 4.0])
    assert run.inputs["load.reference"].value(at) == pytest.approx([0, 2.5e5, 5e5, 5e5, 45e5, 45e5])
    assert run.inputs["speed.reference"].value(at) == pytest.approx([0, 15, 30, 30, 30, 30])
    assert run.times[-1] == pytest.approx(4.0)
    assert "load.speed" not in test.experiment("true").inputs


def test_a_step_where_the_ramps_end() -> None:
    reference = StepTest("speed", 20.0, speed=30.0, at=1.0, length=1.0).reference("speed")
    assert reference.value(np.array([0.5, 1.0, 1.001, 2.0])) == pytest.approx([15, 50, 50, 50])


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"kind": "angle"}, "'speed' or 'load'"),
        ({"size": 0.0}, "other than zero"),
        ({"at": 0.5}, "1 s or more"),
    ],
)
def test_wrong_tests_are_refused(values: dict[str, object], told: str) -> None:
    with pytest.raises(BadInput, match=told):
        StepTest(**{"kind": "speed", "size": 1.0, **values})  # type: ignore[arg-type]


def test_a_record_that_ends_too_soon_is_refused() -> None:
    test = StepTest("speed", 1.0)
    with pytest.raises(BadInput, match="ends before the step"):
        step_figures(answered(test, np.zeros(10), np.linspace(0, 5, 10)), test)
