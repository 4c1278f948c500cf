"""A plant is diagnosed ahead of the first test that asks for its answer."""

import pytest

from tests.known_answers.answer import ask
from tests.known_answers.case import Case


@pytest.fixture(autouse=True)
def answered(request: pytest.FixtureRequest) -> None:
    """Ask for the answer of the test's case; all checks of the case share it."""
    parameters = getattr(getattr(request.node, "callspec", None), "params", {})
    if isinstance(parameters.get("case"), Case):
        ask(parameters["case"])
