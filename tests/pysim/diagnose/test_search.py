"""A base model whose refit ended in a dent is refitted from where an effect has led it; others stay."""

from pathlib import Path

import numpy as np
import pytest

from pysim.diagnose.corrections import Settled
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.refit import refit_from
from pysim.diagnose.search import _freed
from pysim.diagnose.story import Story, begin
from pysim.diagnose.subject import extended
from tests.pysim.diagnose.toy import CATALOGUE, measured, toy_subject

PLACE = {"m": 2.0, "d": 3.0, "k": 60.0}


def dented(
    *effects: str, refitted: bool, journal: Path | None = None, **values: float
) -> tuple[Story, Settled, Fitted]:
    """The base model far off or refitted, and the model with friction refitted."""
    story = begin(toy_subject(measured(1, *effects, **values)), seed=0, workers=1, progress=None, journal=journal)
    what = extended(story.subject, ())
    first = story.allow(what, what.space.to_search(what.space.start))
    rubbing = extended(story.subject, [CATALOGUE["toy.friction"]])
    start = story.ruler.evaluation(rubbing, rubbing.space.to_search(rubbing.space.start))
    found = Fitted(rubbing, refit_from(story.ruler, rubbing, start)[0])
    far = story.ruler.evaluation(what, what.space.to_search(np.array([PLACE[key] for key in what.space.keys])))
    base = Fitted(what, refit_from(story.ruler, what, first)[0] if refitted else far)
    story.enter("prior", base)
    story.enter("refit", base)
    return story, Settled.as_is(story.ruler, base), found


def test_a_dent_is_left_by_the_way_that_an_effect_has_shown() -> None:
    story, base, found = dented(refitted=False)
    assert story.journal.once("refitted before", lambda: 1) == 1
    better = _freed(story, base, found)
    assert better is not None
    assert better.at.what.effects == ()
    assert better.at.point.cost == pytest.approx(found.point.cost, rel=0.02)
    assert [step.step for step in story.ledger] == [stage.step for stage in story.stages] == ["prior", "refit"]
    assert story.ledger[1].fit == pytest.approx(1.0, abs=0.1)
    assert story.journal.once("refitted before", lambda: 2) == 2  # what was learned from the dent is not used again


def test_without_a_dent_the_refit_stands() -> None:
    story, base, found = dented("toy.friction", refitted=True, F_c=0.4)
    assert base.at.point.cost > 3 * found.point.cost
    assert _freed(story, base, found) is None
    assert story.ledger[1].cost == base.at.point.cost
