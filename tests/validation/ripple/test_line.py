"""The closed forms of the hose: where the wave equation has known answers, and the segments approach it."""

import numpy as np
import pytest

from validation.ripple.line import Hose

FLOW = 8.5e-4
RIGID = Hose(wall=1e18, lag=0.0, viscosity=1e-7, roughness=0.0)


def test_speed_of_sound() -> None:
    assert RIGID.sound == pytest.approx(np.sqrt(1.4e9 / 875), rel=1e-8)


@pytest.mark.parametrize("mode", [1, 2, 3])
def test_open_line_without_loss_is_one_over_cosine(mode: int) -> None:
    """Half waves pass as they are, between a quarter and a half wave the cosine decides."""
    half_wave = RIGID.sound / (2 * RIGID.length)
    hertz = np.array([mode * half_wave, (mode + 0.3) * half_wave])
    passed = RIGID.passed(hertz, 1e-8)
    assert passed == pytest.approx([1, 1 / abs(np.cos(0.3 * np.pi))], rel=1e-3)


def test_end_that_swallows_waves_passes_all_frequencies_alike() -> None:
    """An end of the line's own impedance reflects nothing."""
    end = RIGID.density * RIGID.sound / RIGID.area
    hertz = np.linspace(50, 900, 40)
    matched = Hose(wall=1e18, lag=0.0, viscosity=1e-7, roughness=0.0, end=end)
    assert np.abs(matched.passed(hertz, 1e-8) - 1).max() < 1e-3


def test_segments_approach_the_wave_equation_with_their_square() -> None:
    hertz = np.array([150.0, 300.0, 435.0])
    exact = Hose().passed(hertz, FLOW)
    off = [np.abs(Hose().passed_by_segments(n, hertz, FLOW) - exact).max() for n in (64, 128, 256)]
    assert off[0] / off[1] == pytest.approx(4, rel=0.1)
    assert off[1] / off[2] == pytest.approx(4, rel=0.05)


def test_one_segment_is_an_oscillator() -> None:
    """Half the compliance on the inertia of all the oil; the other half is shorted by the tank."""
    hose = Hose(lag=0.0)
    compliance = hose.area * hose.length * (1 / hose.oil + 1 / hose.wall) / 2
    natural = 1 / np.sqrt(compliance * hose.density * hose.length / hose.area) / (2 * np.pi)
    hertz = np.array([10 * natural])
    assert hose.passed_by_segments(1, hertz, 1e-8)[0] == pytest.approx(1 / 99, rel=1e-3)


def test_laminar_friction_is_hagen_poiseuille() -> None:
    q = 1e-5
    assert Hose().gradient(q) == pytest.approx(128 * 875 * 46e-6 * q / (np.pi * 0.01**4), rel=1e-6)
