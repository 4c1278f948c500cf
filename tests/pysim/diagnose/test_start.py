"""Where refits start, and rounds made of them, on a toy whose truth is known."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.diagnose.blame import Blame
from pysim.diagnose.contenders import Contender, suited
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.nuisance import Suspect
from pysim.diagnose.refit import chord_refit, refit, refit_from
from pysim.diagnose.residuals import Ruler, rulers
from pysim.diagnose.rounds import Tried, note_mimics, promise
from pysim.diagnose.scores import by_score, score
from pysim.diagnose.screen import screen
from pysim.diagnose.start import start_at, start_off
from pysim.diagnose.story import begin
from pysim.diagnose.subject import Extended, extended
from pysim.diagnose.trials import start_amount
from pysim.effects import STANDARD_LIBRARY, read_catalogue
from pysim.simulate import Rk45
from tests.pysim.diagnose.toy import CATALOGUE, measured, toy_subject


def rubbing() -> tuple[Ruler, Fitted, Extended]:
    subject = toy_subject(measured(1, "toy.friction", F_c=0.1), ("toy.friction",))
    ruler, _ = rulers(subject.targets)
    what = extended(subject, ())
    base = refit(ruler, what, ruler.evaluation(what, what.space.to_search(what.space.start)))
    return ruler, Fitted(what, base), extended(subject, [CATALOGUE["toy.friction"]])


def test_a_start_with_the_effect_off_is_the_model_so_far_and_leads_to_the_truth() -> None:
    ruler, base, what = rubbing()
    found = screen(base, [Contender(CATALOGUE["toy.friction"], what, ruler)])[0]
    start = start_off(base, what, found)
    assert start is not None
    assert start.cost == base.point.cost
    assert start.x[-1] == 0.0
    assert ruler.at(what, start.x) == pytest.approx(base.point.residual, abs=1e-2)
    end = chord_refit(ruler, what, start, steps=8)
    assert what.space.to_model(end.x)[-1] == pytest.approx(0.1, abs=0.005)
    assert end.cost < 1.3 * end.residual.size < base.point.cost


def test_a_start_at_a_strength_moves_the_rest_to_where_it_absorbs_that() -> None:
    ruler, base, what = rubbing()
    found = screen(base, [Contender(CATALOGUE["toy.friction"], what, ruler)])[0]
    start = start_at(ruler, base, what, [(found, found.amount)])
    assert start is not None
    unmoved = np.append(base.point.x, start.x[-1])
    beside = ruler.at(what, unmoved)
    assert beside is not None
    assert start.cost < 0.5 * float(beside @ beside)
    exact = ruler.evaluation(what, start.x).jacobian[:, -1]
    assert np.linalg.norm(start.jacobian[:, -1] - exact) < 0.05 * np.linalg.norm(exact)


def test_limits_start_where_they_were_tried_others_near_the_best_amount() -> None:
    standard = {effect.name: effect for effect in read_catalogue(STANDARD_LIBRARY)}
    assert start_amount(standard["valve.saturation"], 0.01) == 1.0
    assert start_amount(standard["sensor.lag"], 7.0) == 1.0
    assert start_amount(standard["swash.bias"], -2.0) == -2.0
    assert start_amount(standard["friction.coulomb"], 50.0) == 3.0


def test_slopes_of_a_refit_are_those_of_the_point_it_names() -> None:
    ruler, base, what = rubbing()
    start = ruler.evaluation(what, what.space.to_search(what.space.start))
    end, at = refit_from(ruler, what, start)
    assert np.array_equal(end.jacobian, ruler.evaluation(what, at).jacobian)
    assert np.abs(end.x - at).max() < 1e-2
    assert end.cost < base.point.cost


def test_rows_and_promises_of_a_round() -> None:
    ruler, base, what = rubbing()
    one = Contender(CATALOGUE["toy.friction"], what, ruler)
    tried = Tried(base, ruler, {"toy.friction": one}, screen(base, [one]), {}, 8.0, base.point.cost)
    assert tried.promises
    end = Fitted(what, refit(ruler, what, ruler.evaluation(what, what.space.to_search(what.space.start))))
    rubbed = measured(1, "toy.friction", F_c=0.1)
    story = begin(toy_subject(rubbed, ("toy.friction",)), seed=0, workers=None, progress=None)
    assert by_score(story, base, {"toy.friction": end}) == ["toy.friction"]
    fall = base.point.cost - end.point.cost
    assert score(story, base, end) == pytest.approx(fall - np.log(base.point.residual.size), abs=1.0)
    assert promise(tried, end) == 0.0  # it is in; nothing else was tried


def test_what_one_nuisance_does_as_well_is_told() -> None:
    story = begin(toy_subject(measured(1)), seed=0, workers=None, progress=None)
    offset, gain = Suspect("offset", "toy", "x", 0.01), Suspect("gain", "toy", "x", 0.01)
    none = Blame(frozenset({offset}), 100.0, 14.0)
    blamed = {
        "toy.bias": Blame(frozenset(), 99.0, 0.0),
        "toy.friction": Blame(frozenset(), 60.0, 0.0),
        "toy.hardening": Blame(frozenset({offset, gain}), 95.0, 25.0),
    }
    note_mimics(story, none, blamed)
    assert "toy.bias" in story.notes[-1]
    assert "offset of x" in story.notes[-1]
    note_mimics(story, Blame(frozenset({offset, gain}), 100.0, 28.0), {"toy.bias": blamed["toy.bias"]})
    assert len([note for note in story.notes if "would do" in note]) == 1


def test_only_the_linear_implicit_method_is_exchanged() -> None:
    ruler, base, what = rubbing()
    other = replace(ruler, solver=Rk45())
    assert suited(other, base, what, [CATALOGUE["toy.friction"]]) is other
    assert suited(ruler, base, what, [CATALOGUE["toy.friction"]]) is ruler  # friction is no more work than none
