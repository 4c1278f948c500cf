"""`assert` is looked at between events too: in co-simulation by the FMU, in model exchange when told of a step."""

import itertools
import re
from collections.abc import Callable

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from pysim.io import read_model
from pysim.simulate import simulate
from pysim.types import Experiment, Outcome
from tests.cases import Case
from tests.contracts.building import Built
from tests.contracts.fmu import Fmu, Instance

LIMITED = Case(
    name="limited",
    class_name="Limited",
    text="""model Limited
  output Real x(start=0, fixed=true);
equation
  der(x) = 1;
  assert(x < 0.7, "x is too large");
end Limited;
""",
)
WARNED = Case(
    name="warned",
    class_name="Warned",
    text="""model Warned
  output Real x(start=0, fixed=true);
  output Integer ticks(start=0, fixed=true);
equation
  der(x) = if time < 0.3 or time > 0.6 and time < 0.9 then 1 else -1;
  when sample(0, 0.02) then
    ticks = pre(ticks) + 1;
  end when;
  assert(x < 0.1, "x is large", AssertionLevel.warning);
end Warned;
""",
)
ERROR = 3


def warnings(instance: Instance) -> list[float]:
    """The times at which it was logged that x is large."""
    texts = [message for message in instance.messages if "x is large" in message]
    return [float(re.findall(r"at time (\S+) s", text)[0]) for text in texts]


@pytest.fixture
def limited(built: Built, fmi: int) -> Fmu:
    return built(LIMITED, fmi)


def stopped_at(instance: Instance, advance: Callable[[float, float], None]) -> float:
    """End of the last step of 0.05 s that was accepted."""
    status = None
    for number in itertools.count():
        try:
            advance(number * 0.05, 0.05)
        except FMICallException as failure:
            status = failure.status
            break
    assert status == ERROR
    assert instance.messages
    return number * 0.05


def test_the_description_asks_for_steps(limited: Fmu) -> None:
    assert limited.description.modelExchange.needsCompletedIntegratorStep


def test_co_simulation_stops(limited: Fmu) -> None:
    with limited.open("cs") as instance:
        instance.start()
        assert stopped_at(instance, instance.step) == pytest.approx(0.65, abs=0.051)


def test_model_exchange_stops_at_the_first_step_beyond(limited: Fmu) -> None:
    with limited.open("me") as instance:
        instance.start()

        def advance(time: float, size: float) -> None:
            instance.raw.setTime(time + size)
            instance.x = [time + size + 1e-9]
            instance.raw.completedIntegratorStep()

        assert stopped_at(instance, advance) == pytest.approx(0.65)


def test_the_native_loop_stops_too(limited: Fmu) -> None:
    model = read_model(limited.path)
    assert model.abilities.needs_completed_step
    record = simulate(model, Experiment(np.linspace(0, 1, 21), ("x",)), check=False)
    assert record.outcome is Outcome.MODEL_ERROR
    assert "x is too large" in record.message


def test_a_warning_is_logged_once_per_violation(built: Built) -> None:
    """x is large from 0.1 s to 0.5 s and from 0.7 s on, with a tick in each 20 ms: two messages in 1 s."""
    with built(WARNED, 3).open("cs") as instance:
        instance.start()
        for number in range(10):
            instance.step(number * 0.1, 0.1)
        assert instance.get(["ticks"]) == [51]
        first, second = warnings(instance)
    assert first == pytest.approx(0.1, abs=0.021)
    assert second == pytest.approx(0.7, abs=0.021)
