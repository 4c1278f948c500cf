"""Commands as functions of time, from their logs."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from pysim.excitation import Chirp, LeadIn, Step, SteppedSineCommand, StochasticWave
from pysim.excitation import PiersonMoskowitz as Sea
from pysim.identify import logged_command
from pysim.identify.logged.command import jumps
from pysim.types import BadInput, FrequencyResponse, MeasuredRecord, Record, SineTest
from pysim.types.record_kind import Command
from tests.pysim.identify.logs import log


@pytest.mark.parametrize(
    ("test", "kind"),
    [
        (SteppedSineCommand(25.0, 10.0, 30.0, periods=36), "frequency-response"),
        (Chirp(50.0, 10.0, 0.1, 30.0, 30.0), "chirp"),
    ],
    ids=["sine", "chirp"],
)
def test_the_whole_command_comes_back_with_its_rate(test: SteppedSineCommand | Chirp, kind: str) -> None:
    f = test.frequency if isinstance(test, SteppedSineCommand) else None
    signal = logged_command(log(test, kind, frequency=f, first=0.0, last=test.duration), "cmd")
    t = np.random.default_rng(1).uniform(0.0, test.duration, 5000)
    true = test.signal()
    corner = 0.004  # straight lines between samples cut the lead-in's corners, at one sample each
    corners = np.array([0.5, 1.0, test.end, test.duration])
    away = np.min(np.abs(t[:, None] - corners), axis=1) > corner
    np.testing.assert_allclose(signal.value(t)[away], true.value(t)[away], atol=3e-5)
    inside = (t > 2.0) & (t < test.end - corner)
    np.testing.assert_allclose(signal.derivative(t)[inside], true.derivative(t)[inside], atol=3e-5 * 2 * np.pi * 30)
    jumps, _ = signal.breaks()
    assert not jumps[np.abs(signal.starts - test.end) > 2 * corner].any()


def test_a_wave_alone_is_one_piece_and_holds_its_first_value_before() -> None:
    signal = logged_command(
        log(SteppedSineCommand(25.0, 10.0, 1.0, periods=3), "frequency-response", frequency=1.0), "cmd"
    )
    assert signal.starts.tolist() == [2.0]
    assert signal.value(np.array([0.0, 2.25])) == pytest.approx([25.0, 35.0], abs=1e-5)


@pytest.mark.parametrize("kind", ["stochastic", "multisine", "other"])
def test_anything_else_runs_by_the_natural_spline(kind: str) -> None:
    record = log(StochasticWave(Sea(100.0, 1.0), 10.0, seed=3), kind)
    signal = logged_command(record, "cmd")
    spline = CubicSpline(record.data.time, record.data["cmd"], bc_type="natural")  # type: ignore[union-attr,index]
    t = np.linspace(2.0, 11.9, 3001)
    np.testing.assert_allclose(signal.value(t), spline(t), atol=1e-9)
    np.testing.assert_allclose(signal.derivative(t), spline(t, 1), atol=1e-6)


@pytest.mark.parametrize(("back", "height"), [(True, 18.0), (False, -7.0)])
def test_a_step_jumps_where_the_log_shows_it(back: bool, height: float) -> None:
    step = Step(5.0, height, 2.0, back, LeadIn(0.5, 0.3, 0.5, ramp_down=0.0))
    record = log(step, "step", first=0.0, last=5.2)
    signal, true = logged_command(record, "cmd"), step.signal()
    t = np.random.default_rng(2).uniform(0.0, 5.2, 4000)
    ramp = (t > 0.5) & (t < 0.81)  # held from sample to sample: late by one at most
    np.testing.assert_allclose(signal.value(t)[~ramp], true.value(t)[~ramp], atol=1e-3)
    late = np.max(np.diff(record.data.time)) * 5.0 / 0.3  # type: ignore[union-attr]
    np.testing.assert_allclose(signal.value(t)[ramp], true.value(t)[ramp], atol=1.01 * late)
    jumps, _ = signal.breaks()
    edges = [1.3, 3.3] if back else [1.3]
    np.testing.assert_allclose(signal.starts[jumps & (signal.starts > 0.81)], edges, atol=1e-9)


def test_a_wave_that_starts_with_a_jump_is_smooth_behind_it() -> None:
    def true(t: np.ndarray) -> np.ndarray:
        return np.where(t < 2.0, 0.0, 4 + 3 * np.sin(2 * np.pi * 0.8 * (t - 2.0)))

    time = np.arange(1000) / 250
    record = MeasuredRecord("wave.txt", "other", "fit", Record(time, true(time)[:, None], ("cmd",), ("%",)))
    signal, t = logged_command(record, "cmd"), np.linspace(0.0, time[-1], 5001)
    np.testing.assert_allclose(signal.value(t), true(t), atol=1e-3)
    jumps, _ = signal.breaks()
    np.testing.assert_allclose(signal.starts[jumps], [2.0])


@pytest.mark.parametrize("digit", [1e-3, 1e-2])
@pytest.mark.parametrize(("hz", "limit"), [(0.2, 2.0), (0.8, 2.0), (0.2, 1.0)])  # the last one saturates
@pytest.mark.parametrize("step", [0.0, 0.5])
def test_a_digit_of_a_rounded_command_is_no_jump(digit: float, hz: float, limit: float, step: float) -> None:
    """A sine that is rounded, saturates or not, and steps at its end or not."""
    time = np.arange(1000) / 200
    true = np.clip(2.0004 * np.sin(2 * np.pi * hz * time), -limit, limit)
    true[900:] = true[899] + step
    values = np.round(true / digit) * digit
    assert jumps(values) == ([900] if step else [])
    record = MeasuredRecord("x.txt", "other", "fit", Record(time, values[:, None], ("cmd",), ("V",)))
    signal, t = logged_command(record, "cmd"), np.linspace(0.0, time[-1], 7001)
    away = np.abs(t - time[899]) > 0.006
    assert np.abs(signal.value(t) - np.interp(t, time, true))[away].max() < 2 * digit + 2e-3


@pytest.mark.parametrize("height", [1.0, 1e-3])
def test_steps_of_equal_height_jump(height: float) -> None:
    """A staircase, which has one digit only, and a small step behind a large one."""
    stairs = height * np.repeat(np.arange(40.0) % 12, 20)
    assert jumps(stairs) == list(range(20, 800, 20))
    assert jumps(height * np.repeat([0.0, 5.0, 5.01], 20)) == [20, 40]


def test_a_noisy_jump_is_left_to_the_spline() -> None:
    record = log(Step(0.0, 10.0, 2.0, False), "other", first=1.0, last=3.9)
    rows = record.data.values + 1e-3 * np.random.default_rng(3).standard_normal(record.data.values.shape)  # type: ignore[union-attr]
    noisy = replace(record, data=Record(record.data.time, rows, record.data.names, record.data.units))  # type: ignore[union-attr]
    assert not logged_command(noisy, "cmd").breaks()[0].any()


def test_refuses_tables_and_unknown_columns() -> None:
    record = log(Chirp(50.0, 10.0, 0.1, 30.0, 30.0), "chirp")
    with pytest.raises(BadInput, match="no signal 'alphaCMD'"):
        logged_command(record, "alphaCMD")
    table = FrequencyResponse([1.0], [1.0], [0.0], SineTest(0.0, 1.0, "u", "y"), "measured")  # type: ignore[arg-type]
    with pytest.raises(BadInput, match="only a log over time"):
        logged_command(MeasuredRecord("a.txt", "frequency-response-table", "fit", table), "cmd")


@pytest.mark.parametrize(
    ("hold", "kind", "between"),
    [
        (None, "other", (0.575, 1.15)),
        (None, "step", (0.0, 1.0)),
        (Command.STEPS, "other", (0.0, 1.0)),
        (Command.LINES, "other", (0.5, 1.0)),
        (Command.SPLINE, "step", (0.575, 1.15)),
    ],
)
def test_a_command_runs_between_samples_as_it_is_held(
    hold: Command | None, kind: str, between: tuple[float, float]
) -> None:
    """Samples 0, 1, 1, 0 at 0 ... 3 s, asked at 0.5 and 1.5 s; the natural spline's curvature is -1.2 at both ones."""
    time, values = np.arange(4.0), np.array([0.0, 1.0, 1.0, 0.0])
    data = Record(time, values[:, None], ("cmd",), ("1",))
    signal = logged_command(MeasuredRecord("a.txt", kind, "fit", data), "cmd", hold)
    np.testing.assert_allclose(signal.value(time), values, atol=1e-12)
    np.testing.assert_allclose(signal.value(np.array([0.5, 1.5])), between, rtol=1e-12)


def test_a_held_command_breaks_only_where_it_changes() -> None:
    data = Record(np.arange(5.0), np.array([[0.0], [0.0], [2.0], [2.0], [1.0]]), ("cmd",), ("1",))
    signal = logged_command(MeasuredRecord("a.txt", "step", "fit", data), "cmd")
    assert signal.starts.tolist() == [0.0, 2.0, 4.0]
