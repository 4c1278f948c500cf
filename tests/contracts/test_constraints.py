"""A constraint whose states say nothing of the others somewhere ends the run there; elsewhere nothing is noticed."""

import math

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from pysim.io import read_model
from pysim.simulate import simulate
from pysim.types import Experiment, Outcome
from tests.cases import Case
from tests.contracts.building import Built

PENDULUM = """model {name}
  parameter Real L = 1;
  Real x(start={x}*L, fixed={x_fixed}), y(start={y}*L, fixed={y_fixed}), u(start=0, fixed={x_fixed}), v, l;
  {initial}
equation
  der(x) = u;
  der(y) = v;
  der(u) = l*x;
  der(v) = l*y - 9.81;
  x^2 + y^2 = L^2;
end {name};
"""
# Its height is a state, which does not tell the side it is on at its lowest point.
FALLING = Case(
    name="falling",
    class_name="Falling",
    text=PENDULUM.format(
        name="Falling", x=0.6, y=0.8, x_fixed="false", y_fixed="true", initial="initial equation u = 0;"
    ),
)
SWINGING = Case(
    name="swinging",
    class_name="Swinging",
    text=PENDULUM.format(name="Swinging", x=0.1, y=-0.995, x_fixed="true", y_fixed="false", initial=""),
)


def test_co_simulation_ends_where_the_states_are_lost(built: Built) -> None:
    with built(FALLING, 3).open("cs") as instance:
        instance.start()
        instance.step(0.0, 0.8)
        assert np.hypot(*instance.get(["x", "y"])) == pytest.approx(1)
        with pytest.raises(FMICallException):
            instance.step(0.8, 0.4)
        assert "At time 0.82" in instance.messages[-1]
        assert "the states no longer determine x" in instance.messages[-1]


def test_a_native_run_ends_there_too(built: Built, fmi: int) -> None:
    record = simulate(read_model(built(FALLING, fmi).path), Experiment(np.linspace(0, 1.2, 13), ("x",)), check=False)
    assert record.outcome is Outcome.MODEL_ERROR
    assert "the states no longer determine x" in record.message


@pytest.mark.parametrize("length", [1e-6, 1.0, 1e6])
def test_a_pendulum_of_any_size_swings_on(built: Built, fmi: int, length: float) -> None:
    period = 2 * math.pi * math.sqrt(length / 9.81)
    with built(SWINGING, fmi).open("cs") as instance:
        instance.start({"L": length}, tolerance=1e-9)
        for number in range(4):
            instance.step(number * period, period)
        x, y, u, v = instance.get(["x", "y", "u", "v"])
        height = (u**2 + v**2) / (2 * 9.81) + y
        assert height == pytest.approx(-math.sqrt(0.99) * length, rel=1e-5)
        assert abs(x) <= 0.1001 * length
