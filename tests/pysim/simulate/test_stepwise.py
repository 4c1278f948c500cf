from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm

from pysim.simulate import Rk45, Rodas, StepFailed, Stepwise, Wires, can_be_saved, is_smooth, open_stepwise, simulate
from pysim.types import Experiment, Model, Outcome
from tests.pysim.simulate.fixture_fmus import BALL, CLOCK, FRAGILE, OSCILLATOR
from tests.pysim.simulate.text_models import RELAY, text_model

FixtureModel = Callable[..., Model]
W, D, H = 2.0, 0.1, 0.05
EXACT = Rk45(rtol=1e-11, atol=1e-11)


def wires(inputs: tuple[str, ...], outputs: tuple[str, ...]) -> Wires:
    return Wires(inputs, outputs, np.zeros(len(inputs)), np.zeros(len(inputs)), np.zeros(len(outputs)))


def oscillated(u: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """States (n_t, 2) of the oscillator at the ends of steps; in each its input is u + rate * (time in the step)."""
    a = np.zeros((4, 4))
    a[:2] = [[0, 1, 0, 0], [-W * W, -2 * D * W, 1, 0]]
    a[2, 3] = 1
    over, x, states = expm(a * H), np.zeros(2), []
    for value, slope in zip(u, rate, strict=True):
        x = (over @ [*x, value, slope])[:2]
        states.append(x)
    return np.array(states)


def run_steps(stepper: Stepwise, io: Wires, u: np.ndarray, rate: np.ndarray, first: int = 0) -> np.ndarray:
    rows = []
    for k in range(first, len(u)):
        io.values[0], io.rates[0] = u[k], rate[k]
        stepper.step((k + 1) * H)
        rows.append(io.results.copy())
    return np.array(rows)


def begun(stepper: Stepwise, **overrides: float) -> Stepwise:
    stepper.start(0.0, 10.0, overrides)
    stepper.begin()
    return stepper


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("solver", [EXACT, Rodas(rtol=1e-10, atol=1e-10)])
def test_inputs_held_or_straight_within_a_step_give_the_exact_states(
    fixture_model: FixtureModel, fmi: int, solver: Rk45 | Rodas
) -> None:
    rng = np.random.default_rng(1)
    u, rate = rng.normal(size=40), np.where(np.arange(40) % 3 == 0, 0.0, rng.normal(size=40))
    u[20:25] = u[20]
    io = wires(("u",), ("x", "v", "power"))
    with open_stepwise(fixture_model(OSCILLATOR, fmi), io, solver=solver) as stepper:
        rows = run_steps(begun(stepper), io, u, rate)
        assert stepper.time == 40 * H
    expected = oscillated(u, rate)
    np.testing.assert_allclose(rows[:, :2], expected, atol=1e-8)
    np.testing.assert_allclose(rows[:, 2], (u + rate * H) * expected[:, 1], atol=1e-8)  # power at the end of each step


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("solver", [Rk45(), Rodas()])
def test_states_alone_are_saved_and_gone_back_to_bit_for_bit(
    fixture_model: FixtureModel, fmi: int, solver: Rk45 | Rodas
) -> None:
    model, io = fixture_model(OSCILLATOR, fmi), wires(("u",), ("x", "v"))
    assert not model.abilities.state_handling
    assert can_be_saved(model)
    u = np.sin(np.arange(30.0))
    with open_stepwise(model, io, solver=solver) as stepper:
        begun(stepper)
        run_steps(stepper, io, u[:10], 0 * u)
        kept = stepper.save()
        first = run_steps(stepper, io, u, 0 * u, first=10)
        stepper.restore(kept)
        again = run_steps(stepper, io, u[:20], 0 * u, first=10)
        kept = stepper.save(into=kept)
        run_steps(stepper, io, u, 0 * u, first=20)
        stepper.restore(kept)
        again = np.vstack([again, run_steps(stepper, io, u, 0 * u, first=20)])
    np.testing.assert_array_equal(first, again)


@pytest.mark.parametrize("fmi", [2, 3])
def test_saved_states_of_a_model_with_events(tmp_path: Path, fmi: int) -> None:
    model, io = text_model(RELAY, tmp_path, fmi=fmi), wires(("u",), ("x",))
    assert model.abilities.state_handling
    u = np.cos(np.arange(30.0))
    with open_stepwise(model, io, solver=Rodas()) as stepper:
        begun(stepper)
        run_steps(stepper, io, u[:10], 0 * u)
        kept = [stepper.save() for _ in range(3)]
        first = run_steps(stepper, io, u, 0 * u, first=10)
        for state in (kept[2], kept[0]):
            stepper.restore(state)
            np.testing.assert_array_equal(run_steps(stepper, io, u, 0 * u, first=10), first)
    x, expected = 0.0, []
    for value in u:
        target = 1.0 if value > 0 else -1.0
        x = target + (x - target) * np.exp(-H / 0.5)
        expected.append([x])
    np.testing.assert_allclose(first, expected[10:], atol=1e-5)


@pytest.mark.parametrize("fmi", [2, 3])
def test_events_within_steps_are_the_models_own(fixture_model: FixtureModel, fmi: int) -> None:
    model, io = fixture_model(BALL, fmi), wires((), ("h", "v", "bounces"))
    times = np.arange(1, 30) * H
    record = simulate(model, Experiment(times, ("h", "v", "bounces")), solver=EXACT)
    rows = []
    with open_stepwise(model, io, solver=EXACT) as stepper:
        begun(stepper)
        for time in times:
            stepper.step(time)
            rows.append(io.results.copy())
    np.testing.assert_allclose(rows, record.values, atol=1e-8)
    assert record["bounces"][-1] >= 2


def test_an_event_at_a_steps_end_is_left_to_what_follows(fixture_model: FixtureModel) -> None:
    """The clock's level rises by one every 0.3 s; three steps of 0.1 s end one rounding step behind that."""
    io = wires((), ("level",))
    levels = []
    with open_stepwise(fixture_model(CLOCK), io, solver=EXACT) as stepper:
        begun(stepper)
        for tick in range(1, 8):
            stepper.step(tick * 0.1)
            levels.append((float(io.results[0]), stepper.event))
            if tick == 3:
                stepper.update()
                levels.append((float(io.results[0]), stepper.event))
    off = [(0.0, False)] * 2
    assert levels == [*off, (0.0, True), *[(1.0, False)] * 3, (1.0, True), (2.0, False)]


def test_a_model_with_events_and_no_saved_states_says_so(fixture_model: FixtureModel) -> None:
    assert not can_be_saved(fixture_model(BALL))
    model, io = fixture_model(CLOCK), wires((), ("level",))
    with open_stepwise(model, io, solver=EXACT) as stepper:
        begun(stepper)
        with pytest.raises(StepFailed, match="offers no saved states"):
            stepper.save()


def test_outputs_follow_inputs_at_once_while_time_stands(fixture_model: FixtureModel) -> None:
    io = wires(("u",), ("power", "v"))
    with open_stepwise(fixture_model(OSCILLATOR), io, solver=EXACT) as stepper:
        stepper.start(0.0, 1.0, {"v": 3.0})
        io.values[0] = 2.0
        stepper.update()
        assert io.results[0] == 6.0
        stepper.begin()
        io.values[0] = 5.0
        stepper.update()
        assert io.results.tolist() == [15.0, 3.0]
        stepper.step(H)
    x, v = expm(np.array([[0, 1, 0], [-W * W, -2 * D * W, 5.0], [0, 0, 0]]) * H) @ [0, 3.0, 1.0] @ np.eye(3)[:, :2]
    assert io.results[1] == pytest.approx(v, abs=1e-9)
    assert x > 0


def test_a_step_that_fails_says_where_and_what_the_model_said(fixture_model: FixtureModel) -> None:
    io = wires((), ("root",))
    with open_stepwise(fixture_model(FRAGILE), io, solver=Rk45()) as stepper:
        begun(stepper, manner=2.0)
        stepper.step(1.9)
        with pytest.raises(StepFailed, match=r"at 1\.9.* s .*root of a negative") as caught:
            stepper.step(2.1)
    assert caught.value.outcome is Outcome.MODEL_ERROR
    with open_stepwise(fixture_model(FRAGILE), io, solver=Rk45()) as stepper, pytest.raises(StepFailed, match="refuse"):
        begun(stepper, refuse=1.0)


def test_a_model_that_ends_the_run(fixture_model: FixtureModel) -> None:
    io = wires((), ("level",))
    with open_stepwise(fixture_model(CLOCK), io, solver=EXACT) as stepper:
        begun(stepper, last=2.0)
        stepper.step(0.5)
        with pytest.raises(StepFailed) as caught:
            stepper.step(1.0)
    assert caught.value.outcome is Outcome.TERMINATED


def test_which_inputs_may_run_on_within_a_step(fixture_model: FixtureModel) -> None:
    assert is_smooth(fixture_model(OSCILLATOR), "u")
    assert not is_smooth(fixture_model(OSCILLATOR), "w")
