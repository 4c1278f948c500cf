"""Who goes first."""

import numpy as np
import pytest

from pysim.control import Gain
from pysim.cosim import Connection, GaussSeidel, Sampled, System, cosimulate
from pysim.cosim.gauss_seidel import stepping_order
from pysim.types import BadInput, Experiment, Port, Signal
from tests.cosim_parts import Linear, oscillators


def lag(name: str) -> Linear:
    """dy/dt = u - y."""
    return Linear(name, (Port("u"),), (Port("y"),), A=[[-1.0]], B=[[1.0]], C=[[1.0]])


def test_members_follow_those_that_drive_them() -> None:
    parts = (lag("c"), lag("a"), Sampled("s", Gain(1.0), 0.1), lag("b"))
    wires = [Connection(f"{one}.y", f"{other}.u") for one, other in ("as", "sb", "bc")]
    system = System(parts, wires)
    assert stepping_order(system, ["c", "a", "b"]) == ("a", "b", "c")
    assert stepping_order(oscillators(), ["left", "right"]) == ("left", "right")


def test_a_chain_has_no_error_of_order() -> None:
    """With lines, the last of a chain sees what the one before did; held inputs are those at the step's end."""
    system = System((lag("b"), lag("a")), (Connection("a.y", "b.u"),))
    experiment = Experiment(np.linspace(0, 0.2, 3), ("a.y", "b.y"), {"a.u": Signal.constant(1.0)})
    record = cosimulate(system, experiment, step=0.1, order=GaussSeidel())
    a = 1 - np.exp(-0.1 * np.arange(3))
    b_1 = (1 - np.exp(-0.1)) * a[1]
    assert record["a.y"] == pytest.approx(a)
    assert record["b.y"] == pytest.approx([0, b_1, np.exp(-0.1) * b_1 + (1 - np.exp(-0.1)) * a[2]])


def test_an_order_names_each_member() -> None:
    with pytest.raises(BadInput, match="the order is left, left; name each of these once: left, right"):
        cosimulate(
            oscillators(), Experiment(np.ones(1), ("left.x",)), step=0.1, order=GaussSeidel(order=("left", "left"))
        )
