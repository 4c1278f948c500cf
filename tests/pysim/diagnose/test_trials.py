"""Which candidates are refitted on probation."""

from dataclasses import replace
from typing import Any

import numpy as np

from pysim.diagnose.rounds import Tried
from pysim.diagnose.screen import Footprint
from pysim.diagnose.trials import promising
from pysim.identify.greybox.evaluation import Evaluation
from tests.pysim.diagnose.toy import CATALOGUE

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
