"""A law in no catalogue, and logs that begin in motion."""

import pytest

from tests.known_answers.case import Case
from tests.known_answers.rows import rows, verify


@pytest.mark.parametrize(("case", "check"), rows("hard"))
def test_known_answer(case: Case, check: str) -> None:
    verify(case, check)
