import numpy as np

from pysim.identify._near_orthogonal import near_orthogonal_fit


def test_agrees_with_an_orthogonal_factorisation() -> None:
    angle = 2 * np.pi * np.linspace(0.0, 1.3, 400)
    matrix = np.column_stack([f(k * angle) for k in (1, 2, 3) for f in (np.sin, np.cos)] + [np.ones(400)])
    values = 1e3 + np.random.default_rng(0).standard_normal(400)
    expected, *_ = np.linalg.lstsq(matrix, values, rcond=None)
    np.testing.assert_allclose(near_orthogonal_fit(matrix, values), expected, rtol=1e-11, atol=1e-11 * 1e3)
