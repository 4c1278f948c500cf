"""Friction of laminar waves in a round bore against its limits, and what a hose lets through against closed forms."""

import numpy as np
import pytest

from validation.ripple.line import Hose, laminar_impedance

RADIUS, DENSITY, VISCOSITY = 5e-3, 875.0, 46e-6
AREA = np.pi * RADIUS**2


def test_slow_flow_has_poiseuille_s_resistance_and_four_thirds_of_the_inertia() -> None:
    omega = np.array([1e-2])
    (found,) = laminar_impedance(omega, RADIUS, DENSITY, VISCOSITY)
    assert found.real == pytest.approx(8 * DENSITY * VISCOSITY / (AREA * RADIUS**2), rel=1e-6)
    assert found.imag / omega[0] == pytest.approx(4 / 3 * DENSITY / AREA, rel=1e-6)


def test_fast_flow_feels_the_boundary_layer_alone() -> None:
    """The inertia and 2/z of it, z = r sqrt(-j omega / nu); the next term is 1/z of that."""
    omega = np.array([1e6])
    (found,) = laminar_impedance(omega, RADIUS, DENSITY, VISCOSITY)
    layer = 2 / (RADIUS * np.sqrt(1j * omega[0] / VISCOSITY))
    assert found / (1j * omega[0] * DENSITY / AREA) - 1 == pytest.approx(layer, rel=5e-3)


def test_unsteady_friction_damps_a_wave_as_the_boundary_layer_does() -> None:
    """Over an end without reflection: exp(-l sqrt(nu omega / 2) / (r c)), thin layer, first order."""
    hertz, hose = np.array([4000.0]), Hose(lag=0.0, unsteady=True, viscosity=1e-6)
    omega = 2 * np.pi * hertz
    series, shunt = hose.series(omega, 1e-6), hose.shunt(omega)
    decay = np.exp(-np.sqrt(series * shunt).real * hose.length)
    expected = np.exp(-hose.length * np.sqrt(hose.viscosity * omega / 2) / (hose.diameter / 2 * hose.sound))
    assert decay == pytest.approx(expected, rel=1e-2)
