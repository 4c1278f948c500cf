"""Effects fitted at their places, against truths that the measurements were made with."""

from dataclasses import replace
from functools import cache

import numpy as np

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.locating.known import Known, known
from pysim.diagnose.refit import refit
from pysim.diagnose.residuals import rulers
from pysim.diagnose.subject import Subject, extended
from pysim.types import Dataset
from tests.pysim.diagnose.toy import measured, toy_subject


def fitted(given: Subject) -> tuple[Known, ...]:
    ruler, _ = rulers(given.targets)
    what = extended(given, ())
    first = ruler.evaluation(what, what.space.to_search(what.space.start))
    return tuple(known(given, ruler, Fitted(what, refit(ruler, what, first, rounds=5)), lambda line: None))


@cache
def rubbing() -> Dataset:
    return measured(1, "toy.friction", F_c=0.4)


@cache
def found() -> tuple[Known, ...]:
    return fitted(toy_subject(rubbing()))


def test_the_effect_that_is_there_comes_first_with_its_size() -> None:
    first, *others = found()
    assert (first.effect.name, first.slot) == ("toy.friction", "force")
    assert first.text.startswith("toy.friction, F_c = 0.4")
    assert all(first.worth > 2 * other.worth for other in others)
    n = first.at.point.residual.size
    assert first.at.point.cost < n + 4 * np.sqrt(2 * n)  # noise alone is left


def test_the_doubt_of_a_size_holds_the_truth() -> None:
    first = found()[0]
    size = first.at.what.space.values(first.at.point.x)["force.F_c"]
    assert abs(size - 0.4) < 2 * first.doubt * size
    assert 0 < first.doubt < 0.1


def test_what_the_data_do_not_ask_for_is_worth_nothing() -> None:
    assert all(one.worth < 10 for one in fitted(toy_subject(measured(2))))


def test_without_effects_or_their_class_nothing_is_tried() -> None:
    assert fitted(toy_subject(rubbing(), ())) == ()
    assert fitted(replace(toy_subject(rubbing(), ["toy.friction"]), build_variant=None)) == ()
