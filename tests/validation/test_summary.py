"""The summary in Markdown."""

import pytest

from tests.validation import made_up
from tests.validation.made_up import BAD, GOOD, result
from validation.summary import BEGIN, END, between_markers, full_summary, short_summary


@pytest.fixture(autouse=True)
def _cases(monkeypatch: pytest.MonkeyPatch) -> None:
    made_up.use(monkeypatch)


def test_short() -> None:
    text = short_summary([result("good", *GOOD), result("bad", *BAD)])
    assert "| Methods on known answers | 2 of 4 | 2 | 1 | 1 |" in text
    assert "- [bad](validation/bad/README.md): fails: c | d: 2.5 deg, limit 2" in text
    assert "No claim" not in text
    assert short_summary([result("good", *GOOD)]).count("No claim of a recorded case fails.") == 1


def test_full() -> None:
    text = full_summary([result("good", *GOOD), result("broken", GOOD[0], error="ValueError: no good")])
    assert "| [good](good/README.md) | about good | 1 | 0 | 1 | 2 | 2026-01-02 |" in text
    assert "| [bad](bad/README.md) | about bad |  |  |  |  | not recorded |" in text
    assert "- skipped: b: no Wine here" in text
    run = full_summary([result("good", *GOOD)], kept=False)
    assert "| good |" in run
    assert "not recorded" not in run
    assert "Circuits" not in run
    assert "- stopped: ValueError: no good" in text
    assert "a processor, 2 cores" in text


def test_between_markers() -> None:
    text = f"before\n{BEGIN}\nold\n{END}\nafter\n"
    new = between_markers(text, "\nnew\n")
    assert new == f"before\n{BEGIN}\nnew\n{END}\nafter\n"
    assert between_markers(new, "new") == new
    for wrong in ("", BEGIN, f"{END} {BEGIN}", f"{BEGIN} {BEGIN} {END}"):
        with pytest.raises(ValueError, match="once each"):
            between_markers(wrong, "new")
