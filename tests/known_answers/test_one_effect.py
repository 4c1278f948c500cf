"""Plants that lack one effect."""

from pathlib import Path

import pytest

from tests.known_answers.answer import ask
from tests.known_answers.case import CASES, Case, read_case
from tests.known_answers.contract import SECOND, broken
from tests.known_answers.rows import rows, verify


@pytest.mark.parametrize(("case", "check"), rows("one_effect"))
def test_known_answer(case: Case, check: str) -> None:
    verify(case, check)


@pytest.mark.parametrize("key", SECOND)
def test_key_of_the_second_stage(key: str) -> None:
    data = ask(read_case(CASES / "one_effect" / "friction.toml")).data
    assert not list(broken(data, Path(), {key: SECOND[key]}))
