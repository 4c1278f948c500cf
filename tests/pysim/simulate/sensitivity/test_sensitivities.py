"""Sensitivities against closed forms, against differences of tight runs, and what falls back to differences."""

import dataclasses
import math

import numpy as np
import pytest

from pysim.simulate import Esdirk, Rodas, sensitivities, sensitivities_many, simulate
from pysim.thesis import pump_model
from pysim.types import BadInput, Experiment, Outcome, Signal, SimulationError
from tests.pysim.simulate.fixture_fmus import BALL, FRAGILE, OSCILLATOR
from tests.pysim.simulate.text_models import DISCARDS, LAG, ROOT, text_model

_TIGHT = Esdirk(1e-8, 1e-8)
_OMEGA = 3.0
_PLAIN = dataclasses.replace(OSCILLATOR, tangents=False)
PUMP = ("omega_v", "zeta_v", "L", "A_p", "V_0", "m_eff", "k", "b", "K_p", "K_D", "T_d", "K_L", "tau")


def sine(omega: float, amplitude: float = 1.0, offset: float = 0.0) -> Signal:
    return Signal(np.zeros(1), np.array([[offset, 0, 0, 0]]), np.array([[[amplitude, 0, omega, 0]]]))


def oscillation(t: np.ndarray, w: float, damping: float, start: float) -> np.ndarray:
    """x'' + 2 D w x' + w^2 x = sin(omega t) from x(0) = start, x'(0) = 0."""
    gain = 1 / (w**2 - _OMEGA**2 + 2j * damping * w * _OMEGA)
    decay, ringing = damping * w, w * math.sqrt(1 - damping**2)
    a = start - gain.imag
    b = (decay * a - _OMEGA * gain.real) / ringing
    return np.imag(gain * np.exp(1j * _OMEGA * t)) + np.exp(-decay * t) * (
        a * np.cos(ringing * t) + b * np.sin(ringing * t)
    )


def oscillation_by(t: np.ndarray) -> np.ndarray:
    """(n_t, 3) derivative of the closed form at (2, 0.1, 1), by differences good to ten digits."""
    point, columns = np.array([2.0, 0.1, 1.0]), []
    for unit in np.eye(3):
        sides = [oscillation(t, *(point + sign * 1e-5 * unit)) for sign in (1, -1)]
        columns.append((sides[0] - sides[1]) / 2e-5)
    return np.stack(columns, axis=1)


def forced(times: np.ndarray, **more: float) -> Experiment:
    return Experiment(times, ("x", "v"), {"u": sine(_OMEGA)}, {"x": 1.0, **more})


@pytest.mark.parametrize("fmi", [2, 3])
def test_oscillator_by_its_parameters_and_its_start(fixture_model, fmi):
    times = np.linspace(0, 10, 101) + 0.0031
    found = sensitivities(fixture_model(OSCILLATOR, fmi), forced(times), ("w", "D", "x"), solver=_TIGHT)
    np.testing.assert_allclose(found.by_parameter[:, 0], oscillation_by(times), atol=2e-6)
    np.testing.assert_allclose(found.record["x"], oscillation(times, 2.0, 0.1, 1.0), atol=1e-6)
    assert found.parameters == ("w", "D", "x")
    assert not found.exact  # the start value itself was moved, for lack of a function that would tell
    assert sensitivities(fixture_model(OSCILLATOR, fmi), forced(times), ("D",), solver=_TIGHT).exact


def test_error_falls_with_the_order_of_the_method(fixture_model):
    times, errors, steps = np.array([10.0]), [], []
    for tolerance in (1e-5, 1e-8):
        found = sensitivities(fixture_model(OSCILLATOR), forced(times), ("w", "D"), solver=Esdirk(tolerance, tolerance))
        errors.append(np.abs(found.by_parameter[:, 0] - oscillation_by(times)[:, :2]).max())
        steps.append(found.record.statistics["steps"])
    order = math.log(errors[0] / errors[1]) / math.log(steps[1] / steps[0])
    assert order == pytest.approx(4, abs=0.6)


def test_values_are_those_of_a_plain_run(fixture_model):
    times = np.linspace(0, 5, 21)
    plain = simulate(fixture_model(OSCILLATOR), forced(times), solver=_TIGHT)
    found = sensitivities(fixture_model(OSCILLATOR), forced(times), ("w",), solver=_TIGHT)
    np.testing.assert_allclose(found.record.values, plain.values, atol=1e-7)  # Newton starts from another matrix


@pytest.mark.parametrize(
    ("why", "lie"), [("the FMU gives no derivatives", None), ("no derivative by w", 1.0), ("no derivatives", 2.0)]
)
def test_without_true_derivatives_differences_tell_the_same(fixture_model, why, lie):
    times = np.linspace(0, 10, 41)
    model = fixture_model(_PLAIN if lie is None else OSCILLATOR)
    more = {} if lie is None else {"lie": lie}
    found = sensitivities(model, forced(times, **more), ("w", "x"))
    np.testing.assert_allclose(found.by_parameter[:, 0], oscillation_by(times)[:, [0, 2]], atol=3e-4)
    assert not found.exact
    assert why in found.message


def test_a_jump_at_the_end_is_in_the_last_row_and_its_derivatives(tmp_path):
    push = Signal.steps([0.0, 0.2], [1.0, 5.0])
    runs = [
        sensitivities(text_model(LAG, tmp_path), Experiment(np.array(times), ("power",), {"u": push}), ("K",))
        for times in ([0.0, 0.1, 0.2], [0.0, 0.1, 0.2, 0.3])
    ]
    np.testing.assert_array_equal(runs[0].record["power"], runs[1].record["power"][:3])
    np.testing.assert_array_equal(runs[0].by_parameter, runs[1].by_parameter[:3])


@pytest.mark.parametrize("fmi", [2, 3])
def test_lag_after_a_step_by_parameters_start_and_output(tmp_path, fmi):
    model, t = text_model(LAG, tmp_path, fmi=fmi), np.linspace(0, 3, 61)
    step = Experiment(t, ("y", "power", "T"), {"u": Signal.steps([0, 1.0], [0.0, 1.0])})
    found = sensitivities(model, step, ("T", "K", "y_start"), solver=_TIGHT)
    after = np.maximum(t - 1, 0)
    decay, fall = np.exp(-t / 0.5), np.exp(-after / 0.5)
    y = 0.3 * decay + 2 * (1 - fall)
    by = np.stack([0.3 * decay * t / 0.25 - 2 * fall * after / 0.25, 1 - fall, decay], axis=1)
    np.testing.assert_allclose(found.record["y"], y, atol=1e-7)
    np.testing.assert_allclose(found.by_parameter[:, 0], by, atol=1e-6)
    u = (t >= 1.0)[:, None]
    expected = u * (2 * by + np.outer(y, [0, 1, 0]))  # power = K u y
    np.testing.assert_allclose(found.by_parameter[:, 1], expected, atol=2e-6)
    np.testing.assert_array_equal(found.by_parameter[:, 2], np.tile([1.0, 0.0, 0.0], (61, 1)))


def test_ball_is_differentiated_through_its_bounce(fixture_model):
    times = np.array([0.2, 0.6])
    found = sensitivities(fixture_model(BALL), Experiment(times, ("h",)), ("g", "e"))
    first, g, e = math.sqrt(2 / 9.81), 9.81, 0.8

    def height(g: float, e: float) -> float:
        hit = math.sqrt(2 / g)
        return e * g * hit * (0.6 - hit) - g * (0.6 - hit) ** 2 / 2

    d = 1e-6
    by_g = (height(g + d, e) - height(g - d, e)) / (2 * d)
    by_e = (height(g, e + d) - height(g, e - d)) / (2 * d)
    assert times[0] < first < times[1]
    np.testing.assert_allclose(found.by_parameter[:, 0], [[-0.02, 0.0], [by_g, by_e]], atol=1e-6)
    assert not found.exact
    assert "events" in found.message


def pump_run(times: np.ndarray) -> Experiment:
    """From rest into a sine, without a step that would saturate the valve: at its limit the model has a kink."""
    command = sine(2 * math.pi * 3, 10.0)
    return Experiment(times, ("alphaPercent", "u"), {"alphaCMD": command}, rates={"alphaCMD_t": "alphaCMD"})


def test_pump_agrees_with_differences_of_tight_runs_in_every_column():
    model, experiment = pump_model("free"), pump_run(np.linspace(0, 0.25, 26))
    found = sensitivities(model, experiment, PUMP, solver=Esdirk(1e-8, 1e-8))
    assert found.exact
    for p, name in enumerate(PUMP):
        value = model[name].start
        runs = [experiment.override(**{name: value * (1 + sign * 1e-4)}) for sign in (1, -1)]
        up, down = (simulate(model, run, solver=Rodas(1e-10, 1e-10)).values for run in runs)
        difference = (up - down) / (2e-4 * value)
        size = np.abs(difference).max(axis=0)
        assert (np.abs(found.by_parameter[:, :, p] - difference).max(axis=0) <= 1e-4 * size).all(), name


def test_derivatives_may_choose_the_steps(fixture_model):
    times = np.linspace(0, 10, 41)
    loose, driven = (
        sensitivities(fixture_model(OSCILLATOR), forced(times), ("w", "D"), solver=Esdirk(1e-3, 1e-3, derivative_tol=d))
        for d in (math.inf, 1e-6)
    )
    errors = [np.abs(found.by_parameter[:, 0] - oscillation_by(times)[:, :2]).max() for found in (loose, driven)]
    assert errors[0] > 2e-2
    assert errors[1] < 2e-4
    assert driven.record.statistics["steps"] > loose.record.statistics["steps"]


def test_kink_of_the_model_asks_for_derivatives_in_the_step_rule():
    """A step of the command saturates the valve; the reference is a difference of tight runs."""
    model, times = pump_model("free"), np.linspace(0, 0.2, 41)
    command = {"alphaCMD": sine(2 * math.pi * 3, 10.0, 30.0)}
    run = Experiment(times, ("alphaPercent",), command, rates={"alphaCMD_t": "alphaCMD"})
    value = model["omega_v"].start
    sides = [run.override(omega_v=value * (1 + sign * 1e-4)) for sign in (1, -1)]
    up, down = (simulate(model, side, solver=Rodas(1e-10, 1e-10)).values for side in sides)
    difference = (up - down) / (2e-4 * value)
    error = [
        np.abs(sensitivities(model, run, ("omega_v",), solver=s).by_parameter[:, :, 0] - difference).max()
        for s in (Esdirk(1e-5, 1e-5), Esdirk(1e-5, 1e-5, derivative_tol=3e-5))
    ]
    assert error[1] < 0.3 * error[0] < 0.3 * 0.05 * np.abs(difference).max()


def test_failed_run_is_an_outcome_or_an_error(fixture_model):
    beyond = Experiment(np.linspace(0, 3, 31), ("x",))
    with pytest.raises(SimulationError) as failure:
        sensitivities(fixture_model(FRAGILE), beyond, ("x",))
    assert 15 < failure.value.record.time.size < 31
    good = Experiment(np.linspace(0, 1, 11), ("x",))
    bad, fine = sensitivities_many(fixture_model(FRAGILE), [beyond, good], ("x",))
    assert bad.record.outcome is not Outcome.DONE
    np.testing.assert_allclose(fine.by_parameter[:, 0, 0], 1 - fine.record.time / 2, atol=2e-3)  # d(1 - t/2)^2/dx(0)


def test_results_do_not_depend_on_the_number_of_workers(fixture_model):
    runs = [forced(np.linspace(0, 5, 21), D=0.05 + 0.01 * i) for i in range(9)]
    many = [sensitivities_many(fixture_model(OSCILLATOR), runs, ("w", "D"), workers=n) for n in (1, 3)]
    for one, three in zip(*many, strict=True):
        np.testing.assert_array_equal(one.by_parameter, three.by_parameter)
        np.testing.assert_array_equal(one.record.values, three.record.values)


def test_runs_that_begin_alike_share_their_start_and_no_others_do(fixture_model):
    model, times = fixture_model(OSCILLATOR), np.linspace(0, 5, 21)
    fast = dataclasses.replace(forced(times), inputs={"u": sine(2 * _OMEGA)})  # begins as the first does
    runs = [forced(times), fast, forced(times, x=-2.0), forced(times, D=0.3)]
    together = sensitivities_many(model, runs, ("w", "D", "x"), solver=_TIGHT)
    for run, one in zip(runs, together, strict=True):
        np.testing.assert_array_equal(
            one.by_parameter, sensitivities(model, run, ("w", "D", "x"), solver=_TIGHT).by_parameter
        )
    assert not np.allclose(together[0].by_parameter, together[1].by_parameter)


def test_interrupt_stops_runs_that_are_under_way(fixture_model):
    long = Experiment(np.array([1e9]), ("x",), overrides={"D": 0.0, "x": 1.0})

    def stop(done: int, of: int) -> None:
        raise KeyboardInterrupt

    runs = [forced(np.linspace(0, 1, 5)), long, long]
    with pytest.raises(KeyboardInterrupt):  # else this takes minutes
        sensitivities_many(fixture_model(OSCILLATOR), runs, ("w",), workers=3, progress=stop)


def test_a_derivative_that_does_not_exist_is_named(tmp_path):
    """y = sqrt(a t): at the start its derivative by the state is infinite, and so by a is infinity times zero."""
    found = sensitivities(text_model(ROOT, tmp_path), Experiment(np.array([0.0, 1.0, 4.0]), ("y",)), ("a",))
    assert "the derivative of y by a is nan at 0 s" in found.message
    np.testing.assert_allclose(found.by_parameter[1:, 0, 0], [0.5, 1.0], rtol=1e-6)


def test_other_solvers_are_refused_by_name(fixture_model):
    with pytest.raises(BadInput, match=r"the steps of Rodas cannot be differentiated; give solver=Esdirk"):
        sensitivities(fixture_model(OSCILLATOR), forced(np.array([1.0])), ("w",), solver=Rodas())


def test_a_run_that_cannot_start_does_not_cost_the_others_their_derivatives(tmp_path):
    good = Experiment(np.linspace(0, 1, 5), ("x",))
    bad = good.override(u=-2.0)  # the root of -1
    found = sensitivities_many(text_model(DISCARDS, tmp_path), [bad, good], ("x",))
    assert found[0].record.outcome is not Outcome.DONE
    assert found[1].message == "start values were differentiated by differences"  # and nothing else was
    np.testing.assert_allclose(found[1].by_parameter[:, 0, 0], np.exp(-good.times), rtol=1e-4)


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (("nothing",), "no variable 'nothing'"),
        (("w", "w"), "twice"),
        ("w", "write a tuple"),
        (("u",), "has a signal and an override"),
        (("power",), "cannot be set|no value"),
    ],
)
def test_what_cannot_be_differentiated_by_is_refused(fixture_model, names, words):
    with pytest.raises(BadInput, match=words):
        sensitivities(fixture_model(OSCILLATOR), forced(np.array([1.0])), names)


def test_an_input_held_between_samples_may_jump_any_number_of_times(fixture_model):
    """Each jump is an event, and time moves on between them."""
    count, step = 3000, 1e-3
    values = np.arange(count) % 2.0
    pieces = np.zeros((count, 4))
    pieces[:, 0] = values
    held = Signal(step * np.arange(count), pieces, np.zeros((count, 0, 4)))
    times = np.array([0.5 * count * step, (count - 0.5) * step])
    run = Experiment(times, ("x", "v"), {"u": held})
    found = sensitivities(fixture_model(OSCILLATOR), run, ("w", "D"), solver=Esdirk(1e-6, 1e-6))
    assert found.record.outcome is Outcome.DONE
    plain = simulate(fixture_model(OSCILLATOR), run, solver=Rodas(1e-8, 1e-8))
    np.testing.assert_allclose(found.record["x"], plain["x"], atol=1e-4)
