"""Every fault is put into a good log and must be found there; a good log must be left in peace."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.excitation import Chirp, SteppedSineCommand
from pysim.identify.data_check import check_dataset, clipped, clock, share_near_nyquist, swing
from pysim.types import Dataset, FrequencyResponse, MeasuredRecord, MeasuredSignal, Record, SineTest

SIGNALS = (
    MeasuredSignal("cmd", "input", "%", "", "cmd"),
    MeasuredSignal("y", "output", "%", "", "y", noise=0.1, resolution=0.05),
)
TIME = 2.0 + np.arange(501) / 250


def sine(frequency: float = 5.0, offset: float = 25.0, amplitude: float = 10.0, time: np.ndarray = TIME) -> np.ndarray:
    return offset + amplitude * np.sin(2 * np.pi * frequency * (time - 2.0))


def measured(values: np.ndarray, seed: int = 1) -> np.ndarray:
    noisy = values + np.random.default_rng(seed).normal(0, 0.1, values.size)
    return np.round(noisy / 0.05) * 0.05


def found(
    cmd: np.ndarray | None = None, y: np.ndarray | None = None, time: np.ndarray = TIME, **told: object
) -> tuple[str, ...]:
    """Warnings of a stepped sine of 5 Hz, 10 percent around 25 percent, with something changed."""
    cmd = sine(time=time) if cmd is None else cmd
    y = measured(0.9 * sine(time=time)) if y is None else y
    log = Record(time, np.column_stack([cmd, y]), ("cmd", "y"), ("%", "%"))
    record = MeasuredRecord("x.txt", "frequency-response", "fit", log, 25.0, 10.0, 5.0, command="cmd")
    record = replace(record, **told)  # type: ignore[arg-type]
    return check_dataset(Dataset("d", "-", "-", SIGNALS, (record,))).records[0].warnings


def test_a_good_log_is_left_in_peace() -> None:
    assert found() == ()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"frequency": 5.2}, "cmd swings at 5 Hz, not at 5.2 Hz"),
        ({"frequency": 50.0}, "cmd swings at 5 Hz, not at 50 Hz"),
        ({"offset": 26.0}, "offset of the logged cmd is 25, not 26 % as told"),
        ({"amplitude": 9.5}, "amplitude of the logged cmd is 10, not 9.5 % as told"),
        ({"cmd": np.clip(sine(), 16, 34)}, "cmd is no pure sine"),
        ({"cmd": np.sign(sine() - 25)}, "cmd is no pure sine"),
        ({"cmd": np.full(TIME.size, 25.0)}, "cmd stands still at 25 %"),
        ({"y": np.clip(measured(0.9 * sine()), 15, 30)}, "stand at its smallest or largest value (15, 30 %): clipped?"),
        ({"frequency": 60.0, "cmd": sine(60.0)}, "aliasing: 3 x 60 Hz is beyond half the sampling rate, 250 Hz"),
    ],
)
def test_faults_of_a_sine_are_found(change: dict[str, object], words: str) -> None:
    warnings = found(**change)  # type: ignore[arg-type]
    assert any(words in text for text in warnings), warnings


def test_the_level_of_a_chirp_is_read_off_its_extremes() -> None:
    sweep = 25 + 10 * np.sin(2 * np.pi * (0.5 + 5 * (TIME - 2)) * (TIME - 2))
    assert found(sweep, kind="chirp", frequency=None) == ()
    assert found(sweep, kind="chirp", frequency=None, amplitude=8.0) == (
        "amplitude of the logged cmd is 9.9999, not 8 % as told",  # the tops fall between the samples
    )


@pytest.mark.parametrize(
    ("excitation", "told"),
    [
        (SteppedSineCommand(25.0, 10.0, 5.0, periods=20), {}),
        (Chirp(25.0, 10.0, 0.5, 20.0, 20.0), {"kind": "chirp", "frequency": None}),
    ],
)
def test_a_lead_in_is_no_fault(excitation: SteppedSineCommand | Chirp, told: dict[str, object]) -> None:
    time = np.arange(int(250 * excitation.duration)) / 250
    cmd = excitation.signal().value(time)
    assert found(cmd, np.round(0.9 * cmd / 0.05) * 0.05, time=time, **told) == ()
    assert [text.split(" of ")[0] for text in found(cmd, measured(cmd), time=time, offset=24.0, **told)] == ["offset"]


def test_too_few_periods() -> None:
    assert any(text.startswith("1.5 periods of 5 Hz: too few") for text in found(time=TIME[:75]))
    assert found(time=TIME[:100]) == ()  # two periods, to the last sample


@pytest.mark.parametrize("kind", ["step", "stochastic", "other"])
def test_a_signal_that_stands_still_is_told_whatever_the_kind(kind: str) -> None:
    told = {"kind": kind, "frequency": None}
    assert found(np.full(TIME.size, 25.0), **told) == ("cmd stands still at 25 %",)  # type: ignore[arg-type]
    assert found(y=np.full(TIME.size, 3.0), **told) == ("y stands still at 3 %",)  # type: ignore[arg-type]


def test_gaps_and_uneven_sampling() -> None:
    holes = np.delete(TIME, [*range(100, 120), 300])
    assert found(time=holes) == ("2 gaps in time, the longest of 0.084 s after 2.396 s",)
    away = TIME + np.random.default_rng(2).uniform(0, 1e-3, TIME.size)
    assert found(time=away) == ("uneven sampling: the intervals vary by 10 percent",)


def test_times_in_ms_are_suspected() -> None:
    words = 'samples per second: if time is in ms, write time_unit = "ms" below [dataset]'
    assert found(time=1000 * TIME, kind="other", frequency=None) == (f"0.25 {words}",)
    assert found(time=np.arange(501.0), kind="other", frequency=None) == (f"1 {words}",)  # 1 kHz


def test_printed_times_are_not_uneven() -> None:
    base = clock(np.round(np.arange(700) / 70, 3))
    assert base.rate == pytest.approx(70.0, rel=1e-4)
    assert base.jitter < 0.005
    shaken = np.arange(700) / 70 + np.random.default_rng(1).normal(0, 1e-3, 700)
    assert clock(np.round(shaken, 3)).jitter == pytest.approx(0.07 * np.sqrt(2), rel=0.1)


def test_the_clock_of_a_log() -> None:
    base = clock(np.array([1.0, 1.5, 2.0, 4.0, 4.5]))
    assert (base.start, base.duration, base.rate, base.jitter, base.gaps) == (1.0, 3.5, 2.0, 0.0, ((2.0, 2.0),))


@pytest.mark.parametrize("frequency", [0.7, 5.0, 37.0])
@pytest.mark.parametrize("thought", [1.0, 1.03, 3.0])
def test_the_swing_is_read_off_whatever_it_is_thought_to_be(frequency: float, thought: float) -> None:
    time = np.arange(1000) / 250
    values = 3 + 2 * np.sin(2 * np.pi * frequency * time + 0.4) + np.random.default_rng(3).normal(0, 0.02, time.size)
    result = swing(time, values, thought * frequency)
    # five standard deviations of a frequency estimate: sqrt(6 / n) s / (pi T A)
    assert result.frequency == pytest.approx(frequency, abs=5 * np.sqrt(6 / 1000) * 0.02 / (np.pi * 4 * 2))
    assert (result.amplitude, result.offset) == (pytest.approx(2, abs=5e-3), pytest.approx(3, abs=5e-3))
    assert result.impurity == pytest.approx(0.02 / np.sqrt(2), rel=0.15)


def test_clipping_is_told_from_what_looks_like_it() -> None:
    moving = measured(20 * np.sin(2 * np.pi * 3 * TIME))
    cut = np.clip(moving, -15, 18)
    assert clipped(cut, -15, 18) == np.sum((cut == -15) | (cut == 18))  # each plateau here is longer than three samples
    assert clipped(moving, moving.min(), moving.max()) == 0
    slow = np.round(10 * np.sin(2 * np.pi * 0.1 * TIME) / 0.05) * 0.05  # flat top of coarse steps, no noise
    assert clipped(slow, slow.min(), slow.max()) == 0
    settled = np.round((1 - np.exp(-5 * (TIME - 2))) / 0.01) * 0.01  # comes to rest at its largest value
    assert clipped(settled, settled.min(), settled.max()) == 0
    assert clipped(np.ones(50), 1.0, 1.0) == 0
    smooth = np.clip(20 * np.sin(2 * np.pi * 3 * TIME), -15, 18)  # no noise, no steps
    assert clipped(smooth, -15, 18) == np.sum((smooth == -15) | (smooth == 18))


def test_power_near_nyquist() -> None:
    random = np.random.default_rng(5)
    white = random.normal(0, 1, 20_000)
    assert share_near_nyquist(white, 0.0) == pytest.approx(0.2, abs=0.02)  # a fifth of the band holds a fifth
    assert share_near_nyquist(white, 1.0) == 0.0  # all of it is noise
    low = 50 * np.sin(2 * np.pi * 3 * np.arange(20_000) / 250)
    assert share_near_nyquist(low + white, 1.0) < 1e-3
    high = 50 * np.sin(2 * np.pi * 110 * np.arange(20_000) / 250)
    assert share_near_nyquist(low + high, 0.0) == pytest.approx(0.5, abs=1e-6)
    assert share_near_nyquist(low[:10], 0.0) == 0.0


def test_waves_are_looked_at_for_power_that_folds() -> None:
    fast = measured(25 + 10 * np.sin(2 * np.pi * 115 * TIME) + 10 * np.sin(2 * np.pi * 4 * TIME))
    warnings = found(y=fast, kind="stochastic", frequency=None)
    assert warnings == (
        "50 percent of the variance of y lie above 80 percent of half the sampling rate: faster parts fold back",
    )


def test_tables_are_listed() -> None:
    table = FrequencyResponse(np.array([1.0, 2.0]), np.ones(2), np.zeros(2), SineTest(5.0, 1.0, "cmd", "y"), "t")
    record = MeasuredRecord("t.csv", "frequency-response-table", "fit", table, 5.0, 1.0)
    check = check_dataset(Dataset("d", "-", "-", SIGNALS, (record,)))
    assert (check.records[0].rows, check.records[0].clock, check.records[0].signals) == (2, None, ("cmd", "y"))
    assert check.warnings == ()
