"""Known systems, exact: closed forms come back. The dead time's closed form is K exp(-s tau) / (T s + 1)."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pysim.identify import TransferFunction
from pysim.identify.blackbox import ComplexResponse, Structure, fit_transfer_function
from pysim.types import BadInput, NoteCode, SineTest
from tests.pysim.identify.blackbox.systems import exact, from_roots, noisy, pairs

F = np.geomspace(0.1, 30, 24)


def test_first_order_with_dead_time() -> None:
    gain, lag, delay = 2.5, 0.08, 0.035
    w = 2 * np.pi * F
    values = gain / np.sqrt(1 + (w * lag) ** 2) * np.exp(-1j * (np.arctan(w * lag) + w * delay))
    fit = fit_transfer_function(ComplexResponse(F, values), Structure(1, dead_time_max=0.2))
    assert fit.function.dead_time == pytest.approx(delay, rel=1e-8)
    assert fit.gain().value == pytest.approx(gain, rel=1e-8)
    assert -1 / fit.poles[0].value.real == pytest.approx(lag, rel=1e-8)
    assert fit.fit_percent == pytest.approx(100, abs=1e-6)


def test_a_known_dead_time_is_kept() -> None:
    function = from_roots([], [-9.0], 9.0, dead_time=0.02)
    fit = fit_transfer_function(exact(function, F), Structure(1, dead_time=0.02))
    assert fit.function.dead_time == 0.02
    assert fit.names == ("b0", "a0")
    np.testing.assert_allclose(fit.function.denominator, function.denominator, rtol=1e-9)


SYSTEMS = {
    "fourth order resonance": from_roots([-15.0], pairs(-0.4 + 12j, -2 + 90j), 5e4),
    "eighth order with clusters": from_roots(
        pairs(-0.3 + 5j, -1 + 8.2j, -30 + 105j), pairs(-0.5 + 3j, -0.2 + 8j, -0.3 + 8.5j, -3 + 100j), 1e3
    ),
    "right half plane zero": from_roots([30.0], [-5.0, -40.0, -60.0], -100.0),
    "integrator": from_roots([], [0.0, -25.0], 50.0),
    "unstable": from_roots([-3.0], [4.0, -25.0], 50.0),
    "differentiator": from_roots([0.0, -2.0], [-25.0, -50.0], 3.0),
    "more zeros than poles": from_roots([-3.0, -9.0], [-25.0], 0.5),
    "double pole": from_roots([], [-20.0, -20.0], 400.0),
    "no poles": from_roots([-7.0], [], 0.5),
}


@pytest.mark.parametrize("weights", ["uniform", "relative"])
@pytest.mark.parametrize("name", SYSTEMS)
def test_known_systems_come_back(name: str, weights: str) -> None:
    function = SYSTEMS[name]
    frequency = np.geomspace(0.1, 30, 80)
    structure = Structure(len(function.denominator) - 1, len(function.numerator) - 1)
    fit = fit_transfer_function(exact(function, frequency), structure, weights=weights)
    np.testing.assert_allclose(fit.function.at(frequency), function.at(frequency), rtol=1e-6)
    found = np.sort_complex(np.array([pole.value for pole in fit.poles]))
    scale = np.max(np.abs(function.poles), initial=1)
    np.testing.assert_allclose(
        found, np.sort_complex(function.poles), atol=(1e-3 if name == "double pole" else 1e-6) * scale
    )
    assert fit.converged


@st.composite
def stable_systems(draw):
    """Two to six poles within the measured band, damped by 2 percent at least, fewer zeros, a gain of either sign."""
    count = draw(st.integers(1, 3))
    sizes = draw(st.lists(st.floats(3.0, 120.0), min_size=count, max_size=count))
    damping = draw(st.lists(st.floats(0.02, 0.9), min_size=count, max_size=count))
    poles = pairs(*(w * complex(-d, np.sqrt(1 - d * d)) for w, d in zip(sizes, damping, strict=True)))
    poles += [-draw(st.floats(3.0, 120.0))] * draw(st.integers(0, 1))
    zeros = [draw(st.floats(-150.0, -1.0))] * draw(st.integers(0, 1))
    lead = draw(st.sampled_from([-1.0, 1.0])) * abs(np.prod(poles))
    return from_roots(zeros, poles, lead)


@settings(max_examples=40, derandomize=True)
@given(stable_systems(), st.booleans())
def test_random_stable_systems_come_back_from_exact_data(function: TransferFunction, stable: bool) -> None:
    frequency = np.geomspace(0.1, 40, 60)
    structure = Structure(len(function.denominator) - 1, len(function.numerator) - 1, stable=stable)
    fit = fit_transfer_function(exact(function, frequency), structure, weights="relative")
    np.testing.assert_allclose(fit.function.at(frequency), function.at(frequency), rtol=1e-6)
    assert fit.function.stable


def test_stable_on_request_where_noise_asks_for_an_unstable_pole() -> None:
    function = from_roots([], [*pairs(-0.02 + 12j), -40.0], 5e3)  # nearly undamped, and no point on the peak
    frequency = np.array([0.2, 0.5, 1.0, 1.5, 2.5, 4.0, 6.0, 9.0, 14.0, 20.0])
    free, held = [], []
    for seed in range(12):
        data = noisy(function, frequency, 0.05, seed)
        free.append(fit_transfer_function(data, Structure(3)))
        held.append(fit_transfer_function(data, Structure(3, stable=True)))
    unstable = [i for i, fit in enumerate(free) if not fit.function.stable]
    assert unstable
    assert all(fit.function.stable for fit in held)
    for a, b in zip(free, held, strict=True):
        assert b.misfit >= a.misfit * (1 - 1e-9)
        if a.function.stable:
            assert b.misfit == pytest.approx(a.misfit, rel=1e-6)
    assert all(NoteCode.UNSTABLE in [note.code for note in free[i].notes] for i in unstable)
    assert all(NoteCode.EDGE_OF_STABILITY in [note.code for note in held[i].notes] for i in unstable)


def test_weights_decide_which_points_count() -> None:
    function = from_roots([], pairs(-8 + 30j), 964.0)
    rough = exact(function, F).values.copy()
    rough[-6:] *= 1.5  # a gain error where the gain is small
    data = ComplexResponse(F, rough)
    by = {w: fit_transfer_function(data, Structure(2), weights=w).function.at(F) for w in ("uniform", "relative")}
    head, tail = slice(0, 8), slice(-6, None)
    error = {w: np.abs(values / rough - 1) for w, values in by.items()}
    assert error["uniform"][head].max() < error["relative"][head].max()
    assert error["relative"][tail].max() < error["uniform"][tail].max()


def test_a_response_of_gain_and_phase_gives_the_same() -> None:
    function = from_roots([], [-5.0, -9.0], 45.0)
    response = function.response(F, SineTest(0.0, 1.0, "u", "y"))
    a, b = (fit_transfer_function(data, Structure(2)) for data in (response, exact(function, F)))
    np.testing.assert_allclose(a.function.denominator, b.function.denominator, rtol=1e-9)


def test_refuses_more_unknowns_than_numbers() -> None:
    with pytest.raises(BadInput, match="ask for fewer poles and zeros"):
        fit_transfer_function(exact(SYSTEMS["integrator"], np.array([1.0, 2.0])), Structure(3, 2))


def test_as_many_unknowns_as_numbers_need_the_noise_told() -> None:
    function, frequency = from_roots([], [*pairs(-5 + 30j), -9.0], 8e3), np.array([1.0, 5.0])
    fit = fit_transfer_function(noisy(function, frequency, 1e-6, seed=1), Structure(3))
    np.testing.assert_allclose(fit.model, fit.data.values, rtol=1e-6)  # four numbers through two points
    assert (fit.freedom, fit.scatter) == (0, 1.0)
    with pytest.raises(BadInput, match="ask for fewer"):
        fit_transfer_function(exact(function, frequency), Structure(3))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("seed", range(25))
def test_whatever_the_numbers_there_is_an_answer(seed: int) -> None:
    """Noise alone, a constant, a double integrator, a delay: with structures that have nothing to do with them."""
    rng = np.random.default_rng(seed)
    frequency = np.geomspace(0.01, 200, int(rng.integers(8, 16)))
    s = 2j * np.pi * frequency
    kinds = (
        rng.standard_normal(s.size) + 1j * rng.standard_normal(s.size),
        np.ones_like(s),
        1 / s**2,
        np.exp(-0.1 * s),
    )
    top = 0.3 if rng.random() < 0.4 else None
    structure = Structure(int(rng.integers(0, 6)), int(rng.integers(0, 5)), 0.0, top, bool(rng.random() < 0.5))
    fit = fit_transfer_function(ComplexResponse(frequency, kinds[seed % 4]), structure, tries=2)
    assert np.isfinite(fit.values).all()
    assert all(e.interval[0] <= e.value <= e.interval[1] for e in (*fit.estimates(), fit.gain()))
    assert fit.function.stable or not structure.stable
