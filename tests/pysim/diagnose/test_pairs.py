"""Joint gains against least squares."""

import numpy as np
import pytest
from scipy.optimize import nnls

from pysim.diagnose.pairs import joint
from pysim.diagnose.screen import Footprint
from tests.pysim.diagnose.toy import CATALOGUE


def footprint(name: str, left: np.ndarray) -> Footprint:
    return Footprint(CATALOGUE[name], {}, left, left, float(left @ left), 0.0, 1.0)


def test_gain_and_amounts_are_those_of_least_squares_with_their_signs() -> None:
    rng = np.random.default_rng(1)
    left_over = rng.standard_normal(40)
    own = [footprint(name, rng.standard_normal(40)) for name in ("toy.friction", "toy.hardening", "toy.bias")]
    found = joint(own, left_over)
    assert len(found) == 3
    assert [pair.gain for pair in found] == sorted((pair.gain for pair in found), reverse=True)
    for pair in found:
        signed = [part.signed for part in pair.parts]
        columns = [part.left for part in pair.parts]
        columns += [-c for c, both in zip(columns, signed, strict=True) if both]  # a bias may have either sign
        rest = nnls(np.array(columns).T, -left_over)[1]
        assert pair.gain == pytest.approx(float(left_over @ left_over) - rest**2)


def test_two_that_hide_each_other_are_worth_more_together() -> None:
    """Nearly opposite footprints: each alone takes next to nothing of their difference."""
    rng = np.random.default_rng(2)
    common, small = rng.standard_normal(400), rng.standard_normal(400)
    one, other = footprint("toy.friction", common), footprint("toy.hardening", -common + 0.05 * small)
    left_over = -(one.left + other.left)
    (pair,) = joint([one, other], left_over)
    assert pair.amounts == pytest.approx((1.0, 1.0))
    assert pair.gain == pytest.approx(float(left_over @ left_over))
    alone = max((f.left @ left_over) ** 2 / f.size for f in (one, other))
    assert pair.gain > 10 * alone


def test_one_effect_is_no_pair_whatever_its_strengths() -> None:
    rng = np.random.default_rng(3)
    assert joint([footprint("toy.bias", rng.standard_normal(5)) for _ in range(3)], rng.standard_normal(5)) == ()
    assert joint([], rng.standard_normal(5)) == ()
