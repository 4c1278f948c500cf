"""Units at both ends of a wire."""

from collections.abc import Sequence

import numpy as np
import pytest

from pysim.cosim import Connection, Doubling, GaussSeidel, Order, Sampled, System, cosimulate
from pysim.types import BadInput, Experiment, Port
from tests.cosim_parts import Linear
from tests.pysim.cosim.order_cases import ORDERS


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


@pytest.mark.parametrize(
    ("source", "target", "cure", "law"),
    [
        ("degC", "K", "offset=273.15", {"offset": 273.15}),
        ("K", "degC", "offset=-273.15", {"offset": -273.15}),
        ("degF", "degC", "factor=0.555555555556, offset=-17.7777777778", {"factor": 5 / 9, "offset": -160 / 9}),
    ],
)
def test_temperatures_have_a_zero_of_their_own(source: str, target: str, cure: str, law: dict[str, float]) -> None:
    with pytest.raises(BadInput, match=f"the output is in '{source}', the input in '{target}'; give {cure}$"):
        Connection("a.y", "b.u").check_units(source, target)
    with pytest.raises(BadInput, match=f"give {cure}$"):
        Connection("a.y", "b.u", factor=-1.0).check_units(source, target)
    with pytest.raises(BadInput, match=f"give {cure}$"):
        Connection("a.y", "b.u", factor=1.0).check_units(source, target)
    Connection("a.y", "b.u", **law).check_units(source, target)


def test_gauge_to_absolute_pressure() -> None:
    Connection("a.y", "b.u", offset=101325.0).check_units("Pa", "Pa")
    Connection("a.y", "b.u", factor=1e5, offset=101325.0).check_units("bar", "Pa")
    with pytest.raises(BadInput, match="the factor is 100000, not 1; give factor=100000"):
        Connection("a.y", "b.u", offset=101325.0).check_units("bar", "Pa")


def test_units_of_different_kinds_need_a_factor_that_is_known() -> None:
    with pytest.raises(BadInput, match="'rad', the input in '%'; connect another, or give the factor you know"):
        Connection("a.y", "b.u").check_units("rad", "%")
    Connection("a.y", "b.u", factor=100 / 0.26).check_units("rad", "%")


def test_the_same_unit_takes_any_factor() -> None:
    Connection("a.y", "b.u").check_units("furlong", "furlong")
    Connection("a.y", "b.u", factor=-3.0).check_units("Pa", "Pa")
    assert Connection("a.y", "b.u", factor=np.int64(2)).gain == 2


@pytest.mark.parametrize("factor", [0.0, float("nan"), float("inf")])
def test_a_factor_is_a_number(factor: float) -> None:
    with pytest.raises(BadInput, match=r"a\.y -> b\.u"):
        Connection("a.y", "b.u", factor=factor)
    with pytest.raises(BadInput, match="the offset is"):
        Connection("a.y", "b.u", offset=factor or "warm")  # type: ignore[arg-type]


@pytest.mark.parametrize("order", [*ORDERS, Doubling(1e-5)], ids=repr)
def test_offsets_go_over_wires_in_every_order(order: Order | Doubling) -> None:
    oil = Linear("oil", (), (Port("T", "degC"),), A=[[-1]], B=np.zeros((1, 0)), C=[[1]], x0=[20.0])
    wall = Linear("wall", (Port("T", "K"),), (Port("y", "K"),), A=[[-1]], B=[[1]], C=[[1]], takes_rates=True)
    mean = Linear("mean", (Port("T", "K"),), (Port("y", "K"),), A=[[-1]], B=[[1]], C=[[1]])
    display = Sampled("display", Sum(), every=0.1)
    wires = [Connection("oil.T", f"{name}.T", offset=273.15) for name in ("wall", "mean", "display")]
    if isinstance(order, GaussSeidel) and order.order:
        order = GaussSeidel(("mean", "wall", "oil"), order.lines)
    doubling, order = (order, None) if isinstance(order, Doubling) else (None, order)
    times = np.linspace(0, 2, 21)
    record = cosimulate(
        System((oil, wall, mean, display), tuple(wires)),
        Experiment(times, ("wall.y", "mean.y", "display.sum", "wall.T")),
        step=1e-3,
        order=order,
        doubling=doubling,
    )
    # dy/dt = 273.15 + 20 exp(-t) - y; a step of 1 ms that holds its input is 0.004 K off at the most
    exact = 273.15 * (1 - np.exp(-times)) + 20 * times * np.exp(-times)
    np.testing.assert_allclose(record["wall.y"], exact, atol=5e-3)
    np.testing.assert_allclose(record["mean.y"], exact, atol=5e-3)
    np.testing.assert_allclose(record["display.sum"], 273.15 + 20 * np.exp(-times) + 1, rtol=1e-12)
    np.testing.assert_allclose(record["wall.T"], 273.15 + 20 * np.exp(-times), rtol=1e-12)


class Sum:
    inputs = (Port("T", "K"), Port("more", "K", 1.0))
    outputs = (Port("sum", "K"),)

    def step(self, time: float, inputs: Sequence[float]) -> tuple[float]:
        return (sum(inputs),)
