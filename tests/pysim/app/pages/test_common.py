"""What several pages do alike."""

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
