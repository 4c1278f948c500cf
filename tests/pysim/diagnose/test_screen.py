"""Footprints against what a linear model lets be worked out."""

import numpy as np
import pytest

from pysim.diagnose.contenders import Contender
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.residuals import rulers
from pysim.diagnose.screen import across, column_space, elsewhere, per_effect, screen
from pysim.diagnose.subject import extended
from tests.pysim.diagnose.toy import measured, toy_subject


def test_column_space_leaves_out_what_does_nothing() -> None:
    slopes = np.array([[1.0, 2.0, 0.0], [0.0, 0.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 0.0]])
    span = column_space(slopes)
    assert span.shape == (4, 1)
    assert np.abs(span[:, 0]) == pytest.approx([np.sqrt(0.5), 0, np.sqrt(0.5), 0])
    assert column_space(np.zeros((4, 2))).shape == (4, 0)


def test_what_slopes_of_very_different_sizes_reach_is_found_to_rounding() -> None:
    rng = np.random.default_rng(0)
    slopes = rng.standard_normal((200, 6)) * 10.0 ** np.arange(-6, 6, 2)
    span = column_space(slopes)
    assert span.T @ span == pytest.approx(np.eye(6), abs=1e-13)
    assert np.abs(across(span, slopes)).max(axis=0) / np.abs(slopes).max(axis=0) == pytest.approx(0, abs=1e-12)


def test_a_constant_force_on_a_linear_model_is_found_to_its_size() -> None:
    """Its footprint is linear in the force, so the screening at true parameters finds amount and gain exactly."""
    subject = toy_subject(measured(5, "toy.bias", F_b=-0.2), ("toy.bias",))
    ruler, _ = rulers(subject.targets)
    base = extended(subject, ())
    point = ruler.evaluation(base, base.space.to_search(np.array([1.05, 0.75, 21.0])))
    model = extended(subject, subject.catalogue)
    found = screen(Fitted(base, point), [Contender(subject.catalogue[0], model, ruler)])
    assert len(found) == 1  # the best amount is near what was tried
    best = found[0]
    assert best.amount * best.values["F_b"] == pytest.approx(-0.2, abs=0.003)
    # with what refitting takes by itself, nothing but noise is left
    by_refit = np.sum((column_space(point.jacobian).T @ point.residual) ** 2)
    assert point.cost - by_refit - best.gain == pytest.approx(point.residual.size, rel=0.2)
    # it is orthogonal to what refitting reaches
    assert np.abs(column_space(point.jacobian).T @ best.left).max() < 1e-9 * np.sqrt(best.size)


def test_a_strength_far_from_the_best_is_tried_again_there() -> None:
    subject = toy_subject(measured(5, "toy.bias", F_b=-2.0), ("toy.bias",))
    ruler, _ = rulers(subject.targets)
    base = extended(subject, ())
    point = ruler.evaluation(base, base.space.to_search(np.array([1.05, 0.75, 21.0])))
    found = screen(Fitted(base, point), [Contender(subject.catalogue[0], extended(subject, subject.catalogue), ruler)])
    assert len(found) == 2
    assert len(per_effect(found)) == 1
    assert sorted(f.values["F_b"] for f in found) == pytest.approx([-2.0, 0.09], abs=0.03)


def test_a_strength_of_one_sign_gains_nothing_against_it() -> None:
    subject = toy_subject(measured(6), ("toy.friction",))
    ruler, _ = rulers(subject.targets)
    base = extended(subject, ())
    # a model that damps more than the plant: more friction can only make it worse
    point = ruler.evaluation(base, base.space.to_search(np.array([1.05, 1.5, 21.0])))
    blind = point.__class__(point.x, point.cost, point.residual, np.zeros_like(point.jacobian))
    (effect,) = subject.catalogue
    found = screen(Fitted(base, blind), [Contender(effect, extended(subject, [effect]), ruler)])
    assert found
    assert all(f.gain == 0 and f.amount == 0 for f in found)


def test_what_cannot_be_switched_off_is_tried_from_a_fifth_to_twice_its_usual_size() -> None:
    subject = toy_subject(measured(7, "toy.relaxing", T_r=0.4), ("toy.relaxing", "toy.friction"))
    ruler, _ = rulers(subject.targets)
    base = extended(subject, ())
    current = Fitted(base, ruler.evaluation(base, base.space.to_search(np.array([1.05, 0.75, 21.0]))))
    relaxing, rubbing = (Contender(effect, extended(subject, [effect]), ruler) for effect in subject.catalogue)
    found = list(elsewhere(current, relaxing))
    assert [f.values["T_r"] for f in found] == pytest.approx([0.04, 0.2, 0.4])
    # the last is the truth: as it was tried it takes all but noise, and of the others no multiple does
    left = current.point.cost - np.sum((column_space(current.point.jacobian).T @ current.point.residual) ** 2)
    assert found[2].amount == pytest.approx(1.0, abs=0.005)
    assert left - found[2].gain == pytest.approx(current.point.residual.size, rel=0.2)
    assert left - found[0].gain > 10 * current.point.residual.size
    assert not list(elsewhere(current, rubbing))
