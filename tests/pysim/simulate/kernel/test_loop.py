"""Events, breaks, targets and endings, on models whose answers are closed forms."""

import dataclasses
import math

import numpy as np
import pytest

from pysim.simulate import Esdirk, Rk4, Rk45, Rodas, simulate
from pysim.types import Experiment, Outcome, Signal, SimulationError
from tests.pysim.simulate.fixture_fmus import BALL, CARELESS, CLOCK, FOLLOWER, FRAGILE, OSCILLATOR, STIFF


def ramps(times, rates, first=0.0) -> Signal:
    """Straight lines that join."""
    cubics = np.zeros((len(times), 4))
    cubics[:, 0] = first + np.concatenate([[0], np.cumsum(np.diff(times) * np.array(rates)[:-1])])
    cubics[:, 1] = rates
    return Signal(np.array(times, float), cubics, np.zeros((len(times), 0, 4)))


def test_event_time_is_found_to_rounding(fixture_model):
    # Just before and just after the first bounce at sqrt(2 / g), the speed has either sign.
    bounce = math.sqrt(2 / 9.81)
    record = simulate(fixture_model(BALL), Experiment(bounce + np.array([-2e-15, 2e-15]), ("v", "bounces")))
    np.testing.assert_array_equal(record["bounces"], [0, 1])
    np.testing.assert_allclose(record["v"], [-9.81 * bounce, 0.8 * 9.81 * bounce], rtol=1e-12)


def test_row_at_an_event_holds_the_values_after_it(fixture_model):
    times = np.array([0.0, 0.3, 0.6])
    record = simulate(fixture_model(CLOCK), Experiment(times, ("level",)), solver=Rk45())
    np.testing.assert_array_equal(record["level"], [0, 1, 2])


@pytest.mark.parametrize("solver", [Rk45(), Rk4(0.07), Rodas()], ids=lambda s: type(s).__name__)
@pytest.mark.parametrize("fmi", [2, 3])
def test_time_events_are_hit_exactly(fixture_model, solver, fmi):
    # x' = number of whole periods so far: at the end of period n, x = period * n (n - 1) / 2 without any error of time.
    period, n = 0.3, 40
    record = simulate(fixture_model(CLOCK, fmi), Experiment(np.array([n * period]), ("x", "level")), solver=solver)
    assert record["x"][0] == pytest.approx(period * n * (n - 1) / 2, rel=1e-13)
    assert record["level"][0] == n
    assert record.statistics["events"] == n


def test_model_may_end_the_run(fixture_model):
    experiment = Experiment(np.linspace(0, 3, 31), ("level",), overrides={"last": 4})
    record = simulate(fixture_model(CLOCK), experiment, check=False)
    assert record.outcome is Outcome.TERMINATED
    assert record.time[-1] == pytest.approx(1.1)  # the fourth event comes at 1.2 s
    np.testing.assert_array_equal(record["level"], np.floor(record.time / 0.3 + 1e-9))


def test_input_jump_is_an_event_and_enters_sharply(fixture_model):
    staircase = Signal.steps([0.0, 0.37, 1.1], [1.0, -2.0, 5.0])
    record = simulate(
        fixture_model(FOLLOWER), Experiment(np.array([0.37, 1.1, 2.0]), ("x", "events", "u_seen"), {"u": staircase})
    )
    np.testing.assert_allclose(record["x"], [0.37, 0.37 - 2 * 0.73, 0.37 - 1.46 + 4.5], rtol=1e-14)
    np.testing.assert_array_equal(record["events"], [1, 2, 2])
    np.testing.assert_array_equal(record["u_seen"], [-2, 5, 5])


def test_kink_restarts_the_step_without_an_event(fixture_model):
    zigzag = ramps([0.0, 0.5, 0.8], [1.0, -3.0, 2.0])
    record = simulate(fixture_model(FOLLOWER), Experiment(np.array([0.5, 0.8, 1.0]), ("x", "events"), {"u": zigzag}))
    exact = [0.125, 0.125 + 0.15 - 0.135, 0.14 + (-0.4) * 0.2 + 0.04]
    np.testing.assert_allclose(record["x"], exact, rtol=1e-12)  # piecewise parabolas: without error between kinks
    np.testing.assert_array_equal(record["events"], 0)
    assert record.statistics["steps"] < 20


def test_rate_input_carries_the_exact_derivative(fixture_model):
    wave = Signal(np.zeros(1), np.array([[1.0, 2, 3, 4]]), np.array([[[0.5, 0.3, 4.0, 1.0]]]))
    times = np.linspace(0, 2, 21)
    experiment = Experiment(times, ("u", "u_rate", "y_rate"), {"u": wave}, rates={"u_rate": "u"})
    record = simulate(fixture_model(OSCILLATOR), experiment)
    np.testing.assert_allclose(record["u"], wave.value(times), rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(record["u_rate"], wave.derivative(times), rtol=1e-13, atol=1e-13)
    np.testing.assert_array_equal(record["y_rate"], record["u_rate"])


def test_fixed_steps_lie_on_a_grid_that_does_not_drift(fixture_model):
    record = simulate(fixture_model(OSCILLATOR), Experiment(np.array([1000.0]), ("x",)), solver=Rk4(0.1))
    assert record.statistics["steps"] == 10_000
    assert record.statistics["derivatives"] == 4 * 10_000 + 1


def test_run_may_start_anywhere(fixture_model):
    signal = Signal.steps([0.0, 6.0], [1.0, 3.0])
    experiment = Experiment(np.array([5.0, 5.5, 7.0]), ("time", "x"), {"u": signal}, start=5.0)
    record = simulate(fixture_model(FOLLOWER), experiment)
    np.testing.assert_allclose(record["x"], [0.0, 0.5, 4.0], rtol=1e-14)
    np.testing.assert_array_equal(record["time"], experiment.times)


def test_stiff_method_needs_few_steps_where_the_explicit_one_is_held_back(fixture_model):
    model, experiment = fixture_model(STIFF), Experiment(np.linspace(0, 5, 51), ("miss", "y"))
    record = simulate(model, experiment, solver=Rodas(1e-8, 1e-8))
    assert abs(record["miss"][-1]) < 1e-9
    assert np.max(np.abs(record["miss"])) < 1e-6  # between steps of 0.2 s a polynomial of degree 4 stands for the sine
    np.testing.assert_allclose(record["y"], 1 / (1 + record.time), rtol=1e-6)
    assert record.statistics["steps"] < 500
    explicit = simulate(model, experiment, solver=Rk45(1e-4, 1e-4))
    assert explicit.statistics["steps"] > 1e5  # 1e5 / s times 5 s over a stability limit of about 3.5


def test_finite_differences_stand_in_for_a_missing_jacobian(fixture_model):
    exact = fixture_model(STIFF)
    differences = dataclasses.replace(
        exact, abilities=dataclasses.replace(exact.abilities, directional_derivatives=False)
    )
    experiment = Experiment(np.array([1.0, 5.0]), ("y",))
    records = [simulate(m, experiment, solver=Rodas(1e-7, 1e-7)) for m in (exact, differences)]
    np.testing.assert_allclose(records[1]["y"], records[0]["y"], rtol=1e-7)
    assert records[1].statistics["derivatives"] > records[0].statistics["derivatives"]


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize(
    ("manner", "outcome", "words"),
    [
        (0, Outcome.STEP_TOO_SMALL, "discards.*root of a negative number"),
        (1, Outcome.NOT_FINITE, "no longer finite"),
        (2, Outcome.MODEL_ERROR, "root of a negative number"),
    ],
)
def test_failed_run_is_data(fixture_model, fmi, manner, outcome, words):
    model = fixture_model(FRAGILE, fmi)
    experiment = Experiment(np.linspace(0, 4, 41), ("x", "root"), overrides={"manner": manner})
    record = simulate(model, experiment, check=False)
    assert record.outcome is outcome
    assert 1.7 < record.time[-1] < 2.0
    assert record["x"][10] == pytest.approx(0.25, abs=2e-3)  # (1 - t/2)^2, but for the small term
    with pytest.raises(SimulationError, match=words) as caught:
        simulate(model, experiment)
    np.testing.assert_array_equal(caught.value.record.values, record.values)


@pytest.mark.parametrize("fmi", [2, 3])
def test_refused_start_is_data_too(fixture_model, fmi):
    experiment = Experiment(np.array([1.0]), ("x",), overrides={"refuse": 1})
    record = simulate(fixture_model(FRAGILE, fmi), experiment, check=False)
    assert record.outcome is Outcome.MODEL_ERROR
    assert "refuse must not be 1" in record.message
    assert record.values.shape == (0, 1)


def test_limit_of_steps(fixture_model):
    record = simulate(
        fixture_model(STIFF), Experiment(np.array([5.0]), ("x",)), solver=Rk45(max_steps=100), check=False
    )
    assert record.outcome is Outcome.TOO_MANY_STEPS
    assert record.statistics["steps"] == 100


def test_a_run_that_gets_no_further_is_given_up_long_before_its_limit(fixture_model):
    """An explicit method takes steps of about 1/rate: the run would need some 1e15 of them."""
    experiment = Experiment(np.array([1.0]), ("x",), overrides={"rate": 1e15})
    record = simulate(fixture_model(STIFF), experiment, solver=Rk45(max_steps=100_000_000), check=False)
    assert record.outcome is Outcome.TOO_MANY_STEPS
    assert record.statistics["steps"] == 1_000_000


def test_a_slow_run_within_its_limit_is_not_given_up(fixture_model):
    experiment = Experiment(np.array([1.0]), ("x",), overrides={"rate": 5e6})
    record = simulate(fixture_model(STIFF), experiment, solver=Rk45(max_steps=100_000_000))
    assert record.statistics["steps"] > 1_000_000


def test_events_without_end_stop_the_run(fixture_model):
    experiment = Experiment(np.array([0.0, 1.0]), ("level",), overrides={"period": 1e-17})
    record = simulate(fixture_model(CLOCK), experiment, check=False)
    assert record.outcome is Outcome.TOO_MANY_EVENTS
    assert record.statistics["events"] < 2000
    np.testing.assert_array_equal(record.time, [0.0])


def test_largest_step_is_obeyed(fixture_model):
    record = simulate(fixture_model(FOLLOWER), Experiment(np.array([1.0]), ("x",)), solver=Rk45(max_step=0.01))
    assert record.statistics["steps"] >= 100


@pytest.mark.parametrize("solver", [Rk45(), Rodas(), Esdirk()], ids=lambda s: type(s).__name__)
def test_size_of_zero_and_event_that_is_due_at_once_are_survived(fixture_model, solver):
    times = np.linspace(0, 3, 7)
    record = simulate(fixture_model(CARELESS), Experiment(times, ("x", "level")), solver=solver)
    np.testing.assert_allclose(record["x"], 1 - np.exp(-times), atol=1e-4)
    np.testing.assert_array_equal(record["level"], 1.0)
