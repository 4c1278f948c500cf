"""Periodic orbits against closed forms, long transients and differences; and the ways they may fail."""

import dataclasses
import math

import numpy as np
import pytest

from pysim.simulate import Esdirk, Periodic, Rodas, open_runs, periodic_many, simulate
from pysim.thesis import pump_model
from pysim.types import BadInput, Experiment, Outcome, Signal
from tests.pysim.simulate.fixture_fmus import HOARDER, OSCILLATOR
from tests.pysim.simulate.text_models import DISCARDS, LATE, RELAY, TANK, text_model

_TIGHT = Esdirk(1e-8, 1e-8)
_OMEGA = 3.0
_PLAIN = dataclasses.replace(OSCILLATOR, tangents=False)
PUMP = ("omega_v", "zeta_v", "L", "A_p", "V_0", "m_eff", "k", "b", "K_p", "K_D", "T_d", "K_L", "tau")


def sine(omega: float, amplitude: float = 1.0, offset: float = 0.0) -> Signal:
    return Signal(np.zeros(1), np.array([[offset, 0, 0, 0]]), np.array([[[amplitude, 0, omega, 0]]]))


def driven(points: int = 24, **overrides: float) -> Periodic:
    return Periodic(2 * math.pi / _OMEGA, points, ("x", "v"), {"u": sine(_OMEGA)}, overrides)


def pump_test(frequency: float, amplitude: float = 10.0, offset: float = 50.0, **overrides: float) -> Periodic:
    command = {"alphaCMD": sine(2 * math.pi * frequency, amplitude, offset)}
    rates = {"alphaCMD_t": "alphaCMD"}
    return Periodic(1 / frequency, 32, ("alphaPercent", "u"), command, overrides, rates)


def steady_oscillation(test: Periodic) -> tuple[np.ndarray, np.ndarray]:
    """Values (n, 2) and derivatives (n, 2, 2) by w and D of the forced oscillation at w = 2, D = 0.1."""
    w, damping = 2.0, 0.1
    gain = 1 / (w**2 - _OMEGA**2 + 2j * damping * w * _OMEGA)
    slopes = -(gain**2) * np.array([2 * w + 2j * damping * _OMEGA, 2j * w * _OMEGA])
    phase = np.exp(1j * _OMEGA * test.experiment().times[:-1])[:, None] * np.array([1, 1j * _OMEGA])
    return np.imag(gain * phase), np.imag(phase[:, :, None] * slopes)


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize("guess", [None, np.array([5.0, -20.0])])
def test_linear_oscillator_needs_one_correction_from_anywhere(fixture_model, fmi, guess):
    (orbit,) = periodic_many(fixture_model(OSCILLATOR, fmi), [driven()], ("w", "D"), guesses=[guess], solver=_TIGHT)
    values, by = steady_oscillation(driven())
    assert (orbit.outcome, orbit.exact, orbit.message) == (Outcome.DONE, True, "")
    np.testing.assert_allclose(orbit.record.values, values, atol=2e-7)
    np.testing.assert_allclose(orbit.by_parameter, by, atol=1e-6)
    np.testing.assert_allclose(orbit.state, values[0], atol=2e-7)
    np.testing.assert_allclose(orbit.state_by_parameter, by[0], atol=1e-6)
    assert orbit.iterations == 2  # the guess, and from where the correction of it leads


def test_good_guess_costs_one_period(fixture_model):
    model = fixture_model(OSCILLATOR)
    (first,) = periodic_many(model, [driven()])
    (second,) = periodic_many(model, [driven(w=2.0001)], guesses=[first.state])
    assert second.iterations == 1


@pytest.mark.parametrize("frequency", [0.1, 1.0, 10.0, 30.0])
def test_pump_agrees_with_a_long_transient(frequency):
    model, test = pump_model("free"), pump_test(frequency)
    (orbit,) = periodic_many(model, [test], solver=Esdirk(1e-7, 1e-7))
    settled = max(3, math.ceil(2 * frequency)) / frequency
    times = test.experiment().times[:-1] + settled
    reference = simulate(model, Experiment(times, test.record, test.inputs, rates=test.rates), solver=Rodas(1e-9, 1e-9))
    amplitude = np.ptp(reference.values, axis=0) / 2
    assert (np.abs(orbit.record.values - reference.values) <= 2e-5 * amplitude).all()
    np.testing.assert_allclose(orbit.record.time + settled, reference.time, rtol=1e-12)


def test_pump_agrees_with_differences_of_orbits_in_every_column():
    model, test = pump_model("free"), pump_test(3.0)
    (orbit,) = periodic_many(model, [test], PUMP, solver=_TIGHT, mismatch=1e-6)
    assert orbit.exact
    for p, name in enumerate(PUMP):
        value = model[name].start
        sides = [pump_test(3.0, **{name: value * (1 + sign * 1e-3)}) for sign in (1, -1)]
        up, down = periodic_many(model, sides, solver=_TIGHT, mismatch=1e-7, guesses=[orbit.state] * 2)
        difference = (up.record.values - down.record.values) / (2e-3 * value)
        error = np.abs(orbit.by_parameter[:, :, p] - difference) / np.abs(difference).max(axis=0)
        assert np.median(error, axis=0).max() < 1e-5, name
        assert error.max() < 1e-3, name  # where the valve's edges close, the model has a kink


def test_loose_guess_is_corrected_and_what_is_left_is_of_second_order():
    model, test = pump_model("free"), pump_test(1.0)
    exact, loose = (
        periodic_many(model, [test], PUMP, solver=Esdirk(1e-6, 1e-6), mismatch=m, guesses=[None])[0]
        for m in (1e-7, 0.05)
    )
    (shifted,) = periodic_many(
        model, [test], PUMP, solver=Esdirk(1e-6, 1e-6), mismatch=0.05, guesses=[exact.state * (1 + 1e-3)]
    )
    amplitude = np.ptp(exact.record.values, axis=0) / 2
    for orbit in (loose, shifted):
        assert orbit.iterations == 1
        assert (np.abs(orbit.record.values - exact.record.values) < 1e-3 * amplitude).all()


@pytest.mark.parametrize(("amplitude", "offset"), [(10.0, 25.0), (20.0, -75.0)])
def test_corrections_as_small_as_the_steps_can_move_them_end_the_search(amplitude, offset):
    """A valve at its ends 15 times a second: coarse steps move the end of a period by more than the mismatch asked."""
    values = (
        219.9,
        1.066,
        0.0329,
        5.217e-4,
        4.249e-5,
        81.1,
        17478.0,
        9395.0,
        55.18,
        0.1688,
        3.537e-3,
        1.4e-7,
        4.979e-3,
    )
    # how many corrections one machine takes is chance, so that machines a thousandth apart are looked at together
    near = np.array(values) * (1 + 1e-3 * np.random.default_rng(1).standard_normal((16, 13)))
    tests = [pump_test(15.0, amplitude, offset, **dict(zip(PUMP, row.tolist(), strict=True))) for row in near]
    model = pump_model("free")
    coarse = periodic_many(model, tests, solver=Esdirk(1e-4, 1e-4), mismatch=1e-3)
    ended = [k for k, orbit in enumerate(coarse) if orbit.iterations > 0]
    assert len(ended) >= 11  # of sixteen; the others go the long way round
    assert np.median([coarse[k].iterations for k in ended]) <= 4
    first = ended[0]
    (fine,) = periodic_many(model, [tests[first]], solver=_TIGHT, mismatch=1e-6)
    amplitudes = np.ptp(fine.record.values, axis=0) / 2
    apart = np.abs(coarse[first].record.values - fine.record.values)
    assert (apart <= 3e-3 * amplitudes).all()  # 30 tolerated errors


def test_override_sets_parameters_and_leaves_the_original_alone():
    first = driven(w=1.0)
    second = first.override(w=2.0, D=0.3)
    assert (dict(first.overrides), dict(first.experiment().overrides)) == ({"w": 1.0}, {"w": 1.0})
    assert dict(second.overrides) == dict(second.experiment().overrides) == {"w": 2.0, "D": 0.3}
    assert (second.period, second.inputs, second.experiment().times.size) == (first.period, first.inputs, 25)
    with pytest.raises(BadInput, match="'w' cannot be set to 'fast'"):
        first.override(w="fast")


def test_without_derivatives_from_the_fmu_differences_tell_the_same(fixture_model):
    (orbit,) = periodic_many(fixture_model(_PLAIN), [driven()], ("w", "D"))
    values, by = steady_oscillation(driven())
    np.testing.assert_allclose(orbit.record.values, values, atol=1e-4)
    np.testing.assert_allclose(orbit.by_parameter, by, atol=1e-4)
    np.testing.assert_allclose(orbit.state_by_parameter, by[0], atol=1e-4)
    assert (orbit.exact, orbit.outcome) == (False, Outcome.DONE)


def test_level_that_nothing_holds_keeps_the_guess(tmp_path):
    """p1 - p2 is a lag of the inflow; p1 + p2 is its integral, whose level is free."""
    test = Periodic(2 * math.pi, 16, ("p1", "p2"), {"q": sine(1.0)})
    model = text_model(TANK, tmp_path)
    (orbit,) = periodic_many(model, [test], ("R",), guesses=[np.array([7.0, 7.0])], solver=_TIGHT)
    t = orbit.record.time
    gain = 1 / (2 * 1j + 2 / 0.5)  # C (p1 - p2)' + 2 (p1 - p2) / R = q
    np.testing.assert_allclose(orbit.record["p1"] - orbit.record["p2"], np.imag(gain * np.exp(1j * t)), atol=1e-6)
    np.testing.assert_allclose(np.ptp(orbit.record["p1"] + orbit.record["p2"] + np.cos(t) / 2), 0, atol=1e-6)
    slope = gain**2 * 2 / 0.5**2
    difference = orbit.by_parameter[:, 0, 0] - orbit.by_parameter[:, 1, 0]
    np.testing.assert_allclose(difference, np.imag(slope * np.exp(1j * t)), atol=1e-5)
    assert orbit.record.values.mean() == pytest.approx(7.0, abs=1.0)


def test_level_that_drifts_has_no_orbit(tmp_path):
    test = Periodic(1.0, 8, ("p1", "p2"), {"q": sine(2 * math.pi, offset=1.0)})
    (orbit,) = periodic_many(text_model(TANK, tmp_path), [test], ("R",))
    assert orbit.outcome is Outcome.NOT_PERIODIC
    assert "drifts" in orbit.message


def test_events_make_it_take_the_long_way(tmp_path):
    """T x' + x = +-1 with a square wave of period 2: x = 1 - 2 exp(-t/T)/(1 + exp(-1/T)) in the first half."""
    test = Periodic(2.0, 8, ("x",), {"u": sine(math.pi)})
    (orbit,) = periodic_many(text_model(RELAY, tmp_path), [test], ("T",))
    t, lag = orbit.record.time[:4], 0.5

    def closed(lag: float) -> np.ndarray:
        return 1 - 2 * np.exp(-t / lag) / (1 + math.exp(-1 / lag))

    np.testing.assert_allclose(orbit.record["x"][:4], closed(lag), atol=2e-5)
    slope = (closed(lag + 1e-5) - closed(lag - 1e-5)) / 2e-5
    np.testing.assert_allclose(orbit.by_parameter[:4, 0, 0], slope, atol=1e-4)
    assert (orbit.exact, orbit.iterations, orbit.outcome) == (False, 0, Outcome.DONE)
    assert "event" in orbit.message
    with open_runs(text_model(RELAY, tmp_path)) as runs:  # a search rather simulates the test as it was run
        (none,) = runs.orbits([test], ("T",))
    assert (none.outcome, none.record.values.size) == (Outcome.NOT_PERIODIC, 0)
    assert "event" in none.message


def test_model_that_cannot_be_run_is_data(tmp_path):
    tests = [Periodic(2.0, 8, ("x",), {"u": sine(math.pi, amplitude)}) for amplitude in (3.0, 0.5)]
    bad, good = periodic_many(text_model(DISCARDS, tmp_path), tests, ())
    assert bad.outcome not in (Outcome.DONE, Outcome.NOT_PERIODIC)
    assert bad.message
    assert good.outcome is Outcome.DONE
    again = periodic_many(text_model(DISCARDS, tmp_path), tests, guesses=[bad.state, good.state])
    assert again[1].iterations == 1


def test_memory_beyond_the_states_is_noticed(fixture_model):
    """x' = u - (0.1 + 0.9 max u) x: the first period from the states alone is not like the second."""
    test = Periodic(2.0, 16, ("x",), {"u": sine(math.pi)})
    (orbit,) = periodic_many(fixture_model(HOARDER), [test])
    assert "remembers" in orbit.message
    expected = np.imag(np.exp(1j * math.pi * orbit.record.time) / (1j * math.pi + 1))
    np.testing.assert_allclose(orbit.record["x"], expected, atol=1e-6)


def test_delay_is_settled(tmp_path):
    """x' = u - x(t - 0.2)."""
    test = Periodic(2.0, 16, ("x",), {"u": sine(math.pi)})
    (orbit,) = periodic_many(text_model(LATE, tmp_path), [test])
    assert orbit.iterations == 0
    gain = 1 / (1j * math.pi + np.exp(-0.2j * math.pi))
    expected = np.imag(gain * np.exp(1j * math.pi * orbit.record.time))
    np.testing.assert_allclose(orbit.record["x"], expected, atol=1e-2 * abs(gain))  # the history has the steps' points


def test_results_do_not_depend_on_the_number_of_workers(fixture_model):
    tests = [driven(D=0.05 + 0.01 * i) for i in range(9)]
    many = [periodic_many(fixture_model(OSCILLATOR), tests, ("w",), workers=n) for n in (1, 3)]
    for one, three in zip(*many, strict=True):
        np.testing.assert_array_equal(one.by_parameter, three.by_parameter)
        np.testing.assert_array_equal(one.record.values, three.record.values)


def test_interrupt_stops_everything(fixture_model):
    def stop(done: int, of: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        periodic_many(fixture_model(OSCILLATOR), [driven()] * 50, ("w",), progress=stop)


@pytest.mark.parametrize("periods", [1, 3])
def test_inputs_repeat_with_the_period(periods):
    """Else there is no orbit, and it takes minutes to find that out."""
    square = Signal.steps(np.arange(20) * 0.5, np.arange(20) % 2.0)
    for signal, period in ((sine(_OMEGA), 2 * math.pi / _OMEGA), (square, 1.0), (Signal.constant(3.0), 0.7)):
        assert Periodic(periods * period, 8, ("x",), {"u": signal}).period == periods * period
    for signal, period in ((sine(_OMEGA), 2.1), (square, 0.5), (Signal.steps([0.0, 0.5], [0.0, 1.0]), 1.0)):
        with pytest.raises(BadInput, match="input u does not repeat every"):
            Periodic(period, 8, ("x",), {"u": signal})


def test_misuse_is_refused(fixture_model):
    model = fixture_model(OSCILLATOR)
    with pytest.raises(BadInput, match="2 tests need as many guesses"):
        periodic_many(model, [driven()] * 2, guesses=[None])
    with pytest.raises(BadInput, match="2 states"):
        periodic_many(model, [driven()], guesses=[np.zeros(3)])
    with pytest.raises(BadInput, match="period is -1"):
        Periodic(-1.0, 8, ("x",))
    for period in (0, math.nan, "1"):
        with pytest.raises(BadInput, match="give a positive number"):
            Periodic(period, 8, ("x",))
    for points in (0, 2.5):
        with pytest.raises(BadInput, match="at least 1"):
            Periodic(1.0, points, ("x",))
    with pytest.raises(BadInput, match="2 states, got 'all'"):
        periodic_many(model, [driven()], guesses=["all"])
    with pytest.raises(BadInput, match="also for a single one"):
        periodic_many(model, driven())
    with pytest.raises(BadInput, match="Rodas cannot be differentiated"):
        periodic_many(model, [driven()], solver=Rodas())
    with pytest.raises(BadInput, match="mismatch"):
        periodic_many(model, [driven()], mismatch=0.0)
    assert periodic_many(model, []) == ()
