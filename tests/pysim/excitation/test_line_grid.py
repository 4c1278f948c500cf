import numpy as np
import pytest

from pysim.excitation import LineGrid
from pysim.types import BadInput


def test_full_and_odd_lines_fill_the_band() -> None:
    full = LineGrid(10.0, 0.1, 1.0, "full")
    assert full.excited.tolist() == list(range(1, 11))
    assert full.even_detection.size == full.odd_detection.size == 0
    odd = LineGrid(10.0, 0.1, 1.0, "odd")
    assert odd.excited.tolist() == [1, 3, 5, 7, 9]
    assert odd.even_detection.tolist() == [2, 4, 6, 8, 10]
    assert odd.odd_detection.size == 0
    np.testing.assert_allclose(odd.frequencies(odd.excited), [0.1, 0.3, 0.5, 0.7, 0.9])


@pytest.mark.parametrize("group", [2, 3, 4, 7])
def test_random_odd_leaves_one_line_out_of_each_group(group: int) -> None:
    grid = LineGrid(10.0, 0.3, 30.0, "random-odd", group=group, seed=5)
    odd = np.arange(3, 301, 2)
    whole = odd[: odd.size // group * group].reshape(-1, group)
    excited = np.isin(whole, grid.excited)
    assert (excited.sum(axis=1) == group - 1).all()
    np.testing.assert_array_equal(whole[~excited], grid.odd_detection)
    np.testing.assert_array_equal(np.union1d(grid.excited, grid.odd_detection), odd)
    places = np.argmin(excited, axis=1)
    assert set(places) == set(range(group))  # not always the same place


def test_the_seed_decides_which() -> None:
    first, again, other = (LineGrid(10.0, 0.1, 30.0, seed=s).odd_detection for s in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


def test_line_zero_is_never_in_the_band() -> None:
    assert LineGrid(2.0, 0.0, 2.0, "full").band.tolist() == [1, 2, 3, 4]


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"kind": "even"}, "write one of full, odd, random-odd"),
        ({"group": 1}, "groups of 1"),
        ({"low_hz": 0.51, "high_hz": 0.59}, "no line to excite from 0.51 to 0.59 Hz, 0.1 Hz apart"),
        ({"period": 0.0}, "the period is 0 s"),
        ({"low_hz": float("nan")}, "the lowest frequency is nan Hz"),
        ({"seed": -1}, "the seed is -1; give a whole number that is not negative"),
        ({"high_hz": 1e9}, r"1e\+10 sines are too many"),
    ],
)
def test_refuses_what_is_no_grid(wrong: dict, words: str) -> None:
    with pytest.raises(BadInput, match=words):
        LineGrid(**({"period": 10.0, "low_hz": 0.1, "high_hz": 30.0} | wrong))
