import math

import numpy as np
import pytest

import fmu_build
from pysim.control.tuning import coupled_poles, damping_gain, growth, steady_above
from pysim.types import BadInput
from validation.load_circuit.linearised import linearised

K, K_SV = 60e-6 / (2 * math.pi), 1.863e-5


def test_poles_are_those_of_the_bench_linearised_by_its_own_derivatives() -> None:
    """At 20 rad/s without load; the valve's opening there is half of its slope in pressure."""
    speed = 20.0
    opening = -K * speed / (K_SV * math.sqrt(310e5 / 875))
    states = {
        "rig.inertiaS.w": speed,
        "rig.spool.u": opening,
        "rig.volume_sA.p": 60e5,
        "rig.volume_sB.p": 60e5,
        "load.I": opening + K / 0.0035 * speed,
    }
    path = fmu_build.build("HydraulicTestBench.LoadCircuit.TestBench")
    found = linearised(path, states, {"omegaS_ref": speed, "pL_ref": 0.0})
    all_poles = np.linalg.eigvals(found.a)
    for pole in coupled_poles(1.98e-9, 0.03, speed=speed):
        assert np.abs(all_poles - pole).min() < 0.02 * abs(pole) + 0.05


def test_without_friction_and_control_two_springs_hold_one_mass() -> None:
    poles = coupled_poles(1e-30, 0.03, speed=1e-9, friction=False)
    resonance = K * math.sqrt(2 * 1.4e9 * (1 / 1.52e-3 + 1 / 1.01e-3) / 0.0733)
    assert np.sort(poles.imag)[-2:].min() == pytest.approx(resonance, rel=1e-3)


def test_doubling_the_load_gain_calms_the_shaft_at_lower_speed() -> None:
    """Table 6.1: the manual retuning; what the two plants by themselves do not show."""
    matlab, manual = steady_above(1.01e-9, 0.023), steady_above(1.98e-9, 0.03)
    assert matlab > manual > steady_above(4e-9, 0.03)
    assert growth(1.98e-9, 0.03, speed=0.97 * manual) > 0 > growth(1.98e-9, 0.03, speed=1.03 * manual)


def test_best_gain_is_a_minimum() -> None:
    best = damping_gain(0.03, speed=8.0)
    assert growth(best, 0.03, speed=8.0) < min(growth(f * best, 0.03, speed=8.0) for f in (0.8, 1.25))
    assert growth(best, 0.03, speed=8.0) < 0


def test_wrong_numbers_are_refused() -> None:
    with pytest.raises(BadInput, match="positive numbers"):
        coupled_poles(1e-9, 0.03, speed=0.0)
