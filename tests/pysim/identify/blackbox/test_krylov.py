"""Orthonormal polynomials on the points: what they span, and their roots."""

import numpy as np

from pysim.identify.blackbox.krylov import krylov_basis

S = 1j * np.geomspace(0.01, 100, 60)
START = 1 / ((S + 1) * (S**2 + 0.1 * S + 25))
WEIGHTS = np.tile(np.array([[2.0, 0.0], [0.3, 1.0]]), (60, 1, 1))


def test_columns_are_orthonormal_polynomials_times_the_start() -> None:
    basis = krylov_basis(START, S, 12, WEIGHTS)
    np.testing.assert_allclose(basis.white.T @ basis.white, np.eye(13), atol=1e-12)
    powers = basis.powers()
    for k in range(6):  # of higher degree the powers themselves lose digits over four decades
        np.testing.assert_allclose(basis.columns[:, k], np.polyval(powers[:, k], S) * START, rtol=1e-6, atol=1e-9)


def test_roots_are_those_of_the_polynomial() -> None:
    basis = krylov_basis(START, S, 5, WEIGHTS)
    wanted = np.array([-3.0, -0.2 + 7j, -0.2 - 7j, 2.0, -40.0], dtype=complex)
    coefficients = np.linalg.solve(basis.powers(), np.poly(wanted).real)
    np.testing.assert_allclose(np.sort_complex(basis.roots(coefficients)), np.sort_complex(wanted), rtol=1e-8)
