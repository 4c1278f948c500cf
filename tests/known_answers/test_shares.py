"""The right shares and the right order in the files of the cases, counted again by SciPy on the plant's equations."""

import pytest

from tests.known_answers.case import Case, cases
from tests.known_answers.shares import losses, misfit, shares

_REFITTED = [case for case in cases() if "refit" in case.right]
_SEVERAL = list(cases("several"))


@pytest.mark.slow
@pytest.mark.parametrize("case", _REFITTED, ids=lambda case: case.name)
def test_what_the_refitted_base_model_leaves_is_that_of_the_plant(case: Case) -> None:
    assert (1 + misfit(case, [])) ** 0.5 == pytest.approx(case.right["refit"], rel=0.005)


@pytest.mark.slow
@pytest.mark.parametrize("case", _SEVERAL, ids=lambda case: case.name)
def test_shares_and_order_are_those_of_the_plant(case: Case) -> None:
    assert shares(case) == pytest.approx(case.right["shares"], abs=0.01)
    lost = losses(case)
    assert sorted(lost, key=lambda name: -lost[name]) == case.right["effects"]
    assert max(lost.values()) > 1.2 * min(lost.values()), "the order says little"
