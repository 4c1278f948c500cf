import math

import numpy as np
import pytest

from pysim.control.tuning import (
    Plant,
    load_pressure_plant,
    loop_response,
    margins,
    shaft_speed_plant,
    stable_when_sampled,
)
from pysim.control.tuning.margins import open_loop
from pysim.types import BadInput

INTEGRATOR = Plant((1.0,), (1.0, 0.0))


def test_integrator_under_pi_in_closed_form() -> None:
    """L = (s + 1)/s^2: |L| = 1 where w^4 = w^2 + 1, phase margin atan w."""
    found = margins(INTEGRATOR, 1.0, 1.0)
    crossover = math.sqrt((1 + math.sqrt(5)) / 2)
    assert found.crossover == pytest.approx(crossover, rel=1e-12)
    assert found.phase_margin == pytest.approx(math.atan(crossover), rel=1e-12)
    assert found.delay_margin == pytest.approx(math.atan(crossover) / crossover, rel=1e-12)
    assert found.gain_margin == math.inf
    assert found.stable


def test_gain_margin_of_three_lags_with_a_slow_integral() -> None:
    """k/(s + 1)^3 with the integral far below: antiphase at the root of 3, where it has an eighth of its gain."""
    found = margins(Plant((1.0,), (1.0, 3.0, 3.0, 1.0)), 2.0, 1e6)
    assert found.gain_margin == pytest.approx(4.0, rel=1e-4)
    assert found.phase_crossovers[-1] == pytest.approx(math.sqrt(3), rel=1e-4)
    assert margins(Plant((1.0,), (1.0, 3.0, 3.0, 1.0)), 7.99, 1e6).stable
    assert not margins(Plant((1.0,), (1.0, 3.0, 3.0, 1.0)), 8.01, 1e6).stable


def test_peak_sensitivity_and_bandwidth_of_a_pure_integral() -> None:
    """L = 1/s: sensitivity below 1 with supremum 1, closed loop a lag."""
    found = margins(Plant((1.0,), (1e-9, 1.0)), 1e-9, 1e-9)
    assert found.bandwidth == pytest.approx(1.0, rel=1e-9)
    assert found.peak_sensitivity == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize(("plant", "K_p", "T_i"), [(load_pressure_plant(), 1.98e-9, 0.03), (INTEGRATOR, 1.0, 1.0)])
def test_a_loop_bears_its_delay_margin_and_no_more(plant: Plant, K_p: float, T_i: float) -> None:
    most = margins(plant, K_p, T_i).delay_margin
    assert margins(plant.delayed(0.99 * most), K_p, T_i).stable
    assert not margins(plant.delayed(1.01 * most), K_p, T_i).stable


def test_an_unstable_loop_bears_no_dead_time() -> None:
    found = margins(Plant((2.0,), (0.5, 1.0), delay=0.05), 20.0, 0.5)
    assert not found.stable
    assert found.delay_margin == 0.0


def test_dead_time_agrees_with_its_pade_approximation() -> None:
    T = 0.02
    pade = Plant((T**2 / 12, -T / 2, 1.0), (T**2 / 12, T / 2, 1.0))
    for gain in (1.98e-9, 8e-9, 2e-8):
        exact = margins(load_pressure_plant().delayed(T), gain, 0.03)
        near = margins(load_pressure_plant().behind(pade), gain, 0.03)
        assert exact.stable == near.stable
        assert exact.gain_margins[0] == pytest.approx(near.gain_margins[0], rel=0.01)
    assert not exact.stable


def test_of_several_crossovers_the_least_margin_counts() -> None:
    assert margins(shaft_speed_plant(), 1.41e-7, 0.000159).gain_margin == pytest.approx(10.2, rel=0.01)
    found = margins(shaft_speed_plant(), 1.5e-6, 0.000159)  # the resonance is crossed as well
    assert found.crossovers.size == 3
    assert found.phase_margin == found.phase_margins.min() < 0
    assert not found.stable
    sizes = np.abs(open_loop(shaft_speed_plant(), 1.5e-6, 0.000159, found.crossovers))
    assert sizes == pytest.approx(np.ones(3), rel=1e-9)


@pytest.mark.parametrize("delay", [0.0, 0.01, 0.025989301039727467])
def test_a_plant_that_passes_nothing_steady_lets_the_integral_run_away(delay: float) -> None:
    plant = Plant((0.059371069199740084, 0.0), (1.0, 51.691153462354805, 22.382345901834103), delay)
    assert not margins(plant, 979.2574080716894, 1.0888393181258733).stable


def test_an_unstable_plant_stays_one() -> None:
    assert not margins(shaft_speed_plant(c=-1.4), 1.41e-7, 0.000159).stable
    assert not margins(shaft_speed_plant(c=-1.4).delayed(1e-3), 1.41e-7, 0.000159).stable


def pade(delay: float, order: int = 8) -> Plant:
    """Dead time as a ratio of polynomials: right to rounding up to some 8/delay."""
    factorial, n = math.factorial, order
    terms = [delay**k * factorial(2 * n - k) / (factorial(k) * factorial(n - k)) for k in range(n, -1, -1)]
    return Plant(tuple((-1) ** (n - k) * term for k, term in enumerate(terms)), tuple(terms))


@pytest.mark.parametrize("damping", [0.0, 1e-9, 1e-6, 1e-4, 0.3])
@pytest.mark.parametrize(("K_p", "delay"), [(3.65, 0.0338), (3.65, 0.1), (0.05, 0.0338), (0.05, 0.15), (0.05, 0.3)])
def test_dead_time_before_a_resonance_of_any_damping(damping: float, K_p: float, delay: float) -> None:
    w = 27.7
    plant = Plant((1.0,), (1 / w**2, 2 * damping / w, 1.0, 0.0))
    near = margins(plant.behind(pade(delay)), K_p, 1.0)
    assert margins(plant.delayed(delay), K_p, 1.0).stable == near.stable


@pytest.mark.parametrize(("K_p", "delay", "stable"), [(0.1, 1.5, False), (0.1, 4.5, True), (-0.1, 1.5, False)])
def test_dead_time_can_damp_an_undamped_pair(K_p: float, delay: float, stable: bool) -> None:
    """1/(s^2 + 1) under a weak gain k: the root at j moves by j k exp(-j delay)/2, to the left with k sin(delay) < 0.

    The integral, far below, adds a root near -k/T_i.
    """
    found = margins(Plant((1.0,), (1.0, 0.0, 1.0), delay), K_p, 1e3)
    assert found.stable == stable
    assert np.isfinite(found.peak_sensitivity)


def test_a_gain_above_one_at_high_frequencies_bears_no_dead_time() -> None:
    """(s + 2)/(s + 1) under k: a chain of roots that tends to the real part ln(k)/delay."""
    assert margins(Plant((1.0, 2.0), (1.0, 1.0), 1e-3), 0.5, 10.0).stable
    assert not margins(Plant((1.0, 2.0), (1.0, 1.0), 1e-3), 1.1, 10.0).stable


@pytest.mark.parametrize("gain", [5e3, 5e6])
def test_a_crossover_far_beyond_the_plants_corners_is_found(gain: float) -> None:
    """k/(s + 1) with the integral at the same corner is k/s."""
    found = margins(Plant((1.0,), (1.0, 1.0)), gain, 1.0)
    assert found.crossover == pytest.approx(gain, rel=1e-9)
    assert found.phase_margin == pytest.approx(math.pi / 2, rel=1e-9)
    assert found.delay_margin == pytest.approx(math.pi / 2 / gain, rel=1e-9)
    assert found.stable


@pytest.mark.parametrize("gain", [1.0, 3e2, 5e3, 7e4, 1e6])
@pytest.mark.parametrize("turn", [1.5, 1.65, 6.9, 40.0, 1e3, 1e6])
def test_dead_time_before_a_lag_under_a_high_gain(gain: float, turn: float) -> None:
    """k exp(-s T)/s, at a crossover far beyond the plant's corner: stable with k T below a quarter turn."""
    found = margins(Plant((1.0,), (1.0, 1.0), delay=turn / gain), gain, 1.0)
    assert found.stable == (turn < math.pi / 2)
    assert found.crossover == pytest.approx(gain, rel=1e-9)


def test_a_loop_that_answers_at_once_with_more_than_it_gets_bears_no_dead_time() -> None:
    """2 (s + 2)/(s + 1): the gain falls to 2 and is never one."""
    plant = Plant((1.0, 2.0), (1.0, 1.0))
    found = margins(plant, 2.0, 1e3)
    assert found.stable
    assert found.crossovers.size == 0
    assert found.delay_margin == 0.0
    assert not margins(plant.delayed(1e-6), 2.0, 1e3).stable
    assert margins(plant, 0.6, 1e3).delay_margin > 0.0


@pytest.mark.parametrize("share", [0.98, 1.02])
@pytest.mark.parametrize("late", [0.0, 0.3, 1.0])
def test_an_integrator_under_a_sampled_gain_in_closed_form(late: float, share: float) -> None:
    """1/s, a gain k and dead time of d steps dt, d at most 1: z^2 - z (1 - k dt (1 - d)) + k dt d.

    Jury: k dt d < 1 and k dt (1 - 2 d) < 2. The loop that is not sampled bears a quarter turn, k dt d < pi/2.
    """
    plant, dt = Plant((1.0,), (1.0, 0.0), delay=late * 0.1), 0.1
    k = share * min(1 / late if late else np.inf, 2 / (1 - 2 * late) if late < 0.5 else np.inf) / dt
    assert stable_when_sampled(plant, k, 1e9, dt=dt) == (share < 1)
    assert margins(plant, k, 1e9).stable
    assert not stable_when_sampled(plant, -k, 1e9, dt=dt)


@pytest.mark.parametrize(("dt", "stable"), [(0.3, True), (0.6, False)])
def test_a_loop_with_good_margins_diverges_if_it_is_sampled_slowly(dt: float, stable: bool) -> None:
    """A lag of 0.5 s with 0.05 s of dead time under 60 degrees of phase margin."""
    plant = Plant((2.0,), (0.5, 1.0), delay=0.05)
    assert margins(plant, 2.063, 0.3436).stable
    assert stable_when_sampled(plant, 2.063, 0.3436, dt=dt) == stable
    late = np.abs(loop_response(plant, 2.063, 0.3436, dt=dt, stop=100 * dt).output[-20:] - 1).max()
    assert (late < 0.1) == stable


@pytest.mark.parametrize("share", [0.99, 1.01])
def test_dead_time_of_many_samples_is_as_without_sampling(share: float) -> None:
    """k exp(-s T)/s bears k T below a quarter turn; a hold of dt is half a step more."""
    dt, delay = 1e-3, 60.0
    k = share * math.pi / 2 / (delay + dt / 2)
    assert stable_when_sampled(Plant((1.0,), (1.0, 0.0), delay), k, 1e9, dt=dt) == (share < 1)


def test_wrong_gains_are_refused() -> None:
    with pytest.raises(BadInput, match="positive time"):
        margins(INTEGRATOR, 1.0, 0.0)
    with pytest.raises(BadInput, match="positive"):
        stable_when_sampled(INTEGRATOR, 1.0, 1.0, dt=0.0)
