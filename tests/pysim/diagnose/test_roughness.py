"""A response that no change of parameters leaves alone is told from one that is straight over a short step."""

from dataclasses import replace

import numpy as np

from pysim.diagnose.roughness import roughness
from tests.pysim.diagnose.test_steps import chaos, mass


def test_a_smooth_response_is_not_rough() -> None:
    assert roughness(*mass(1e-6)) == 0


def test_a_plant_without_memory_is_rough() -> None:
    assert roughness(*chaos()) > 10


def test_parameters_at_their_bounds_stay() -> None:
    ruler, at = chaos()
    (lower, _) = at.what.space.bounds()
    at_bound = replace(at, point=replace(at.point, x=lower, residual=ruler.evaluation(at.what, lower).residual))
    assert np.all(at_bound.point.x == lower)
    assert roughness(ruler, at_bound) == 0
