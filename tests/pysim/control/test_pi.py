import copy
import math
from typing import Any

import numpy as np
import pytest
from scipy.signal import lfilter

from pysim.control import PI
from pysim.types import BadInput


def run(controller: PI, errors: np.ndarray, track: float = 0.0, active: float = 1.0) -> np.ndarray:
    return np.array([controller.step(0.0, (e, 0.0, track, active))[0] for e in errors])


def test_difference_equation_is_that_of_the_thesis() -> None:
    K_p, T_i, dt = 1.98, 0.03, 1e-3
    errors = np.append(0.0, np.random.default_rng(1).standard_normal(200))
    wanted = lfilter([K_p, K_p / T_i * dt - K_p], [1.0, -1.0], errors)  # Eq. 5.33
    assert run(PI(K_p, T_i, dt), errors) == pytest.approx(wanted, rel=1e-12)


def test_a_step_gives_gain_and_ramp() -> None:
    out = run(PI(2.0, 0.5, 0.01), np.append(0.0, np.ones(51)))
    assert out[1] == pytest.approx(2.0)
    assert out[51] == pytest.approx(2.0 + 2.0 * 50 * 0.01 / 0.5)


def test_output_leaves_its_limit_with_the_first_sample_that_points_inwards() -> None:
    controller = PI(1.0, 0.1, 0.01, low=-1.0, high=1.0)
    assert run(controller, np.full(1000, 5.0))[-1] == 1.0
    assert controller.step(0.0, (4.9, 0.0, 0.0, 1.0))[0] == pytest.approx(1.0)  # integral 0.5 beats the step of -0.1
    assert controller.step(0.0, (-0.1, 0.0, 0.0, 1.0))[0] < 1.0


def test_it_takes_over_without_a_jump() -> None:
    controller = PI(10.0, 0.5, 0.01)
    assert run(controller, np.full(5, 3.0), track=0.7, active=0.0).tolist() == [0.7] * 5
    assert controller.step(0.0, (3.0, 0.0, 0.7, 1.0))[0] == pytest.approx(0.7 + 10.0 * 0.01 / 0.5 * 3.0)


def test_it_is_active_above_a_half_as_its_twin_is() -> None:
    pi = PI(2.0, 0.1, 0.01)
    assert [pi.step(0.0, (1.0, 0.0, 0.25, active))[0] for active in (0.0, 0.3, 0.5)] == [0.25, 0.25, 0.25]
    assert pi.step(0.0, (1.0, 0.0, 0.25, 0.51))[0] > 0.25


def test_a_copy_goes_on_alike() -> None:
    errors = np.random.default_rng(2).standard_normal(100)
    whole = run(PI(1.0, 0.2, 0.01), errors)
    first = PI(1.0, 0.2, 0.01)
    run(first, errors[:40])
    second = copy.deepcopy(first)
    assert run(second, errors[40:]).tolist() == whole[40:].tolist()


@pytest.mark.parametrize(
    ("values", "told"),
    [
        ({"T_i": 0.0}, "positive times"),
        ({"dt": -1.0}, "positive times"),
        ({"K_p": math.nan}, "finite gain"),
        ({"K_p": "1"}, "PI: K_p is '1'; give a number"),
        ({"T_i": None}, "PI: T_i is None; give a number"),
        ({"start": True}, "PI: start is True; give a number"),
        ({"low": 1.0, "high": -1.0}, "in this order"),
        ({"high": 1.0, "start": 2.0}, "in this order"),
    ],
)
def test_wrong_numbers_are_refused(values: dict[str, Any], told: str) -> None:
    with pytest.raises(BadInput, match=told):
        PI(**{"K_p": 1.0, "T_i": 1.0, "dt": 0.1, **values})
