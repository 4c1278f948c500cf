"""The verdict on a toy whose truth is known."""

import pytest

from pysim.diagnose import diagnose, subject
from tests.pysim.diagnose.toy import CATALOGUE, base, measured, toy_subject


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
    assert found.ranking[0].effect == effect
    assert found.ranking[0].explained > 0.9


@pytest.mark.parametrize("seed", range(5))
def test_says_none_where_nothing_is_missing(seed: int) -> None:
    found = diagnose(toy_subject(measured(seed)))
    assert found.verdict == "none"
    assert found.added == ()
    assert len(found.ranking) == 3  # everything was looked at all the same


@pytest.mark.parametrize(
    ("effect", "values", "left"),
    [
        ("toy.hardening", {"k_3": 12.0}, ("toy.friction", "toy.bias")),
        ("toy.bias", {"F_b": 0.5}, ("toy.friction", "toy.hardening")),
    ],
)
def test_says_unknown_where_the_catalogue_lacks_it(effect: str, values: dict[str, float], left: tuple[str]) -> None:
    found = diagnose(toy_subject(measured(2, effect, **values), left))
    assert found.verdict == "unknown"


def test_what_cannot_be_told_apart_is_a_set() -> None:
    found = diagnose(toy_subject(measured(3, "toy.friction", F_c=0.4), tuple(CATALOGUE)))
    assert found.verdict in ("toy.friction", "toy.twin")
    assert [set(group) for group in found.confusable] == [{"toy.friction", "toy.twin"}]


def test_the_same_seed_gives_the_same_answer() -> None:
    data = measured(4, "toy.friction", F_c=0.3)
    one, other = (diagnose(toy_subject(data), seed=7, workers=count) for count in (1, 2))
    assert one.verdict == other.verdict == "toy.friction"
    assert one.ranking == other.ranking
    assert one.parameters == other.parameters


def test_without_the_class_nothing_is_named() -> None:
    given = subject(base(), measured(1, "toy.bias", F_b=-0.4), tuple(CATALOGUE.values()), None)
    found = diagnose(given)
    assert found.verdict == "unknown"
    assert any("class is not at hand" in note for note in found.notes)
