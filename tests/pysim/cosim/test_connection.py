"""Units at both ends of a wire."""

import pytest

from pysim.cosim import Connection
from pysim.types import BadInput


@pytest.mark.parametrize(
    ("source", "target", "factor"),
    [
        ("bar", "Pa", "100000"),
        ("Pa", "bar", "1e-05"),
        ("rpm", "rad/s", "0.104719755"),
        ("1", "%", "100"),
        ("l", "m3", "0.001"),
    ],
)
def test_the_factor_is_the_cure(source: str, target: str, factor: str) -> None:
    with pytest.raises(BadInput, match=rf"a\.y -> b\.u: the output is in '{source}'.*give factor={factor}") as caught:
        Connection("a.y", "b.u").check_units(source, target)
    cure = float(str(caught.value).rpartition("=")[2])
    Connection("a.y", "b.u", factor=cure).check_units(source, target)
    Connection("a.y", "b.u", factor=-cure).check_units(source, target)
    with pytest.raises(BadInput, match=f"the factor is {factor}"):
        Connection("a.y", "b.u", factor=2 * cure).check_units(source, target)


def test_units_of_different_kinds_need_a_factor_that_is_known() -> None:
    with pytest.raises(BadInput, match="'rad', the input in '%'; connect another, or give the factor you know"):
        Connection("a.y", "b.u").check_units("rad", "%")
    Connection("a.y", "b.u", factor=100 / 0.26).check_units("rad", "%")


def test_the_same_unit_takes_any_factor() -> None:
    Connection("a.y", "b.u").check_units("furlong", "furlong")
    Connection("a.y", "b.u", factor=-3.0).check_units("Pa", "Pa")


@pytest.mark.parametrize("factor", [0.0, float("nan"), float("inf")])
def test_a_factor_is_a_number(factor: float) -> None:
    with pytest.raises(BadInput, match=r"a\.y -> b\.u"):
        Connection("a.y", "b.u", factor=factor)
