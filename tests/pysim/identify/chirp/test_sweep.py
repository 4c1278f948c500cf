import numpy as np
import pytest

from pysim.identify.chirp import fastest_rate, sweep_error
from pysim.types import BadInput


def test_error_is_half_the_rate_times_the_response_s_curvature() -> None:
    # next to one pair of poles G is 1 / (sigma + i (omega - omega_d)) in shape: |G''/G| = 2 / sigma^2 at its top
    sigma, h = 0.2 * 2 * np.pi * 8.0, 1e-3
    g = [1 / (sigma + 1j * x) for x in (-h, 0.0, h)]
    curvature = abs((g[0] - 2 * g[1] + g[2]) / h**2 / g[1])
    assert sweep_error(-0.5, 8.0, 0.2) == pytest.approx(0.5 * 2 * np.pi * 0.5 * curvature, rel=1e-5)
    assert sweep_error(fastest_rate(8.0, 0.2, 0.03), 8.0, 0.2) == pytest.approx(0.03)


def test_refuses_what_is_no_resonance() -> None:
    with pytest.raises(BadInput, match="must be positive"):
        sweep_error(1.0, 8.0, 0.0)
