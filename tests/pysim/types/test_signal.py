import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import interpolate

from pysim.types import BadInput, Signal

_numbers = st.floats(-5, 5).map(lambda v: round(v, 3))


@st.composite
def signals(draw: st.DrawFn) -> Signal:
    """Pieces of 0.1 to 2 s with moderate coefficients, as commands have them."""
    count = draw(st.integers(1, 5))
    lengths = draw(st.lists(st.floats(0.1, 2.0), min_size=count, max_size=count))
    starts = draw(_numbers) + np.cumsum(lengths)
    waves = draw(st.integers(0, 3))
    cubics = np.reshape(draw(st.lists(_numbers, min_size=4 * count, max_size=4 * count)), (count, 4))
    size = 4 * count * waves
    sines = np.reshape(draw(st.lists(_numbers, min_size=size, max_size=size)), (count, waves, 4))
    return Signal(starts, cubics, sines)


def by_hand(signal: Signal, t: float) -> float:
    """The defining formula of the docstring, written once more, plainly."""
    k = max([i for i, start in enumerate(signal.starts) if start <= t], default=0)
    s = max(t - signal.starts[k], 0.0)
    cubic = sum(c * s**n for n, c in enumerate(signal.cubics[k]))
    return cubic + sum(a * np.sin(phi + om * s + 0.5 * kappa * s * s) for a, phi, om, kappa in signal.sines[k])


@given(signals(), st.lists(st.floats(-8, 20), min_size=1, max_size=8))
def test_value_is_the_defining_formula(signal, times):
    np.testing.assert_allclose(
        signal.value(np.array(times)), [by_hand(signal, t) for t in times], atol=1e-9, rtol=1e-11
    )


@given(signals(), signals(), st.lists(st.floats(-8, 20), min_size=1, max_size=8))
def test_a_sum_has_the_values_and_rates_of_both(one, other, times):
    t = np.array(times)
    total = one.plus(other)
    scale = 1 + np.abs(one.cubics).max() * 20**3
    np.testing.assert_allclose(total.value(t), one.value(t) + other.value(t), atol=1e-11 * scale, rtol=1e-9)
    np.testing.assert_allclose(
        total.derivative(t), one.derivative(t) + other.derivative(t), atol=1e-10 * scale, rtol=1e-9
    )
    assert set(one.starts) | set(other.starts) == set(total.starts)


@given(signals(), st.floats(-3, 3), st.lists(st.floats(-8, 20), min_size=1, max_size=8))
def test_a_multiple_has_its_values_and_rates(signal, factor, times):
    t = np.array(times)
    scale = 1 + np.abs(signal.cubics).max() * 20**3
    np.testing.assert_allclose(signal.times(factor).value(t), factor * signal.value(t), atol=1e-12 * scale)
    np.testing.assert_allclose(signal.times(factor).derivative(t), factor * signal.derivative(t), atol=1e-12 * scale)


@given(signals(), st.floats(0, 1), st.integers(0, 4))
@settings(max_examples=200)
def test_derivative_is_the_limit_of_differences(signal, share, piece):
    k = piece % signal.starts.size
    end = signal.starts[k + 1] if k + 1 < signal.starts.size else signal.starts[k] + 1.0
    h = 1e-4
    t = signal.starts[k] + 2 * h + share * (end - signal.starts[k] - 4 * h)  # a central difference within one piece
    coarse, fine = ((signal.value(np.array([t + d])) - signal.value(np.array([t - d]))) / (2 * d) for d in (h, h / 2))
    extrapolated = (4 * fine - coarse) / 3
    np.testing.assert_allclose(signal.derivative(np.array([t])), extrapolated, atol=2e-7, rtol=1e-8)


@given(signals())
def test_before_its_start_the_signal_stands_still(signal):
    early = signal.starts[0] - np.array([0.5, 3.0])
    np.testing.assert_array_equal(signal.value(early), signal.value(signal.starts[:1])[0])
    np.testing.assert_array_equal(signal.derivative(early), 0.0)


@given(signals())
def test_breaks_are_where_both_sides_differ(signal):
    jumps, kinks = signal.breaks()
    assert not jumps[0]
    for k in range(1, signal.starts.size):
        before = Signal(signal.starts[:k], signal.cubics[:k], signal.sines[:k])  # goes on past the start of piece k
        t = signal.starts[k : k + 1]
        jump = abs(before.value(t) - signal.value(t))[0]
        kink = abs(before.derivative(t) - signal.derivative(t))[0]
        assert jumps[k] == (jump > 1e-6) or jump < 1e-5
        assert kinks[k] == (kink > 1e-5) or kink < 1e-4


def test_smooth_pieces_have_no_breaks():
    # sin t cut into pieces, each with its own phase: nothing but rounding happens where they meet.
    starts = np.linspace(0, 6, 25)
    sines = np.array([[[1.0, t, 1.0, 0.0]] for t in starts])
    jumps, kinks = Signal(starts, np.zeros((25, 4)), sines).breaks()
    assert not jumps.any()
    assert kinks.tolist() == [True] + [False] * 24  # from standstill to a rate of 1


@pytest.mark.parametrize(
    ("starts", "cubics", "sines", "words"),
    [
        ([0, 1], np.zeros((1, 4)), np.zeros((2, 0, 4)), r"cubics of shape \(2, 4\)"),
        ([0], np.zeros((1, 4)), np.zeros((1, 4)), r"sines need shape \(1, n, 4\)"),
        ([0], np.full((1, 4), np.nan), np.zeros((1, 0, 4)), "every number must be finite"),
        ([0, 0], np.zeros((2, 4)), np.zeros((2, 0, 4)), "starts must increase"),
        ([], np.zeros((0, 4)), np.zeros((0, 0, 4)), "starts"),
    ],
)
def test_shapes_are_checked(starts, cubics, sines, words):
    with pytest.raises(BadInput, match=words):
        Signal(np.array(starts, float), cubics, sines)


def test_arrays_are_copied_and_read_only():
    starts = np.zeros(1)
    signal = Signal(starts, np.zeros((1, 4)), np.zeros((1, 0, 4)))
    starts[0] = 5.0
    assert signal.starts[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        signal.starts[0] = 1.0


def test_steps_hold_the_first_value_before_and_the_last_after():
    signal = Signal.steps([1, 2], [5, 7])
    np.testing.assert_array_equal(signal.value(np.array([-3, 0.9, 1.0, 1.9, 2.0, 99])), [5, 5, 5, 5, 7, 7])
    np.testing.assert_array_equal(Signal.constant(3.0).value(np.array([-1.0, 0.0, 8.0])), 3.0)


_times = st.lists(st.floats(0.05, 2.0), min_size=1, max_size=9).map(lambda h: np.cumsum([0.3, *h]))


@given(_times, st.data())
def test_lines_are_those_of_numpy(times, data):
    values = np.array(data.draw(st.lists(_numbers, min_size=times.size, max_size=times.size)))
    t = np.linspace(times[0] - 1, times[-1] + 1, 101)
    np.testing.assert_allclose(Signal.lines(times, values).value(t), np.interp(t, times, values), atol=1e-10)


@given(_times, st.data())
def test_curve_is_the_natural_spline_of_scipy(times, data):
    values = np.array(data.draw(st.lists(_numbers, min_size=times.size, max_size=times.size)))
    signal, t = Signal.through(times, values), np.linspace(times[0], times[-1], 101)[:-1]
    reference = interpolate.CubicSpline(times, values, bc_type="natural")
    np.testing.assert_allclose(signal.value(t), reference(t), atol=1e-9)
    np.testing.assert_allclose(signal.derivative(t), reference(t, 1), atol=1e-7)
    outside = np.array([times[0] - 1, times[-1], times[-1] + 1])
    np.testing.assert_array_equal(signal.value(outside), values[[0, -1, -1]])


def test_curve_with_rates_is_exact_for_a_cubic():
    t, fine = np.array([0.0, 0.5, 2.0]), np.linspace(0, 1.99, 50)
    signal = Signal.through(t, t**3 - t, rates=3 * t**2 - 1)
    np.testing.assert_allclose(signal.value(fine), fine**3 - fine, atol=1e-13)
    np.testing.assert_allclose(signal.derivative(fine), 3 * fine**2 - 1, atol=1e-13)


@pytest.mark.parametrize("make", [Signal.steps, Signal.lines, Signal.through])
@pytest.mark.parametrize(
    ("times", "values"), [([0, 0], [1, 2]), ([0, 1], [1]), ([0, np.nan], [1, 2]), ([0, 1], [1, np.inf]), ([], [])]
)
def test_samples_are_checked(make, times, values):
    with pytest.raises(BadInput, match="signal: "):
        make(times, values)


def test_text_is_no_signal():
    with pytest.raises(BadInput, match="rows of numbers"):
        Signal.constant("5 percent")
