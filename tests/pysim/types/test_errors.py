"""A mistake of the user is one sentence, wherever it is shown."""

import pickle

import pytest

from pysim.types import BadInput, with_place


def test_the_cure_stands_behind_the_semicolon() -> None:
    error = BadInput("run1.csv: x lacks 3 samples, the first at 2 s; type data.fill_gaps(0.02)", argument="data")
    assert (error.argument, error.cure) == ("data", "type data.fill_gaps(0.02)")
    assert BadInput("no cure").cure == ""
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.argument) == (str(error), "data")


def test_a_notebook_shows_the_sentence_alone() -> None:
    """IPython asks an exception for `_render_traceback_` and prints the lines that it gives."""
    with pytest.raises(BadInput) as caught:
        raise BadInput("m is no number; give one")
    assert caught.value._render_traceback_() == ["\x1b[31mm is no number; give one\x1b[0m"]


@pytest.mark.parametrize(
    ("where", "shown"),
    [
        ("", "a.toml, line 3: gain = 0; give another"),
        ("a.toml, line 7", "a.toml, line 7: gain = 0; give another"),
    ],
)
def test_a_place_is_said_once(where: str, shown: str) -> None:
    def refuses() -> None:
        raise BadInput("gain = 0; give another", where=where)

    with pytest.raises(BadInput) as caught:
        with_place("a.toml, line 3", refuses)
    assert str(caught.value) == shown
    assert caught.value.where == shown.partition(": ")[0]
    assert with_place("a.toml", lambda: 4) == 4
