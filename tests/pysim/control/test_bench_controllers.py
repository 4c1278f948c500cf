import copy
import math

import numpy as np
import pytest

from pysim.control import PI, CompensatedLoadController, LoadController, SpeedController, ValveCompensation
from pysim.types import BadInput

DT = 1e-3
LARGEST = math.radians(15)


def errors(seed: int, size: float, count: int = 400) -> np.ndarray:
    return size * np.random.default_rng(seed).standard_normal(count)


def test_speed_controller_is_feed_forward_and_pi() -> None:
    controller, pi = SpeedController(DT, K_p=1e-4, T_i=0.1), PI(1e-4, 0.1, DT)
    for e in errors(1, 5.0):
        percent, part = controller.step(0.0, (30.0, 30.0 - e))
        wanted = pi.step(0.0, (e, 0.0, 0.0, 1.0))[0]
        assert part == pytest.approx(wanted, rel=1e-12)
        assert percent == pytest.approx(100 * (wanted + controller.feed * 30) / LARGEST, rel=1e-12)


def test_feed_forward_alone_pumps_what_the_motor_takes() -> None:
    percent, part = SpeedController(DT).step(0.0, (50.0, 0.0))
    assert part == 0.0
    assert percent / 100 * 71e-6 * 1450 / 60 == pytest.approx(50.0 * 60e-6 / (2 * math.pi), rel=1e-12)


def test_pi_part_rests_near_standstill_and_goes_on_from_what_it_had() -> None:
    controller = SpeedController(DT, K_p=1e-3, T_i=0.01)
    for _ in range(50):
        _, before = controller.step(0.0, (10.0, 5.0))
    assert controller.step(0.0, (10.0, 1.9))[1] == 0.0
    assert controller.step(0.0, (10.0, -1.9))[1] == 0.0
    _, after = controller.step(0.0, (10.0, 5.0))
    assert after == pytest.approx(before + 1e-3 / 0.01 * DT * 5.0, rel=1e-12)  # one step of the integral, no jump


@pytest.mark.parametrize("reference", [120.0, -120.0])
def test_the_angle_s_limit_goes_round_both_parts(reference: float) -> None:
    controller = SpeedController(DT, K_p=1e-3, T_i=0.1)
    for _ in range(3000):
        percent, part = controller.step(0.0, (reference, 0.5 * reference))
    assert percent == pytest.approx(math.copysign(100.0, reference), rel=1e-12)
    assert abs(part) == pytest.approx(LARGEST - controller.feed * 120.0)
    assert abs(controller.step(0.0, (reference, 1.2 * reference))[0]) < 100.0  # no winding up


def test_load_controller_is_feed_forward_and_pi() -> None:
    controller, pi = LoadController(DT), PI(1.98e-9, 0.03, DT)
    for e in errors(2, 5e5):
        opening, part = controller.step(0.0, (100e5, 100e5 - e, 20.0))
        wanted = pi.step(0.0, (e, 0.0, 0.0, 1.0))[0]
        assert part == pytest.approx(wanted, rel=1e-9)
        assert opening == pytest.approx(wanted - 60e-6 / (2 * math.pi) / 0.0035 * 20.0, rel=1e-9)


def test_load_controller_stays_within_the_valve_and_comes_back_at_once() -> None:
    controller = LoadController(DT)
    for _ in range(3000):
        opening, _ = controller.step(0.0, (200e5, 0.0, 30.0))
    assert opening == 1.0
    assert controller.step(0.0, (200e5, 210e5, 30.0))[0] < 1.0


def test_compensated_controller_opens_for_the_flow_that_is_asked_for() -> None:
    controller = CompensatedLoadController(DT, K_p=1e-12, smoothing=0.0)
    pi, valve = PI(1e-12, 0.03, DT), ValveCompensation(1.863e-5, 875.0)
    for e in errors(3, 5e5):
        opening, part = controller.step(0.0, (100e5, 100e5 - e, -20.0, 310e5))
        wanted = pi.step(0.0, (e, 0.0, 0.0, 1.0))[0]
        assert part == pytest.approx(wanted, rel=1e-9)
        flow = wanted + 60e-6 / (2 * math.pi) * 20.0
        assert opening == pytest.approx(valve.step(0.0, (flow, 310e5, 100e5 - e))[0], rel=1e-9)


def test_its_gain_is_that_of_the_thesis_at_the_working_point() -> None:
    small = 1e3
    plain, compensated = LoadController(DT), CompensatedLoadController(DT)
    plain.step(0.0, (0.0, 0.0, 0.0))
    compensated.step(0.0, (0.0, 0.0, 0.0, 310e5))
    ratio = compensated.step(0.0, (small, 0.0, 0.0, 310e5))[0] / plain.step(0.0, (small, 0.0, 0.0))[0]
    assert ratio == pytest.approx(1.0, rel=0.01)  # 0.0035 is printed for 1.863e-5 sqrt(310e5/875) = 0.003507


def test_the_characteristic_follows_the_load_pressure_with_a_lag() -> None:
    """No PI part to speak of: opening times root of the drop at the smoothed pressure is the same flow throughout."""
    controller = CompensatedLoadController(DT, K_p=0.0, smoothing=0.05)
    controller.step(0.0, (0.0, 0.0, -20.0, 310e5))
    openings = np.array([controller.step(0.0, (0.0, 100e5, -20.0, 310e5))[0] for _ in range(200)])
    lag = 100e5 * (1 - (1 - DT / 0.05) ** np.arange(1, 201))
    assert openings == pytest.approx(60e-6 / (2 * math.pi) * 20.0 / (1.863e-5 * np.sqrt((310e5 - lag) / 875.0)))


def test_compensated_controller_never_divides_by_nothing() -> None:
    controller = CompensatedLoadController(DT)
    for _ in range(3000):
        opening, _ = controller.step(0.0, (400e5, 315e5, 0.0, 310e5))
        assert -1.0 <= opening <= 1.0
    assert opening == 1.0


@pytest.mark.parametrize("make", [SpeedController, LoadController, CompensatedLoadController])
def test_a_copy_goes_on_alike(make: type) -> None:
    rows = np.random.default_rng(4).uniform(1.0, 50.0, (100, len(make(DT).inputs)))
    whole, first = make(DT), make(DT)
    wanted = [whole.step(0.0, row) for row in rows.tolist()]
    for row in rows[:40].tolist():
        first.step(0.0, row)
    second = copy.deepcopy(first)
    assert [second.step(0.0, row) for row in rows[40:].tolist()] == wanted[40:]


def test_wrong_numbers_are_refused() -> None:
    with pytest.raises(BadInput, match="zero or more, and a positive angle"):
        SpeedController(DT, omega_zero=-1.0)
    with pytest.raises(BadInput, match="positive times"):
        LoadController(0.0)
    with pytest.raises(BadInput, match="valve = 0"):
        CompensatedLoadController(DT, valve=0.0)
    with pytest.raises(BadInput, match="smoothing = -1 s"):
        CompensatedLoadController(DT, smoothing=-1.0)
