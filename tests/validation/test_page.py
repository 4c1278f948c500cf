"""The HTML page of a run."""

import pytest
from matplotlib.figure import Figure

from tests.validation import made_up
from tests.validation.made_up import BAD, GOOD, result
from validation.page import suite_page


def test_page(monkeypatch: pytest.MonkeyPatch) -> None:
    made_up.use(monkeypatch)
    results = [result("good", *GOOD), result("bad", *BAD, error="ValueError: <no>")]
    text = suite_page(results, {"good": {"the caption": Figure()}})
    assert "2 claims hold, 1 fail, 1 could not be tried here. 1 cases stopped early." in text
    for words in (
        "no Wine here",
        "the caption",
        "a note",
        "pysim validate good",
        "About bad",
        "Stopped: ValueError: &lt;no&gt;",
        'class="fail">fails',
    ):
        assert words in text
