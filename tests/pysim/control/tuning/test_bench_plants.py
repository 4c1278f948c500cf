import numpy as np
import pytest

from pysim.control.tuning import load_pressure_plant, shaft_speed_plant
from validation.load_circuit import linear

OMEGA = np.geomspace(0.1, 500, 50)


def test_they_are_the_transfer_functions_that_were_compared_with_the_fmu() -> None:
    s = (1j * OMEGA).astype(np.complex128)
    assert load_pressure_plant().response(OMEGA) == pytest.approx(linear.load_pressure(s), rel=1e-12)
    assert shaft_speed_plant().response(OMEGA) == pytest.approx(linear.supply_speed(s), rel=1e-12)


def test_steady_gains() -> None:
    slow = np.array([1e-6])
    assert abs(load_pressure_plant().response(slow)[0]) == pytest.approx(0.0035 / 5.61e-12, rel=1e-6)
    assert abs(shaft_speed_plant().response(slow)[0]) == pytest.approx(62091 / 60185 * 0.0066 / 9.5493e-6, rel=1e-6)
    assert (load_pressure_plant(K_qp=0.0).poles().real == 0).sum() == 1


def test_friction_that_falls_with_speed_excites() -> None:
    assert (shaft_speed_plant().poles().real < 0).all()
    assert (shaft_speed_plant(c=-1.4).poles().real > 0).sum() == 2
