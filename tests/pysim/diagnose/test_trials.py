"""Which candidates are refitted on probation, and which once more from other strengths."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.diagnose.fitted import Fitted
from pysim.diagnose.refit import refit_from
from pysim.diagnose.rounds import Tried, screened
from pysim.diagnose.screen import Footprint
from pysim.diagnose.story import Story, begin
from pysim.diagnose.subject import extended
from pysim.diagnose.trials import promising, refitted_elsewhere
from pysim.identify.greybox.evaluation import Evaluation
from tests.pysim.diagnose.toy import CATALOGUE, measured, toy_subject

ROWS = 100


def tried(left: float, gains: dict[str, float]) -> Tried:
    """A round of effects that promise so much; the limit is a stop, all others rub."""
    kinds = {name: CATALOGUE["toy.stop" if name == "limit" else "toy.friction"] for name in gains}
    nothing = np.zeros(ROWS)
    footprints = tuple(
        Footprint(replace(kinds[name], name=name), {}, nothing, nothing, 1.0, gain, 1.0) for name, gain in gains.items()
    )
    current: Any = type("Current", (), {"point": Evaluation(np.zeros(1), left, nothing, nothing[:, None])})
    ruler: Any = None
    return Tried(current, ruler, {}, footprints, {}, 10.0, left)


def names(left: float, gains: dict[str, float]) -> list[str]:
    return [head.effect.name for head in promising(tried(left, gains))]


def test_the_first_three_and_those_that_promise_a_share_of_the_best() -> None:
    assert names(ROWS, {"a": 100.0, "b": 50.0, "c": 4.0, "d": 4.0, "e": 3.0}) == ["a", "b", "c"]
    many = {chr(ord("a") + k): 100.0 - k for k in range(9)}
    assert names(ROWS, many) == list(many)[:7]


def test_limits_too_where_the_parameters_are_bent() -> None:
    gains = {"a": 100.0, "b": 50.0, "c": 40.0, "limit": 1.0}
    assert names(1.5 * ROWS, gains) == ["a", "b", "c"]
    assert names(10.0 * ROWS, gains) == ["a", "b", "c", "limit"]
    assert names(10.0 * ROWS, {**gains, "limit": 200.0}) == ["limit", "a", "b", "c"]


def relaxed(journal: Path) -> tuple[Story, Tried]:
    """A round whose plant has a spring in series with a damper."""
    given = toy_subject(measured(8, "toy.relaxing", T_r=0.4), ("toy.relaxing", "toy.friction"))
    story = begin(given, seed=0, workers=1, progress=None, journal=journal)
    what = extended(story.subject, ())
    base = refit_from(story.ruler, what, story.allow(what, what.space.to_search(what.space.start)))[0]
    story.enter("refit", Fitted(what, base))
    return story, screened(story, Fitted(what, base))


def test_what_cannot_be_switched_off_is_refitted_from_other_strengths(tmp_path: Path) -> None:
    story, tried = relaxed(tmp_path / "journal.jsonl")
    found = refitted_elsewhere(story, tried, {})
    assert list(found) == ["toy.relaxing"]  # friction can be switched off: its first refit tells all
    end = found["toy.relaxing"]
    (strength,) = (key for key in end.what.space.keys if key.endswith("T_r"))
    assert end.what.space.values(end.point.x)[strength] == pytest.approx(0.4, rel=0.05)
    assert end.point.cost == pytest.approx(end.point.residual.size, rel=0.2)
    # not where as much was found before
    better = Fitted(end.what, replace(end.point, cost=0.9 * end.point.cost, residual=0.9 * end.point.residual))
    assert not refitted_elsewhere(story, tried, {"toy.relaxing": better})


def test_refits_from_other_strengths_are_kept(tmp_path: Path) -> None:
    first = refitted_elsewhere(*relaxed(tmp_path / "journal.jsonl"), {})["toy.relaxing"]
    kept = (tmp_path / "journal.jsonl").read_text()
    story, tried = relaxed(tmp_path / "journal.jsonl")
    again = refitted_elsewhere(story, tried, {})["toy.relaxing"]
    assert again.point.x.tolist() == first.point.x.tolist()
    assert (tmp_path / "journal.jsonl").read_text() == kept
