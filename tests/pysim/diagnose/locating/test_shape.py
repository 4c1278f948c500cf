"""What of a table is shown: what refitting absorbs is split off, and the band holds."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.diagnose.locating.fit import Estimate, Table, bends, knots, lines, solve
from pysim.diagnose.locating.laws import KNOTS, Copy, Law
from pysim.diagnose.locating.shape import Told, per_second, shape, told
from pysim.identify.greybox.residuals import Point
from tests.pysim.diagnose.toy import base

LAW = Law("force", "force.v", (Copy("force.f", "force.v"),))


def estimate(seed: int, *, with_damping: bool) -> Estimate:
    """Residuals of unit noise and three times the sign of v; a parameter may do what is proportional to v."""
    rng = np.random.default_rng(seed)
    v = rng.uniform(-2, 2, 4000)
    k = knots(v)
    table = Table(LAW, base(), k)
    hats = -np.stack([np.interp(v, k, row) for row in np.eye(KNOTS)], axis=1)
    slopes = v[:, None] if with_damping else rng.standard_normal((v.size, 1))
    residual = 3 * np.sign(v) + rng.standard_normal(v.size)
    span = slopes / np.linalg.norm(slopes)
    cut = hats - span @ (span.T @ hats)
    found = solve(residual - span @ (span.T @ residual), cut, k)
    x = np.append(0.0, found.values)
    left = residual + hats @ found.values
    return Estimate(table, Point(x, float(left @ left), left, np.hstack([slopes, hats])), found)


def test_what_a_parameter_does_as_well_is_absorbed() -> None:
    of = told(estimate(1, with_damping=True))
    assert of.absorbed.shape == (KNOTS, 1)
    np.testing.assert_allclose(np.abs(of.absorbed[:, 0]), np.abs(of.knots) / np.linalg.norm(of.knots), atol=0.05)
    np.testing.assert_allclose(of.absorbed.T @ of.values, 0, atol=1e-9)


def test_nothing_is_absorbed_where_the_data_tell_all() -> None:
    assert told(estimate(1, with_damping=False)).absorbed.shape == (KNOTS, 0)


@pytest.mark.parametrize("with_damping", [True, False])
def test_the_band_holds_the_term_over_nine_tenths_of_its_range(with_damping: bool) -> None:
    shares = []
    for seed in range(10):
        of = told(estimate(seed, with_damping=with_damping))
        found = shape(of, LAW, base(), np.zeros(of.absorbed.shape[1]))
        rest = 3 * np.sign(found.argument) - found.value
        if found.absorbed.size:
            rest = rest - found.absorbed @ np.linalg.lstsq(found.absorbed, rest, rcond=None)[0]
        shares.append(np.mean(np.abs(rest) <= 0.5 * (found.high - found.low)))
    assert np.mean(shares) > 0.9
    assert np.max(found.high - found.low) < 3


def test_what_the_weight_of_level_and_slope_took_is_given_back() -> None:
    plain = estimate(2, with_damping=False)
    line = lines(plain.table.knots)
    slopes = plain.point.jacobian
    gram = slopes[:, -KNOTS:].T @ slopes[:, -KNOTS:]
    weight = 0.1 * np.trace(gram) / KNOTS
    rough = np.exp(plain.solution.smoothing[0]) * bends(plain.table.knots).T @ bends(plain.table.knots)
    held = np.linalg.solve(gram + rough + weight * line @ line.T, (gram + rough) @ plain.solution.values)
    solution = replace(plain.solution, smoothing=np.array([plain.solution.smoothing[0], np.log(weight)]))
    pulled = replace(plain, point=replace(plain.point, x=np.append(0.0, held)), solution=solution)
    off = [np.linalg.norm(line.T @ (values - plain.solution.values)) for values in (held, told(pulled).values)]
    assert off[1] < 0.5 * off[0]


def test_a_bend_widens_the_band_between_knots() -> None:
    k = np.linspace(0, 1, KNOTS)
    of = Told(k, k**2, np.zeros((KNOTS, KNOTS)), np.zeros((KNOTS, 0)))
    np.testing.assert_allclose(of.bent, np.full(KNOTS - 1, 2 * np.diff(k)[0] ** 2 / 8))
    found = shape(of, LAW, base(), np.zeros(0))
    assert np.all((found.low <= found.argument**2 + 1e-12) & (found.argument**2 <= found.high + 1e-12))
    assert (found.argument_unit, found.unit) == ("m/s", "N")


@pytest.mark.parametrize(
    ("unit", "rate"), [("m", "m/s"), ("m/s", "m/s2"), ("m/s2", "m/s3"), ("N/m", "N/(m.s)"), ("1", "1/s")]
)
def test_units_of_rates(unit: str, rate: str) -> None:
    assert per_second(unit) == rate
