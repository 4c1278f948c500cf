"""The tests of a group of cases: a row for each case and check."""

from typing import Any

import pytest

from tests.known_answers.answer import ask
from tests.known_answers.case import Case, cases
from tests.known_answers.checks import CHECKS, asked


def rows(group: str) -> list[Any]:
    """Case and check, for `parametrize`; what today's code fails has to fail."""
    found = []
    for case in cases(group):
        unknown = set(case.failing) - set(asked(case))
        assert not unknown, f"{case.name}: not asked for {', '.join(sorted(unknown))}"
        for check in asked(case):
            why = case.failing.get(check)
            marks = [pytest.mark.xfail(strict=True, raises=AssertionError, reason=why)] if why else []
            marks += [pytest.mark.slow] if case.slow else []
            found.append(pytest.param(case, check, id=f"{case.name}-{check}", marks=marks))
    return found


def verify(case: Case, check: str) -> None:
    """Ask, and hold the answer against what is right."""
    wrong = list(CHECKS[check](case, ask(case)))
    assert not wrong, "; ".join(wrong)
