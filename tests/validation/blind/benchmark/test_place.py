"""What is kept of places that were found, by hand; and a small case from its logs to its place."""

import numpy as np
import pytest

from pysim.types import Missing
from pysim.types.diagnosis import Shape
from validation.blind.benchmark.place import judged, locate_case
from validation.blind.plant import Case, cases

CASE = next(case for case in cases(1) if case.name == "named-friction.coulomb-middle-n0.1-u")


def missing(slot: str, over: str, **more: object) -> Missing:
    v = np.linspace(-0.05, 0.05, 80)
    truth = -CASE.strengths().coulomb__F_c * np.tanh(v / 1e-3)
    return Missing(slot, 0.9, over, Shape(v, truth, truth - 5, truth + 5, "m/s", "N"), "said", **more)


def test_the_right_place_with_the_right_term() -> None:
    told = judged(CASE, (missing("pistonForce", "pistonForce.v"), missing("oil", "oil.p")))
    assert (told["slot"], told["rank"], told["over"], told["said"]) == ("pistonForce", 1, "pistonForce.v", "said")
    assert told["cover"] == 1


def test_a_wrong_place_and_what_is_tied_with_it() -> None:
    told = judged(CASE, (missing("oil", "oil.p", alike=("pistonForce",)), missing("pistonForce", "pistonForce.x")))
    assert (told["slot"], told["alike"], told["rank"]) == ("oil", ("pistonForce",), 2)
    assert "cover" not in told  # friction is no function of the position


def test_forces_are_compared_at_the_same_stroke() -> None:
    stretched = missing("pistonForce", "pistonForce.v", parameters={"L": 1.2 * CASE.parameters().L})
    assert judged(CASE, (stretched,))["cover"] < 0.5


def test_a_place_that_was_not_looked_at() -> None:
    assert judged(CASE, (missing("oil", "oil.p"),)) == {"slot": "oil", "alike": ()}
    assert judged(CASE, ())["trouble"]


@pytest.mark.slow
def test_a_case_is_located() -> None:
    answer = locate_case(Case("a", "named", (("friction.coulomb", "large"),), noise=0.1, spool=True, seed=5))
    assert (answer.slot, answer.rank) == ("pistonForce", 1)
    assert answer.cover is not None
    assert answer.cover > 0.5
