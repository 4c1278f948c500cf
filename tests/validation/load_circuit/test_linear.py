"""The thesis' transfer functions at rest and at their resonance, and the response of a small system known by hand."""

import numpy as np
import pytest

from validation.load_circuit.linear import K_M, K_P, load_pressure, load_speed, pump, supply_pressure, supply_speed
from validation.load_circuit.linearised import Linear

REST = np.array([1e-6j])


def test_gains_at_rest() -> None:
    """The valve's flow over its own leakage gain, the motor's speed at that flow, the pump's flow over the motor's."""
    assert load_pressure(REST)[0] == pytest.approx(0.0035 / 5.61e-12, rel=1e-5)
    leak = 5.61e-12 * 0.26 / K_M**2
    assert load_speed(REST)[0] == pytest.approx(0.0035 / K_M / (1 + leak), rel=1e-5)
    assert pump(REST)[0] == pytest.approx(62091 / 60185, rel=1e-5)
    assert supply_speed(REST)[0] == pytest.approx(62091 / 60185 * K_P / K_M, rel=1e-5)


def test_closed_circuit_integrates_the_pump_s_flow() -> None:
    s = np.array([0.01j])
    assert (supply_pressure(s) * s)[0] == pytest.approx(62091 / 60185 * K_P * 2 * 1.4e9 / 1.52e-3, rel=1e-3)


def test_shaft_on_the_oil_has_its_resonance() -> None:
    """Undamped at the root of 2 beta K^2/(V J): 7.6 Hz."""
    omega = np.sqrt(2 * 1.4e9 * K_M**2 / (1.52e-3 * 0.0733))
    around = 1j * omega * np.array([0.9, 1.0, 1.1])
    gain = np.abs(supply_speed(around) / pump(around))
    assert omega / (2 * np.pi) == pytest.approx(7.6, abs=0.1)
    assert gain[1] > 2 * max(gain[0], gain[2])
    assert gain[1] == pytest.approx(K_P / K_M * omega * 0.0733 / 0.26, rel=1e-6)


def test_response_of_a_chain_and_of_a_part_of_it() -> None:
    """x' = -2x + u, y' = x - 3y: y/u is 1/((s+2)(s+3)); with y alone kept nothing comes from u."""
    linear = Linear(("x", "y"), ("u",), np.array([[-2.0, 0.0], [1.0, -3.0]]), np.array([[1.0], [0.0]]))
    s = np.array([0.5j, 4j])
    assert linear.response(s, ("x", "y"), "u", {"y": 2.0}) == pytest.approx(2 / ((s + 2) * (s + 3)))
    assert linear.response(s, ("y",), "u", {"y": 1.0}) == pytest.approx([0, 0])
    assert linear.response(s, ("x",), "u", {"x": 1.0, "y": 5.0}) == pytest.approx(1 / (s + 2))
