import math

import numpy as np
import pytest

from pysim.control.tuning import Plant
from pysim.types import BadInput


def test_response_of_a_lag_with_dead_time() -> None:
    plant = Plant((3.0,), (0.5, 1.0), delay=0.1)
    omega = np.array([0.1, 2.0, 30.0])
    assert plant.response(omega) == pytest.approx(3 / (1 + 0.5j * omega) * np.exp(-0.1j * omega), rel=1e-13)


def test_in_series_gains_multiply_and_dead_times_add() -> None:
    first, second = Plant((2.0,), (1.0, 1.0), 0.1, input_unit="rad"), Plant((1.0, 5.0), (1.0, 2.0, 3.0), 0.2)
    both = second.behind(first).delayed(0.3)
    omega = np.array([0.3, 4.0])
    wanted = first.response(omega) * second.response(omega) * np.exp(-0.3j * omega)
    assert both.response(omega) == pytest.approx(wanted, rel=1e-13)
    assert both.delay == pytest.approx(0.6)
    assert both.input_unit == "rad"
    assert sorted(both.poles().real) == pytest.approx([-1, -1, -1])


def test_a_sharp_resonance_is_seen() -> None:
    plant = Plant((1.0,), (1.0, 2e-4, 1.0))  # damping ratio 1e-4: a peak of 5000
    assert np.abs(plant.response(plant.frequencies())).max() == pytest.approx(5000, rel=1e-3)


@pytest.mark.parametrize(
    ("values", "told"),
    [
        (((0.0,), (1.0, 1.0), 0.0), "numerator"),
        (((1.0,), (math.nan,), 0.0), "denominator"),
        (((1.0, 0.0, 0.0), (1.0, 1.0), 0.0), "at least that degree"),
        (((1.0,), (1.0, 1.0), -1.0), "zero or more"),
    ],
)
def test_what_is_no_plant_is_refused(values: tuple[tuple[float, ...], tuple[float, ...], float], told: str) -> None:
    with pytest.raises(BadInput, match=told):
        Plant(*values)
