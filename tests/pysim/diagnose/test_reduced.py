"""A refit with parameters less, from where a larger model has led."""

import numpy as np
import pytest

from pysim.diagnose.decide import price
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.reduced import reduced
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import extended
from pysim.identify.greybox.residuals import Point
from tests.pysim.diagnose.toy import CATALOGUE, measured, toy_subject


def without(lost: str) -> tuple[Fitted, tuple[Point, np.ndarray] | None]:
    """A mass that rubs, fitted with dry friction and a constant force, and then without one of these."""
    subject = toy_subject(measured(6, "toy.friction", F_c=0.3))
    ruler, _ = rulers(subject.targets)
    both = [CATALOGUE["toy.friction"], CATALOGUE["toy.bias"]]
    whole, rest = extended(subject, both), [effect for effect in both if effect.name != lost]
    begun = whole.space.to_search(np.where(np.arange(whole.space.size) < 3, whole.space.start, [0, 0, 0, 0.2, 0.1]))
    larger = Fitted(whole, refit(ruler, whole, ruler.evaluation(whole, begun)))
    what = extended(subject, rest)
    kept = next(k for k, effect in enumerate(both) if effect in rest)
    return larger, reduced(ruler, larger, what, [0, 1, 2, 3 + kept])


def test_what_was_not_needed_costs_no_more_than_its_price() -> None:
    larger, end = without("toy.bias")
    assert end is not None
    point, slopes_at = end
    assert larger.point.cost - 0.5 < point.cost < larger.point.cost + price(1, point.residual.size)
    assert point.x[3] == pytest.approx(larger.point.x[3], rel=0.05)
    assert slopes_at.shape == point.x.shape


def test_what_was_needed_is_missed() -> None:
    larger, end = without("toy.friction")
    assert end is None or end[0].cost > larger.point.cost + 10 * price(1, larger.point.residual.size)
