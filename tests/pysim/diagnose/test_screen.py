"""Footprints against what a linear model lets be worked out."""

import numpy as np
import pytest

from pysim.diagnose.residuals import rulers
from pysim.diagnose.screen import column_space, first_point, screen, strengths
from pysim.diagnose.subject import extended
from pysim.effects import STANDARD_LIBRARY, read_catalogue
from tests.pysim.diagnose.toy import CATALOGUE, measured, toy_subject


def test_column_space_leaves_out_what_does_nothing() -> None:
    slopes = np.array([[1.0, 2.0, 0.0], [0.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 0.0]])
    span = column_space(slopes)
    assert span.shape == (4, 1)
    assert np.abs(span[:, 0]) == pytest.approx([np.sqrt(0.5), 0, np.sqrt(0.5), 0])
    assert column_space(np.zeros((4, 2))).shape == (4, 0)


def test_a_constant_force_on_a_linear_model_is_found_to_its_size() -> None:
    """Its footprint is linear in the force, so the screening at true parameters finds amount and gain exactly."""
    subject = toy_subject(measured(5, "toy.bias", F_b=-0.2), ("toy.bias",))
    ruler, _ = rulers(subject.targets)
    base = extended(subject, ())
    point = ruler.evaluation(base, base.space.to_search(np.array([1.05, 0.75, 21.0])))
    model = extended(subject, subject.catalogue)
    found = screen(ruler, base, point, [(subject.catalogue[0], model)])
    best = found[0]
    assert best.amount * best.values["F_b"] == pytest.approx(-0.2, abs=0.003)
    # with what refitting takes by itself, nothing but noise is left
    by_refit = np.sum((column_space(point.jacobian).T @ point.residual) ** 2)
    assert point.cost - by_refit - best.gain == pytest.approx(point.residual.size, rel=0.2)
    # it is orthogonal to what refitting reaches
    assert np.abs(column_space(point.jacobian).T @ best.left).max() < 1e-9 * np.sqrt(best.size)
    start = first_point(ruler, base, model, point, best)
    assert start is not None
    assert start.cost < 0.2 * point.cost


def test_a_strength_of_one_sign_gains_nothing_against_it() -> None:
    subject = toy_subject(measured(6), ("toy.friction",))
    ruler, _ = rulers(subject.targets)
    base = extended(subject, ())
    # a model that damps more than the plant: more friction can only make it worse
    point = ruler.evaluation(base, base.space.to_search(np.array([1.05, 1.5, 21.0])))
    blind = point.__class__(point.x, point.cost, point.residual, np.zeros_like(point.jacobian))
    (effect,) = subject.catalogue
    found = screen(ruler, base, blind, [(effect, extended(subject, [effect]))])
    assert found
    assert all(f.gain == 0 and f.amount == 0 for f in found)


def test_grids() -> None:
    assert [v["F_c"] for v in strengths(CATALOGUE["toy.friction"])] == pytest.approx([0.03, 0.3])
    standard = {effect.name: effect for effect in read_catalogue(STANDARD_LIBRARY)}
    assert len(list(strengths(standard["valve.rate_limit"]))) == 7  # bites late
    assert all(v["T"] == 0.02 for v in strengths(standard["supply.droop"]))  # shapes stay as declared
