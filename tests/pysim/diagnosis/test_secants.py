"""Slopes from answers alone, against those that come along with the runs."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from pysim.diagnosis.candidate import Candidate, Models
from pysim.diagnosis.refit import exact
from pysim.diagnosis.secants import Secants
from pysim.identify.greybox import Point
from pysim.identify.greybox.residuals import Carried
from pysim.simulate import Esdirk
from tests.pysim.diagnosis.plants import FINE, catalogue, given, measured

VALUES = {"m": 1.0, "d": 2.0, "k": 40.0, ("mass.drag", "c_2"): 0.1, ("mass.friction", "F_c"): 0.29}
TIGHT = replace(FINE, solver=Esdirk(rtol=1e-8, atol=1e-8))


@cache
def candidate() -> Candidate:
    """A mass with two effects, one log of it."""
    session = given("mass", measured("mass", {"mass.friction": {"F_c": 0.3}}, fit=(1,), length=4.0))
    return Models(session).of([catalogue("mass")[name] for name in ("mass.drag", "mass.friction")])


def in_units(point: Point) -> np.ndarray:
    """(n_r, n) slopes of the residual in the units of the channels."""
    return point.jacobian * candidate().levels(candidate().residuals(TIGHT), point)[:, None]


def residual(point: Point) -> np.ndarray:
    return point.residual * candidate().levels(candidate().residuals(TIGHT), point)


@cache
def truth() -> Point:
    """With slopes of its own."""
    return exact(candidate(), TIGHT)(candidate().at(VALUES), Carried())


def test_the_first_slopes_are_differences() -> None:
    found = Secants(candidate(), TIGHT, None).evaluate(candidate().at(VALUES), Carried())
    assert found.cost == pytest.approx(truth().cost, abs=1e-3)
    for one, own in zip(in_units(found).T, in_units(truth()).T, strict=True):
        assert np.linalg.norm(one - own) < 0.03 * np.linalg.norm(own)


def test_errors_of_the_integration_are_not_taken_for_slopes() -> None:
    """Steps of 3e-3 give slopes that are up to eight times wrong here."""
    rough = replace(FINE, solver=Esdirk(rtol=3e-4, atol=3e-4))
    far = {"m": 1.1, "d": 2.2, "k": 41.0, ("mass.drag", "c_2"): 1.0, ("mass.friction", "F_c"): 0.2}
    found = Secants(candidate(), rough, None).evaluate(candidate().at(far), Carried())
    for one, own in zip(
        in_units(found).T, in_units(exact(candidate(), TIGHT)(candidate().at(far), Carried())).T, strict=True
    ):
        assert one @ own > 0.8 * np.linalg.norm(one) * np.linalg.norm(own)


def test_slopes_that_are_known_are_not_worked_out_again() -> None:
    """Whichever place they have among those that are not known."""
    known = {"d": np.arange(200.0), ("mass.drag", "c_2"): np.ones(200)}
    found = Secants(candidate(), TIGHT, known).evaluate(candidate().at(VALUES), Carried())
    keys, columns = candidate().keys, in_units(found)
    for key, own in known.items():
        assert columns[:, keys.index(key)] == pytest.approx(own)
    for key in ("m", "k", ("mass.friction", "F_c")):
        own = in_units(truth())[:, keys.index(key)]
        assert np.linalg.norm(columns[:, keys.index(key)] - own) < 0.03 * np.linalg.norm(own)


def test_slopes_of_other_rows_are_not_taken() -> None:
    found = Secants(candidate(), TIGHT, {"d": np.ones(7)}).evaluate(candidate().at(VALUES), Carried())
    own = in_units(truth())[:, candidate().keys.index("d")]
    assert np.linalg.norm(in_units(found)[:, candidate().keys.index("d")] - own) < 0.03 * np.linalg.norm(own)


def test_at_an_upper_bound_differences_go_down() -> None:
    """Beyond it, where values are held, nothing would change."""
    x = candidate().at({**VALUES, ("mass.friction", "F_c"): 5.0})
    assert x[4] == candidate().space.bounds()[1][4]
    found = Secants(candidate(), TIGHT, None).evaluate(x, Carried())
    own = in_units(exact(candidate(), TIGHT)(x, Carried()))[:, 4]
    assert np.linalg.norm(in_units(found)[:, 4] - own) < 0.1 * np.linalg.norm(own)


def test_each_point_corrects_the_slopes_along_the_way_to_it_and_no_other() -> None:
    """The two conditions that make Broyden's update (1965, Eq. 4.5)."""
    secants, x = Secants(candidate(), TIGHT, None), candidate().at(VALUES)
    first = secants.evaluate(x, Carried())
    step = np.array([0.02, -0.1, 0.03, 0.02, 0.1])
    second = secants.evaluate(x + step, Carried())
    assert in_units(second) @ step == pytest.approx(residual(second) - residual(first), abs=1e-12)
    across = np.linalg.svd(step[None, :])[2][1:].T
    assert in_units(second) @ across == pytest.approx(in_units(first) @ across, abs=1e-12)
    again = secants.evaluate(x + step, Carried())
    assert again.jacobian == pytest.approx(second.jacobian)
