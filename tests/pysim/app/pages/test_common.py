"""What several pages do alike."""

from collections.abc import Callable

import pytest

from pysim.app.pages import common
from pysim.types import BadInput


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (BadInput("no model yet; name one"), "no model yet; name one"),
        (PermissionError(13, "Access is denied", "job.json"), "job.json: Access is denied; close the program that"),
    ],
)
def test_a_button_never_fails_without_a_word(monkeypatch: pytest.MonkeyPatch, error: Exception, words: str) -> None:
    said: list[str] = []
    monkeypatch.setattr(common, "say", lambda told, *, bad: said.append(told))

    common.refused(error)
    assert said[0].startswith(words)


def test_a_number_that_is_refused_is_not_said_to_be_none(monkeypatch: pytest.MonkeyPatch) -> None:
    """Factor 0 is a number, and why it cannot be is said by whoever refuses it."""
    written: list[Callable[[str], None]] = []
    said: list[str] = []
    monkeypatch.setattr(common, "Entry", lambda label, value, put, props: written.append(put))
    monkeypatch.setattr(common, "say", lambda told, *, bad: said.append(told))

    def put(value: float | None) -> None:
        if value == 0:
            raise BadInput("factor cannot be 0")

    common.amount(None, put, "factor of x", signed=True)
    with pytest.raises(BadInput, match="factor cannot be 0"):
        written[0]("0")
    assert said == []
    written[0]("much")
    assert "'much' is no number" in said[0]
