"""Structures: counting, naming, refusing."""

import pytest

from pysim.identify.blackbox import Structure
from pysim.types import BadInput


def test_counts_and_names() -> None:
    assert (Structure(5).parameters, Structure(5).label) == (6, "5 poles, no zeros")
    delayed = Structure(1, 2, dead_time_max=0.1)
    assert (delayed.parameters, delayed.label) == (5, "1 pole, 2 zeros, dead time")
    assert Structure(2, 1, dead_time=0.02).label == "2 poles, 1 zero, dead time 0.02 s"


@pytest.mark.parametrize(
    "words",
    [{"poles": -1}, {"poles": 1, "zeros": -1}, {"poles": 1, "dead_time": -1.0}, {"poles": 1, "dead_time": 1e999}],
)
def test_refuses_what_cannot_be(words: dict) -> None:
    with pytest.raises(BadInput, match="structure: "):
        Structure(**words)


def test_refuses_an_empty_range_of_dead_times() -> None:
    with pytest.raises(BadInput, match="raise dead_time_max"):
        Structure(1, dead_time=0.1, dead_time_max=0.1)
