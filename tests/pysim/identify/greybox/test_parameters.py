import numpy as np
import pytest

from pysim.identify.greybox.parameters import Parameter, Tie, parameter_space
from pysim.types import BadInput, Model


def test_bounds_start_and_scale_come_from_the_model(lag: Model) -> None:
    space = parameter_space(lag, [Parameter("K"), Parameter("fragile")])
    assert (space.start[0], space.lower[0], space.upper[0]) == (1.5, 0.1, 10)
    assert space.log.tolist() == [True, False]  # never logarithmic down to zero or below
    assert space.units == ("1", "1")


def test_the_search_sees_logarithms_and_gives_back_what_it_was_given(lag: Model) -> None:
    space = parameter_space(lag, [Parameter("K"), Parameter("T"), Parameter("fragile", start=0.25)])
    x = space.to_search(space.start)
    assert x == pytest.approx([np.log(1.5), np.log(0.4), 0.25 / space.scale[2]])
    assert space.to_model(x) == pytest.approx(space.start, rel=1e-15)
    step = 1e-7
    slope = [(space.to_model(x + step * e) - space.to_model(x - step * e)) @ e / (2 * step) for e in np.eye(3)]
    assert space.slope(x) == pytest.approx(slope, rel=1e-6)
    lower, upper = space.bounds()
    assert np.array_equal(space.to_model(lower), space.lower)
    assert np.array_equal(space.to_model(upper), space.upper)


def test_ties_and_records_reach_the_runs_they_belong_to(lag: Model) -> None:
    free = [Parameter("K"), Parameter("x", record="a"), Parameter("x", start=2.0, record="b")]
    space = parameter_space(lag, free, ties=[Tie("g", "K", 3.0)], fixed={"T": 0.2})
    x = space.to_search(space.start)
    assert space.overrides(x, "b") == pytest.approx({"T": 0.2, "K": 1.5, "g": 4.5, "x": 2.0})
    assert space.overrides(x, "c") == pytest.approx({"T": 0.2, "K": 1.5, "g": 4.5})
    names, slopes = space.chain(x, "b")
    assert names == ("K", "x", "g")
    assert slopes == pytest.approx(np.array([[1.5, 0, 0], [0, 0, space.scale[2]], [4.5, 0, 0]]))
    assert space.values(x)["x@b"] == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("free", "more", "message"),
    [
        ([Parameter("K"), Parameter("K")], {}, "named twice"),
        ([Parameter("K")], {"fixed": {"K": 1.0}}, "named twice"),
        ([Parameter("K", start=20.0)], {}, "outside its bounds"),
        ([Parameter("fragile", log=True)], {}, "logarithmic scale"),
        ([Parameter("K")], {"ties": [Tie("g", "T")]}, "not free"),
        ([Parameter("w")], {}, "cannot be set"),
        ([Parameter("K")], {"fixed": {"g": float("nan")}}, "finite"),
        ([Parameter("Kay")], {}, "no variable 'Kay'"),
    ],
)
def test_what_cannot_be_is_refused_with_its_name(lag: Model, free: list, more: dict, message: str) -> None:
    with pytest.raises(BadInput, match=message):
        parameter_space(lag, free, **more)
