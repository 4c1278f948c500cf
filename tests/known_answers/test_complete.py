"""Complete plants: nothing is missing, whatever their noise and what is said of it."""

import pytest

from tests.known_answers.case import Case
from tests.known_answers.rows import rows, verify


@pytest.mark.parametrize(("case", "check"), rows("complete"))
def test_known_answer(case: Case, check: str) -> None:
    verify(case, check)
