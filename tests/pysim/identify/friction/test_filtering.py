"""The zero-phase filter against its own transfer function; slopes against polynomials and repeated noise."""

import numpy as np
import pytest

from pysim.identify.friction import local_slope, settling_time, zero_phase
from pysim.types import BadInput

TIME = np.arange(0.0, 10.0, 0.004)


@pytest.mark.parametrize(("frequency", "gain"), [(0.5, 1.0), (5.0, 2**-0.5), (40.0, 0.0)])
def test_sines_keep_their_phase_and_lose_their_size(frequency: float, gain: float) -> None:
    """Two Butterworth passes of order 2 have the gain 1 / (1 + (tan / tan_c)^4), 1/sqrt(2) at the cutoff."""
    values = np.sin(2 * np.pi * frequency * TIME)
    filtered = zero_phase(TIME, values, 5.0)
    inner = slice(int(250 * settling_time(5.0)), -int(250 * settling_time(5.0)))
    design = 5.0 * (2**0.5 - 1) ** -0.25
    ratio = np.tan(np.pi * frequency * 0.004) / np.tan(np.pi * design * 0.004)
    np.testing.assert_allclose(filtered[inner], values[inner] / (1 + ratio**4), atol=2e-3)
    assert 1 / (1 + ratio**4) == pytest.approx(gain, abs=5e-3)


def test_straight_lines_pass_unchanged_to_the_ends() -> None:
    values = np.column_stack([3 - 0.7 * TIME, np.full(TIME.size, 2.0)])
    np.testing.assert_allclose(zero_phase(TIME, values, 5.0), values, atol=1e-6)


@pytest.mark.parametrize(
    ("time", "cutoff", "message"),
    [
        (np.append(TIME[:-1], 10.1), 5.0, "log at an even rate"),
        (TIME[:5], 5.0, "5 samples are too few"),
        (TIME, 120.0, "lower the cutoff"),
    ],
)
def test_refuses(time: np.ndarray, cutoff: float, message: str) -> None:
    with pytest.raises(BadInput, match=message):
        zero_phase(time, np.zeros(time.size), cutoff)


def test_slope_of_a_parabola_is_exact_at_uneven_times() -> None:
    time = np.sort(np.random.default_rng(3).uniform(0, 4, 40))
    value, slope, _ = local_slope(time, 1 + 2 * time - 3 * time**2)
    np.testing.assert_allclose(value, 1 + 2 * time - 3 * time**2, atol=1e-9)
    np.testing.assert_allclose(slope, 2 - 6 * time, atol=1e-8)


def test_slope_of_noise_is_as_noisy_as_said() -> None:
    rng = np.random.default_rng(4)
    time = np.cumsum(rng.uniform(0.02, 0.05, 9))
    _, _, claimed = local_slope(time, np.zeros(9))
    seen = np.std([local_slope(time, rng.normal(size=9))[1] for _ in range(3000)], axis=0)
    np.testing.assert_allclose(seen, claimed, rtol=0.06)  # 3000 draws: 1.3 percent, one sigma
    even = local_slope(np.arange(9) * 0.1, np.zeros(9))[2][4]
    assert even == pytest.approx(1 / (0.1 * np.sqrt(10)))  # Savitzky and Golay: 1 / (h sqrt(sum k^2))


def test_slope_refuses_a_window_that_does_not_fit() -> None:
    with pytest.raises(BadInput, match="5 neighbours need more than 4"):
        local_slope(np.arange(4.0), np.zeros(4))
