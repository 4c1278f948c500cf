"""The verdict on a toy whose truth is known; the steps alone; going on after a kill.

Which effects are named, two at once, none and unknown are asked in `tests/known_answers`.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.diagnose import add, against, diagnose, rank
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.story import Story
from pysim.diagnose.subject import subject
from pysim.types import BadInput, Dataset, Diagnosis, Told
from tests.pysim.diagnose.toy import CATALOGUE, NOISE, base, measured, toy_subject


@pytest.fixture(scope="module")
def rubbing() -> Dataset:
    """Dry friction of 0.4 N, in logs of 300 samples each."""
    return measured(1, "toy.friction", F_c=0.4, seconds=6.0)


def test_names_what_is_missing_and_what_these_data_cannot_tell_from_it(rubbing: Dataset) -> None:
    found = diagnose(toy_subject(rubbing, ("toy.friction", "toy.twin", "toy.bias")))
    assert found.verdict in ("toy.friction", "toy.twin")
    assert [sorted(group) for group in found.confusable] == [["toy.friction", "toy.twin"]]
    assert [one.effect.name for one in found.added] == [found.verdict]
    (estimate,) = found.added[0].estimates
    assert abs(estimate.value - 0.4) < 4 * estimate.std
    assert estimate.std < 0.04
    assert [step.step for step in found.error] == ["prior", "refit", found.verdict]
    last = found.error[-1]
    assert last.fit == pytest.approx(1.0, abs=0.15)  # 300 samples: 0.04 standard deviations
    assert last.validate == pytest.approx(1.0, abs=0.15)
    assert found.error[1].fit > 1.2 * last.fit
    assert (found.ranking[0].effect, found.ranking[0].round) == (found.verdict, 1)
    assert found.ranking[0].explained > 0.9


def test_says_none_where_nothing_is_missing() -> None:
    found = diagnose(toy_subject(measured(0, seconds=6.0), ("toy.friction", "toy.bias")))
    assert (found.verdict, found.added, found.confusable) == ("none", (), ())


def test_an_offset_of_the_sensor_is_no_physics() -> None:
    data = measured(2)
    shifted = [
        replace(one, data=replace(one.data, values=one.data.values + np.array([0.0, 0.004])))  # of the position alone
        for one in data.records
    ]
    found = diagnose(toy_subject(replace(data, records=tuple(shifted)), ("toy.bias",)))
    assert found.verdict == "none"
    assert found.error[-1].validate == pytest.approx(1.0, abs=0.1)


def test_a_misfit_far_above_the_noise_is_never_nothing() -> None:
    noisy = measured(5, noise=3 * NOISE, seconds=6.0)
    assert diagnose(toy_subject(noisy, ("toy.friction",))).verdict == "unknown"


def test_an_effect_with_which_what_is_held_out_cannot_be_simulated_is_not_named(
    rubbing: Dataset, monkeypatch: pytest.MonkeyPatch
) -> None:
    def held_out(story: Story, at: Fitted) -> np.ndarray | None:
        return None if at.what.effects else known(story, at)

    known = Story.held_out
    monkeypatch.setattr(Story, "held_out", held_out)
    found = diagnose(toy_subject(rubbing, ("toy.friction",)))
    assert (found.verdict, found.added) == ("unknown", ())


@pytest.mark.slow
def test_a_limit_that_bends_the_base_model_is_looked_for_beside_the_models_own_parameters() -> None:
    data = measured(1, "toy.stop", inverse_x_m=4.0)
    found = diagnose(toy_subject(data, ("toy.friction", "toy.hardening", "toy.bias", "toy.stop")))
    assert found.verdict == "toy.stop"
    assert found.error[1].fit > 100  # the first footprint puts the stop at half its place
    assert found.error[-1].validate == pytest.approx(1.0, abs=0.1)
    (estimate,) = found.added[0].estimates
    assert abs(estimate.value - 4.0) < 4 * estimate.std


def test_a_model_without_its_class_is_refitted_and_none_is_ranked(rubbing: Dataset) -> None:
    closed = replace(toy_subject(rubbing), build_variant=None)
    assert diagnose(closed).verdict == "unknown"
    with pytest.raises(BadInput, match="class is not at hand"):
        rank(closed)


def test_a_model_that_does_not_run_says_where_and_why() -> None:
    given = subject(base(), measured(1, seconds=2.0), (), None, free=("d", "k"), overrides={"m": 0.0})
    (first, *_), *_ = (target.runs for target in given.targets)
    with pytest.raises(BadInput, match=rf"at its own parameters, {first.record}: .+; set others with --set"):
        diagnose(given)


def test_the_model_is_held_against_the_data_as_it_is_and_refitted(rubbing: Dataset) -> None:
    compared = against(toy_subject(rubbing))
    assert [step.step for step in compared.error] == ["prior", "refit"]
    assert compared.verdict == "unknown"
    assert compared.where


def test_ranking_adds_nothing(rubbing: Dataset) -> None:
    ranked = rank(toy_subject(rubbing, ("toy.bias", "toy.friction")))
    assert (ranked.ranking[0].effect, ranked.ranking[0].refitted) == ("toy.friction", True)
    assert ranked.added == ()


def test_effects_are_added_in_the_order_they_are_given(rubbing: Dataset) -> None:
    given = add(toy_subject(rubbing), [CATALOGUE["toy.bias"], CATALOGUE["toy.friction"]])
    assert [step.step for step in given.error] == ["prior", "refit", "toy.bias", "toy.friction"]
    costs = [step.cost for step in given.error]
    assert costs == sorted(costs, reverse=True)
    bias, friction = (one.estimates[0] for one in given.added)
    assert abs(bias.value) < 4 * bias.std  # nothing there to be found, and that is what it says
    assert abs(friction.value - 0.4) < 4 * friction.std


class Killed(Exception):
    pass


def killed(told: Told) -> None:
    if told.stage == "refitting the promising candidates" and told.text:
        raise Killed


def same(one: Diagnosis, other: Diagnosis) -> bool:
    parts = ("verdict", "ranking", "confusable", "error", "parameters", "where", "notes")
    return all(getattr(one, part) == getattr(other, part) for part in parts) and (
        [a.estimates for a in one.added] == [a.estimates for a in other.added]
    )


def test_a_killed_one_goes_on_to_the_same_answer(rubbing: Dataset, tmp_path: Path) -> None:
    given, path = toy_subject(rubbing, ("toy.friction",)), tmp_path / "journal.jsonl"
    with pytest.raises(Killed):
        diagnose(given, progress=killed, journal=path)
    kept = path.read_text()
    resumed = diagnose(given, journal=path)
    assert path.read_text().startswith(kept)
    assert same(diagnose(given), resumed)
    whole = path.read_text()
    assert same(diagnose(given, journal=path), resumed)
    assert path.read_text() == whole
    with pytest.raises(BadInput, match="another diagnosis"):
        diagnose(toy_subject(measured(4, seconds=6.0)), journal=path)
