"""Events are located where their indicators cross, each of them, and once."""

from collections.abc import Callable

import numpy as np
import pytest

from pysim.simulate import Esdirk, Rk4, Rk45, Rodas, Solver, simulate
from pysim.types import Experiment, Model
from tests.pysim.simulate.fixture_fmus import GATES

ROUNDING = 2e-15  # s: some forty steps of the last digit at 0.3 s


@pytest.mark.parametrize("steepness", [1e-3, 40.0, 600.0])
@pytest.mark.parametrize("solver", [Rk4(0.9), Rk45(), Esdirk(), Rodas()], ids=lambda s: type(s).__name__)
def test_two_crossings_within_one_step_are_two_events_at_their_own_times(
    fixture_model: Callable[..., Model], solver: Solver, steepness: float
) -> None:
    experiment = Experiment(np.array([0.9]), ("at_a", "at_b", "events"), overrides={"s": steepness})
    record = simulate(fixture_model(GATES), experiment, solver=solver)
    assert 0.0 < record["at_a"][0] - 0.3 < ROUNDING  # just behind the gate, where the model sees the crossing
    assert 0.0 < record["at_b"][0] - 0.31 < ROUNDING
    assert record["events"][0] == 2
