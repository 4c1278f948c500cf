"""The battery every solver passes: order as claimed, off-step values, events, tolerance, settings."""

import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest

from pysim.simulate import Solver, simulate
from pysim.simulate.kernel.method import ExplicitMethod
from pysim.types import BadInput, Experiment, Model, Signal
from tests.pysim.simulate.fixture_fmus import BALL, OSCILLATOR, STIFF, Fixture
from tests.pysim.simulate.solver_cases import SOLVERS, SolverCase
from tests.pysim.simulate.text_models import LAG, PEAKS, text_model

_W, _D, _OMEGA = 2.0, 0.1, 3.0
LargestError = Callable[[Model, np.ndarray, Solver], tuple[float, int]]  # and the steps it took


@pytest.fixture(params=SOLVERS.values(), ids=SOLVERS.keys())
def case(request: pytest.FixtureRequest) -> SolverCase:
    return request.param


def forced_oscillation(t: np.ndarray) -> np.ndarray:
    """x'' + 2 D w x' + w^2 x = sin(omega t) from x(0) = 1, x'(0) = 0."""
    gain = 1 / (_W**2 - _OMEGA**2 + 2j * _D * _W * _OMEGA)
    damping, ringing = _D * _W, _W * math.sqrt(1 - _D**2)
    a = 1 - gain.imag
    b = (damping * a - _OMEGA * gain.real) / ringing
    free = np.exp(-damping * t) * (a * np.cos(ringing * t) + b * np.sin(ringing * t))
    return np.imag(gain * np.exp(1j * _OMEGA * t)) + free


def sine(omega: float) -> Signal:
    return Signal(np.zeros(1), np.zeros((1, 4)), np.array([[[1.0, 0.0, omega, 0.0]]]))


def forced(times: np.ndarray) -> Experiment:
    return Experiment(times, ("x", "v"), {"u": sine(_OMEGA)}, {"x": 1.0})


def largest_error(model: Model, times: np.ndarray, solver: Solver) -> tuple[float, int]:
    record = simulate(model, forced(times), solver=solver)
    return float(np.max(np.abs(record["x"] - forced_oscillation(times)))), record.statistics["steps"]


def riccati_error(model: Model, times: np.ndarray, solver: Solver) -> tuple[float, int]:
    """y' = -y^2 from 1, beside x' = cos t - (x - sin t) from 0."""
    record = simulate(model, Experiment(times, ("x", "y"), overrides={"rate": 1.0}), solver=solver)
    return float(np.max(np.abs(record["y"] - 1 / (1 + times)))), record.statistics["steps"]


@pytest.mark.parametrize(
    ("fixture", "error", "end"),
    [(OSCILLATOR, largest_error, 20.0), (STIFF, riccati_error, 8.0)],
    ids=["forced and linear", "nonlinear"],
)
def test_error_falls_with_the_claimed_order(
    case: SolverCase, fixture_model: Callable[..., Model], fixture: Fixture, error: LargestError, end: float
) -> None:
    model, times = fixture_model(fixture), np.array([end])
    coarse_error, coarse_steps = error(model, times, case.make(case.coarse))
    finer = case.coarse / (4 if case.fixed else 1e3)
    fine_error, fine_steps = error(model, times, case.make(finer))
    measured = math.log(coarse_error / fine_error) / math.log(fine_steps / coarse_steps)
    assert measured == pytest.approx(case.order, abs=0.6)  # a single end point, and steps that differ in length


def test_values_between_steps_are_as_good_as_the_order_of_the_interpolant(case, fixture_model):
    model = fixture_model(OSCILLATOR)
    times = np.linspace(0, 20, 4001)[1:] - 0.0017
    coarse, coarse_steps = largest_error(model, times, case.make(case.coarse))
    fine, fine_steps = largest_error(model, times, case.make(case.coarse / (4 if case.fixed else 1e3)))
    assert math.log(coarse / fine) / math.log(fine_steps / coarse_steps) > 3.6
    assert coarse < 2e-5


def test_fmi_2_and_fmi_3_give_the_same_bits(case, fixture_model):
    times = np.linspace(0, 5, 101)
    records = [simulate(fixture_model(OSCILLATOR, fmi), forced(times), solver=case.make(case.coarse)) for fmi in (2, 3)]
    np.testing.assert_array_equal(records[0].values, records[1].values)
    assert records[0].statistics == records[1].statistics


@pytest.mark.parametrize("fmi", [2, 3])
def test_ball_bounces_when_and_as_high_as_it_should(case, fixture_model, fmi):
    first, e, g = math.sqrt(2 / 9.81), 0.8, 9.81
    bounces = first + np.concatenate([[0], np.cumsum(2 * first * e ** np.arange(1, 8))])
    tops = (bounces[:-1] + bounces[1:]) / 2
    record = simulate(fixture_model(BALL, fmi), Experiment(tops, ("h", "bounces")), solver=case.make(case.coarse))
    np.testing.assert_allclose(record["h"], e ** (2 * np.arange(1, 8)), rtol=2e-9)  # parabolas: no method errs
    np.testing.assert_array_equal(record["bounces"], np.arange(1, 8))
    assert record.statistics["events"] >= 7
    assert g == pytest.approx(2 / first**2)


def test_dense_output_joins_both_ends_of_the_step(case):
    method = case.make(case.coarse).method()
    ends = method.dense.sum(axis=1)
    np.testing.assert_allclose(ends[:-1], method.b, atol=2e-13)
    assert ends[-1] == pytest.approx(0.0, abs=2e-13)
    if isinstance(method, ExplicitMethod):
        np.testing.assert_allclose(method.dense[:, 0], np.eye(len(method.dense))[0], atol=1e-14)
        np.testing.assert_allclose(method.c, method.a.sum(axis=1), atol=1e-14)


def test_settings_are_checked_and_frozen(case):
    with pytest.raises(BadInput, match="must be"):
        case.make(0.0)
    with pytest.raises(BadInput, match="must be"):
        case.make(math.nan)
    with pytest.raises(dataclasses.FrozenInstanceError):
        case.make(case.coarse).max_steps = 3  # type: ignore[misc]


def test_steps_below_its_duration_see_a_condition_that_comes_and_goes(case, tmp_path_factory):
    model = text_model(PEAKS, tmp_path_factory.getbasetemp())
    shorter = 0.06  # s, than 2 acos(0.9995)
    solver = case.make(shorter if case.fixed else 1e-4)
    if not case.fixed:
        solver = dataclasses.replace(solver, max_step=shorter)
    record = simulate(model, Experiment(np.array([0.0, 40 * math.pi]), ("n",)), solver=solver)
    assert record["n"][-1] == 20


def test_the_last_row_is_that_after_a_jump_there_whether_the_run_goes_on_or_not(case: SolverCase, tmp_path) -> None:
    model, push = text_model(LAG, tmp_path), Signal.steps([0.0, 0.2], [1.0, 5.0])
    short, long = (
        simulate(model, Experiment(np.array(times), ("y", "power"), {"u": push}), solver=case.make(case.coarse))
        for times in ([0.0, 0.1, 0.2], [0.0, 0.1, 0.2, 0.3])
    )
    np.testing.assert_array_equal(short.values, long.values[:3])
    assert short["power"][-1] == pytest.approx(2 * 5 * short["y"][-1])  # K u y
    alone = simulate(model, Experiment(np.array([0.2]), ("y", "power"), {"u": push}), solver=case.make(case.coarse))
    assert alone["power"][-1] == pytest.approx(2 * 5 * alone["y"][-1])


def test_a_kink_at_the_end_is_no_break(fixture_model) -> None:
    ramp = Signal.lines([0.0, 1.0, 2.0], [0.0, 1.0, 0.0])
    records = [
        simulate(fixture_model(OSCILLATOR), Experiment(np.array([0.5, 1.0]), ("x",), {"u": u}))
        for u in (ramp, Signal.lines([0.0, 1.0], [0.0, 1.0]))
    ]
    assert records[0].statistics == records[1].statistics
