"""Phases as instruments write them."""

import numpy as np
import pytest

from pysim.io.response_table import continuous_phase


@pytest.mark.parametrize(
    ("written", "continuous"),
    [
        ([-1, -170, 170, 100], [-1, -170, -190, -260]),  # -180..180
        ([359, 300, 181, 100, 5, 340], [359, 300, 181, 100, 5, -20]),  # 0..360
        ([-10, -100, -350, -20], [-10, -100, 10, -20]),  # within one turn, with a step up
        ([-10, -200], [-10, -200]),  # continuous and coarse: the step is no jump
        ([-10, -200, -395, -600], [-10, -200, -395, -600]),
        ([20, 170, -170], [20, 170, 190]),  # a lead
        ([-5], [-5]),
    ],
)
def test_phase_without_jumps(written: list[float], continuous: list[float]) -> None:
    np.testing.assert_allclose(np.degrees(continuous_phase(np.array(written, dtype=float))), continuous, atol=1e-9)
