"""The verdict on a toy whose truth is known; the steps alone; going on after a kill."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.diagnose import add, against, diagnose, rank
from pysim.diagnose.fitted import Fitted
from pysim.diagnose.story import Story
from pysim.diagnose.subject import Subject, subject
from pysim.types import BadInput, Diagnosis, Told
from tests.pysim.diagnose.toy import CATALOGUE, NOISE, base, measured, toy_subject


@pytest.mark.parametrize(
    ("effect", "values"),
    [("toy.friction", {"F_c": 0.4}), ("toy.hardening", {"k_3": 6.0}), ("toy.bias", {"F_b": -0.2})],
)
def test_names_what_is_missing(effect: str, values: dict[str, float]) -> None:
    found = diagnose(toy_subject(measured(1, effect, **values)))
    assert found.verdict == effect
    assert [one.effect.name for one in found.added] == [effect]
    (estimate,) = found.added[0].estimates
    (truth,) = values.values()
    assert abs(estimate.value - truth) < 4 * estimate.std
    assert estimate.std < 0.1 * abs(truth)
    assert found.confusable == ()
    assert [step.step for step in found.error] == ["prior", "refit", effect]
    last = found.error[-1]
    assert last.fit == pytest.approx(1.0, abs=0.1)  # 600 samples: 0.03 standard deviations
    assert last.validate == pytest.approx(1.0, abs=0.1)
    assert found.error[1].fit > 1.2 * last.fit
    assert (found.ranking[0].effect, found.ranking[0].round) == (effect, 1)
    assert found.ranking[0].explained > 0.9


def test_an_effect_with_which_what_is_held_out_cannot_be_simulated_is_not_named(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def held_out(story: Story, at: Fitted) -> np.ndarray | None:
        return None if at.what.effects else known(story, at)

    known = Story.held_out
    monkeypatch.setattr(Story, "held_out", held_out)
    found = diagnose(toy_subject(measured(1, "toy.friction", F_c=0.4)))
    assert (found.verdict, found.added) == ("unknown", ())
    assert "toy.friction makes a model that cannot be simulated on what is held out: not named" in found.reason


def test_a_limit_that_bends_the_base_model_is_looked_for_beside_the_models_own_parameters() -> None:
    data = measured(1, "toy.stop", inverse_x_m=4.0)
    found = diagnose(toy_subject(data, ("toy.friction", "toy.hardening", "toy.bias", "toy.stop")))
    assert found.verdict == "toy.stop"
    assert found.error[1].fit > 100  # the first footprint puts the stop at half its place
    assert found.error[-1].fit == pytest.approx(1.0, abs=0.1)
    assert found.error[-1].validate == pytest.approx(1.0, abs=0.1)
    (estimate,) = found.added[0].estimates
    assert abs(estimate.value - 4.0) < 4 * estimate.std


def test_two_effects_at_once_are_both_named() -> None:
    truth = {"toy.friction": {"F_c": 0.4}, "toy.hardening": {"k_3": 6.0}}
    found = diagnose(toy_subject(measured(3, *truth, **truth["toy.friction"], **truth["toy.hardening"])))
    assert sorted(one.effect.name for one in found.added) == sorted(truth)
    assert found.verdict == found.added[0].effect.name
    for one in found.added:
        (estimate,) = one.estimates
        (value,) = truth[one.effect.name].values()
        assert abs(estimate.value - value) < 4 * estimate.std
    assert {row.round for row in found.ranking} >= {1, 2}


@pytest.mark.parametrize("seed", range(5))
def test_says_none_where_nothing_is_missing(seed: int) -> None:
    found = diagnose(toy_subject(measured(seed)))
    assert found.verdict == "none"
    assert found.added == ()
    assert found.confusable == ()


def test_an_offset_of_the_sensor_is_no_physics() -> None:
    data = measured(2)
    shifted = [
        replace(one, data=replace(one.data, values=one.data.values + np.array([0.0, 0.004])))  # of the position alone
        for one in data.records
    ]
    found = diagnose(toy_subject(replace(data, records=tuple(shifted))))
    assert found.verdict == "none"
    assert any("x is off by +0.00" in note for note in found.notes)
    assert found.error[-1].validate == pytest.approx(1.0, abs=0.1)


def test_says_unknown_where_the_catalogue_lacks_the_effect() -> None:
    found = diagnose(toy_subject(measured(1, "toy.hardening", k_3=20.0), ("toy.bias", "toy.friction")))
    assert found.verdict == "unknown"


def test_a_misfit_far_above_the_noise_is_never_nothing() -> None:
    assert diagnose(toy_subject(measured(5, noise=3 * NOISE))).verdict == "unknown"


def test_equals_are_reported_as_a_set() -> None:
    found = diagnose(toy_subject(measured(1, "toy.friction", F_c=0.4), ("toy.friction", "toy.twin", "toy.bias")))
    assert found.verdict in ("toy.friction", "toy.twin")
    assert [sorted(group) for group in found.confusable] == [["toy.friction", "toy.twin"]]
    assert len(found.added) == 1


def test_a_model_without_its_class_is_refitted_and_says_so() -> None:
    subject = replace(toy_subject(measured(1, "toy.friction", F_c=0.4)), build_variant=None)
    found = diagnose(subject)
    assert found.verdict == "unknown"
    assert "no effect could be tried" in found.reason
    with pytest.raises(BadInput, match="class is not at hand"):
        rank(subject)


def test_a_model_that_does_not_run_says_where_and_why() -> None:
    given = subject(base(), measured(1), (), None, free=("d", "k"), overrides={"m": 0.0})
    (first, *_), *_ = (target.runs for target in given.targets)
    with pytest.raises(BadInput, match=rf"at its own parameters, {first.record}: .+; set others with --set"):
        diagnose(given)


def test_the_steps_alone() -> None:
    subject = toy_subject(measured(1, "toy.friction", F_c=0.4))
    compared = against(subject)
    assert [step.step for step in compared.error] == ["prior", "refit"]
    assert compared.verdict == "unknown"
    assert compared.where
    assert [step.step for step in against(subject, refitted=False).error] == ["prior"]
    ranked = rank(subject)
    assert ranked.reason.endswith("effects were ranked, none was added")
    assert diagnose(subject, most=0).reason.endswith("no effect was tried")
    assert ranked.ranking[0].effect == "toy.friction"
    assert ranked.ranking[0].refitted
    assert ranked.added == ()
    given = add(subject, [CATALOGUE["toy.bias"], CATALOGUE["toy.friction"]])
    assert [step.step for step in given.error] == ["prior", "refit", "toy.bias", "toy.friction"]
    costs = [step.cost for step in given.error]
    assert costs == sorted(costs, reverse=True)
    bias, friction = (one.estimates[0] for one in given.added)
    assert abs(bias.value) < 4 * bias.std  # nothing there to be found, and that is what it says
    assert abs(friction.value - 0.4) < 4 * friction.std


class Killed(Exception):
    pass


def killed_at(stage: str, count: int, subject: Subject, path: Path) -> None:
    """Run until something is said in a stage for the count-th time."""
    said: list[str] = []

    def progress(told: Told) -> None:
        said.append(told.stage)
        if told.text and said.count(stage) > count:
            raise Killed

    with pytest.raises(Killed):
        diagnose(subject, progress=progress, journal=path)


def same(one: Diagnosis, other: Diagnosis) -> bool:
    parts = ("verdict", "reason", "ranking", "confusable", "error", "parameters", "where", "notes")
    return all(getattr(one, part) == getattr(other, part) for part in parts) and (
        [a.estimates for a in one.added] == [a.estimates for a in other.added]
    )


def test_a_killed_one_goes_on_to_the_same_answer(tmp_path: Path) -> None:
    data = measured(3, "toy.friction", "toy.hardening", F_c=0.4, k_3=6.0)
    whole = diagnose(toy_subject(data))
    path = tmp_path / "journal.jsonl"
    seen = 0
    for stage, count in (
        ("refitting the model", 1),
        ("refitting the promising candidates", 1),
        ("screening 2 candidates", 0),
    ):
        killed_at(stage, count, toy_subject(data), path)
        lines = len(path.read_text().splitlines())
        assert lines >= seen
        seen = lines
    stages: list[str] = []
    resumed = diagnose(toy_subject(data), journal=path, progress=lambda told: stages.append(told.stage))
    assert same(whole, resumed)
    assert "screening 3 candidates" not in stages  # the first round was finished
    before = path.read_text()
    assert same(whole, diagnose(toy_subject(data), journal=path))
    assert path.read_text() == before
    with pytest.raises(BadInput, match="another diagnosis"):
        diagnose(toy_subject(measured(4)), journal=path)
