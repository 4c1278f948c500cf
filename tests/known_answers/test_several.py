"""Plants that lack two effects."""

import pytest

from tests.known_answers.case import Case
from tests.known_answers.rows import rows, verify


@pytest.mark.parametrize(("case", "check"), rows("several"))
def test_known_answer(case: Case, check: str) -> None:
    verify(case, check)
