import math

import numpy as np
import pytest

from pysim.control.tuning import (
    Plant,
    fastest_pi,
    known_pi,
    load_pressure_plant,
    reachable_phase_margins,
    shaft_speed_plant,
    tune_pi,
)
from pysim.types import BadInput

LAG = Plant((2.0,), (0.5, 1.0))


def test_gains_for_a_lag_in_closed_form() -> None:
    """60 degrees at 2 rad/s: the lag turns by 45 degrees and leaves the root of 2, the controller turns by 75."""
    found = tune_pi(LAG, crossover=2.0, phase_margin=math.radians(60))
    assert found.K_p == pytest.approx(math.cos(math.radians(75)) / math.sqrt(2), rel=1e-12)
    assert found.T_i == pytest.approx(1 / (2 * math.tan(math.radians(75))), rel=1e-12)
    assert found.loop.crossover == pytest.approx(2.0, rel=1e-9)
    assert found.loop.phase_margin == pytest.approx(math.radians(60), rel=1e-9)
    assert found.integral == pytest.approx(found.K_p / found.T_i)


@pytest.mark.parametrize("plant", [load_pressure_plant(), load_pressure_plant().delayed(0.01), shaft_speed_plant()])
@pytest.mark.parametrize("share", [0.05, 0.5, 0.95])
def test_what_is_asked_for_is_what_the_loop_has(plant: Plant, share: float) -> None:
    for crossover in (0.5, 5.0):
        least, most = reachable_phase_margins(plant, crossover)
        wanted = least + share * (most - least)
        found = tune_pi(plant, crossover=crossover, phase_margin=wanted)
        at = np.argmin(np.abs(found.loop.crossovers - crossover))
        assert found.loop.crossovers[at] == pytest.approx(crossover, rel=1e-9)
        turns = (found.loop.phase_margins[at] - wanted) / (2 * np.pi)
        assert turns == pytest.approx(round(turns), abs=1e-9)


def test_a_plant_that_answers_backwards_gets_a_negative_gain() -> None:
    found = tune_pi(Plant((-2.0,), (0.5, 1.0)), crossover=2.0, phase_margin=math.radians(60))
    assert found.K_p == pytest.approx(-math.cos(math.radians(75)) / math.sqrt(2), rel=1e-12)
    assert found.loop.stable


def test_matlab_tuned_gains_come_back_from_their_margins() -> None:
    """Table 6.1: the load's are 60 degrees at 19 rad/s; the supply's are an integral with a tiny gain beside it."""
    known = known_pi(load_pressure_plant(), 1.01e-9, 0.023)
    assert math.degrees(known.loop.phase_margin) == pytest.approx(60.06, abs=0.01)
    round_numbers = tune_pi(load_pressure_plant(), crossover=19.0, phase_margin=math.radians(60))
    assert round_numbers.K_p == pytest.approx(1.01e-9, rel=0.05)
    assert round_numbers.T_i == pytest.approx(0.023, rel=0.05)
    known = known_pi(shaft_speed_plant(), 1.41e-7, 0.000159)
    same = tune_pi(shaft_speed_plant(), crossover=known.loop.crossover, phase_margin=known.loop.phase_margin)
    assert same.K_p == pytest.approx(1.41e-7, rel=1e-6)
    assert same.T_i == pytest.approx(0.000159, rel=1e-6)


def test_a_margin_out_of_reach_names_what_is_within() -> None:
    with pytest.raises(BadInput, match=r"60 degrees at 0.63 rad/s .* ask for 89\.\d+ to 179\.\d+ degrees"):
        tune_pi(shaft_speed_plant(), crossover=0.63, phase_margin=math.radians(60))
    with pytest.raises(BadInput, match="positive frequency"):
        reachable_phase_margins(LAG, 0.0)


@pytest.mark.parametrize(
    ("numerator", "denominator", "delay", "phase"),
    [
        ((1,), (1, 0), 0.0, -90.0),
        ((1,), (1, 0, 0), 0.0, -180.0),
        ((-1,), (1, 0, 0), 0.0, -180.0),  # its sign is the gain's
        ((1,), (1, 0, 0, 0), 0.0, -270.0),
        ((1, 0), (1, 2, 1), 0.0, 0.0),  # 90 degrees ahead at 0, 90 behind by 1 rad/s
        ((1, 1), (1, 0, 0), 0.0, -135.0),
        ((1,), (1, 0, 0), math.pi, -360.0),
        ((1,), (1, 0, 0.25), 0.0, -180.0),  # an undamped pair is one of little damping
        ((1, -1), (1, 1), 0.0, -90.0),
        ((1,), (1, -1), 0.0, 45.0),
        ((1,), (1, 1), 1e4, -45.0 - math.degrees(1e4)),
    ],
)
def test_phase_counts_from_the_integrators(
    numerator: tuple[float, ...], denominator: tuple[float, ...], delay: float, phase: float
) -> None:
    least, most = reachable_phase_margins(Plant(numerator, denominator, delay), 1.0)
    assert math.degrees(most) - 180.0 == pytest.approx(phase, abs=1e-9 + 1e-12 * abs(phase))
    assert math.degrees(most - least) == pytest.approx(90.0)


def test_no_pi_controller_holds_two_integrators() -> None:
    with pytest.raises(BadInput, match="ask for -90 to 0 degrees"):
        tune_pi(Plant((1,), (1, 0, 0)), crossover=1.0, phase_margin=math.radians(300))


@pytest.mark.parametrize("plant", [load_pressure_plant(), load_pressure_plant().delayed(0.01), shaft_speed_plant()])
def test_fastest_keeps_its_margins_and_more_would_not(plant: Plant) -> None:
    found = fastest_pi(plant, phase_margin=math.radians(60), gain_margin=3.0)
    typed = known_pi(plant, float(f"{found.K_p:.4g}"), float(f"{found.T_i:.4g}"))  # as the table prints them
    for loop in (found.loop, typed.loop):
        assert loop.stable
        assert loop.phase_margin >= math.radians(60)
        assert loop.gain_margin >= 3.0
    more = known_pi(plant, 1.05 * found.K_p, found.T_i)
    assert more.loop.phase_margin < math.radians(60) or more.loop.gain_margin < 3.0


def test_fastest_of_an_integrator_behind_a_dead_time() -> None:
    """k exp(-sT)/s: 60 degrees with gain alone would be at k = pi/(6T); the integral costs some of it."""
    found = fastest_pi(Plant((1.0,), (1.0, 0.0), delay=0.1), phase_margin=math.radians(60))
    assert 0.5 * math.pi / 0.6 < found.K_p < math.pi / 0.6


def test_fastest_of_two_integrators_with_a_lead() -> None:
    """(s + 1)/s^2 behind a dead time: antiphase at the lowest frequencies, where the gain is high, does not count."""
    found = fastest_pi(Plant((1.0, 1.0), (1.0, 0.0, 0.0), delay=0.01), phase_margin=math.radians(60))
    assert found.loop.stable
    assert found.loop.phase_margin >= math.radians(60)


def test_an_integral_has_a_time_that_can_be_built() -> None:
    """Only K_p/T_i counts on the shaft, so T_i is free below; Table 6.1 has 0.16 ms."""
    found = fastest_pi(shaft_speed_plant(), phase_margin=math.radians(60))
    assert 1e-4 < found.T_i < 1e-3
    alone = known_pi(found.plant, 1e-4 * found.K_p, 1e-4 * found.T_i)
    assert found.integral == pytest.approx(alone.integral)
    assert found.loop.crossover == pytest.approx(alone.loop.crossover, rel=1e-3)
    assert found.loop.gain_margin >= 2.0


def test_fastest_needs_a_limit_and_a_stable_plant() -> None:
    with pytest.raises(BadInput, match="dead time"):
        fastest_pi(LAG, phase_margin=math.radians(60))
    with pytest.raises(BadInput, match="unstable by itself"):
        fastest_pi(shaft_speed_plant(c=-1.4), phase_margin=math.radians(60))
    with pytest.raises(BadInput, match="nothing of a constant comes through"):
        fastest_pi(Plant((1.0, 0.0), (1.0, 2.0, 1.0), 0.01), phase_margin=math.radians(60))
    with pytest.raises(BadInput, match="0 to 90 degrees"):
        fastest_pi(LAG, phase_margin=0.0)
