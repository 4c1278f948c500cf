"""The curves: limits, signs and slopes at their critical points, against closed forms."""

import numpy as np
import pytest

from tests.modelica.library import compiled, run


def curve(function: str, arguments: str, start: float, stop: float) -> tuple[np.ndarray, np.ndarray]:
    """x (n,) from start to stop, and the function's value (n,) where its first argument is x."""
    text = f"""model Curve
  Real x = {start} + ({stop - start})*time;
  Real y = HydraulicTestBench.Functions.{function}(x, {arguments});
  Real clock(start=0, fixed=true);
equation
  der(clock) = 1;
end Curve;
"""
    result = run(compiled("Curve", text), 1.0, points=2001)
    return result["x"], result["y"]


def test_orifice_is_the_square_root_away_from_zero() -> None:
    dp, flow = curve("orificeFlow", "1e-6, 875, 1e4", -100e5, 100e5)
    exact = np.sign(dp) * 1e-6 * np.sqrt(2 / 875 * np.abs(dp))
    far = np.abs(dp) > 1e6  # a hundred times the width: off by 2.5e-5
    assert np.abs(flow[far] / exact[far] - 1).max() < 2.6e-5
    assert flow[-1] / exact[-1] - 1 == pytest.approx(-(0.001**2) / 4, rel=1e-3)


def test_orifice_is_a_straight_line_at_zero() -> None:
    dp, flow = curve("orificeFlow", "1e-6, 875, 1e4", -100, 100)
    slope = 1e-6 * np.sqrt(2 / (875 * 1e4))
    assert np.abs(flow - slope * dp).max() < 1e-4 * slope * 100
    assert np.abs(flow + flow[::-1]).max() < 1e-12 * slope * 100 + 1e-20


def test_opening_is_even_and_ends_at_full_opening() -> None:
    u, area = curve("valveOpeningArea", "-4.67e-6, 6.6454e-6, 0.967e-6", -1.5, 1.5)
    size = np.minimum(np.abs(u), 1)
    assert np.allclose(area, -4.67e-6 * size**3 + 6.6454e-6 * size**2 + 0.967e-6 * size, rtol=1e-12, atol=1e-20)
    assert area.max() == pytest.approx(2.9424e-6, rel=1e-9)
    assert area.min() >= 0


def test_volume_keeps_its_floor() -> None:
    volume, used = curve("flooredVolume", "1e-7", -1e-5, 1e-5)
    assert used.min() >= 1e-7
    assert (np.diff(used) >= 0).all()
    well = volume > 5e-6
    assert np.abs(used[well] / volume[well] - 1).max() < 1e-5
    assert np.abs(used[well] / volume[well] - 1 - 0.01 * (1e-7 / volume[well]) ** 2).max() < 1e-6


def test_end_stop_pushes_only_and_only_inside() -> None:
    depth, force = curve("endStopForce", "-0.5, 1e9, 1e5, 5e-6", -1e-4, 1e-4)
    hold = depth**2 / (depth**2 + 25e-12)
    exact = np.where(depth > 0, np.maximum(hold * (1e9 * depth - 5e4), 0), 0)
    assert np.allclose(force, exact, rtol=1e-9, atol=1e-6)
    assert force[depth <= 0].max() == 0
    assert force.max() == pytest.approx(5e4, rel=0.01)
