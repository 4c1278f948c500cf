"""Which candidates are refitted on probation, which from where a leader has led, and which from other strengths."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pysim.diagnose import trials
from pysim.diagnose.contenders import Contender
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.refit import refit_from
from pysim.diagnose.rounds import Tried, screened
from pysim.diagnose.scores import score
from pysim.diagnose.screen import Footprint
from pysim.diagnose.story import Story, begin
from pysim.diagnose.subject import extended
from pysim.diagnose.trials import promising, refitted, refitted_elsewhere
from pysim.identify.greybox.residuals import Point
from pysim.types import Dataset
from tests.pysim.diagnose.toy import CATALOGUE, measured, toy_subject

ROWS = 100


def tried(left: float, gains: dict[str, float]) -> Tried:
    """A round of effects that promise so much; the limit is a stop, all others rub."""
    kinds = {name: CATALOGUE["toy.stop" if name == "limit" else "toy.friction"] for name in gains}
    nothing = np.zeros(ROWS)
    footprints = tuple(
        Footprint(replace(kinds[name], name=name), {}, nothing, nothing, 1.0, gain, 1.0) for name, gain in gains.items()
    )
    current: Any = type("Current", (), {"point": Point(np.zeros(1), left, nothing, nothing[:, None])})
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


def round_of(names: tuple[str, ...], dataset: Dataset, journal: Path | None = None) -> tuple[Story, Tried]:
    """A round with some effects of the catalogue, begun."""
    story = begin(toy_subject(dataset, names), seed=0, workers=1, progress=None, journal=journal)
    what = extended(story.subject, ())
    base = refit_from(story.ruler, what, story.allow(what, what.space.to_search(what.space.start)))[0]
    story.enter("refit", Fitted(what, base))
    return story, screened(story, Fitted(what, base))


def stalled(monkeypatch: pytest.MonkeyPatch, dataset: Dataset) -> tuple[Story, Tried, dict[str, Fitted]]:
    """Refits of two kinds of dry friction, where a cheap one of that with less parameters comes to nothing."""
    story, tried = round_of(("toy.friction", "toy.falling"), dataset)
    cheap = trials._probation

    def probation(tried: Tried, one: Contender, nominal: Fitted | None) -> Point | None:
        return None if one.effect.name == "toy.friction" else cheap(tried, one, nominal)

    monkeypatch.setattr(trials, "_probation", probation)
    return story, tried, refitted(story, tried, None)


def test_a_special_case_of_the_leader_is_refitted_from_where_it_has_led(monkeypatch: pytest.MonkeyPatch) -> None:
    story, tried, found = stalled(monkeypatch, measured(9, "toy.friction", F_c=0.3))
    less, more = found["toy.friction"], found["toy.falling"]
    (strength,) = (key for key in less.what.space.keys if key.endswith("F_c"))
    assert less.what.space.values(less.point.x)[strength] == pytest.approx(0.3, rel=0.05)
    assert less.point.cost == pytest.approx(more.point.cost, abs=5.0)
    assert score(story, tried.current, less) > score(story, tried.current, more)


def test_it_is_not_where_the_leader_is_needed_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    story, tried, found = stalled(monkeypatch, measured(9, "toy.falling", F_c=0.1, F_d=0.8))
    assert max(found, key=lambda name: score(story, tried.current, found[name])) == "toy.falling"


def relaxed(journal: Path) -> tuple[Story, Tried]:
    """A round whose plant has a spring in series with a damper."""
    return round_of(("toy.relaxing", "toy.friction"), measured(8, "toy.relaxing", T_r=0.4), journal)


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
