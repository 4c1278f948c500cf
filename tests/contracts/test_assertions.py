"""`assert` is looked at between events too: in co-simulation by the FMU, in model exchange when told of a step."""

import itertools

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from pysim.io import read_model
from pysim.simulate import simulate
from pysim.types import Experiment, Outcome
from tests.cases import Case

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
ERROR = 3


@pytest.fixture
def limited(built, fmi):
    return built(LIMITED, fmi)


def stopped_at(instance, advance):
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


def test_the_description_asks_for_steps(limited):
    assert limited.description.modelExchange.needsCompletedIntegratorStep


def test_co_simulation_stops(limited):
    with limited.open("cs") as instance:
        instance.start()
        assert stopped_at(instance, instance.step) == pytest.approx(0.65, abs=0.051)


def test_model_exchange_stops_at_the_first_step_beyond(limited):
    with limited.open("me") as instance:
        instance.start()

        def advance(time, size):
            instance.raw.setTime(time + size)
            instance.x = [time + size + 1e-9]
            instance.raw.completedIntegratorStep()

        assert stopped_at(instance, advance) == pytest.approx(0.65)


def test_the_native_loop_stops_too(limited):
    model = read_model(limited.path)
    assert model.abilities.needs_completed_step
    record = simulate(model, Experiment(np.linspace(0, 1, 21), ("x",)), check=False)
    assert record.outcome is Outcome.MODEL_ERROR
    assert "x is too large" in record.message
