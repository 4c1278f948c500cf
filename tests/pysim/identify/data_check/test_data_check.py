"""Every fault is put into a good log and must be found there; a good log must be left in peace."""

from dataclasses import replace

import numpy as np
import pytest

from pysim.excitation import Chirp, SteppedSineCommand
from pysim.identify.data_check import (
    Finding,
    FindingCode,
    check_dataset,
    clock,
    plateaus,
    share_near_nyquist,
    swing,
)
from pysim.io.prepare import DropOutliers, FillGaps, Flip, Rename, Resample, Scaled, prepared
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
) -> tuple[Finding, ...]:
    """Findings of a stepped sine of 5 Hz, 10 percent around 25 percent, with something changed."""
    cmd = sine(time=time) if cmd is None else cmd
    y = measured(0.9 * sine(time=time)) if y is None else y
    log = Record(time, np.column_stack([cmd, y]), ("cmd", "y"), ("%", "%"))
    record = MeasuredRecord("x.txt", "frequency-response", "fit", log, 25.0, 10.0, 5.0, command="cmd")
    record = replace(record, **told)  # type: ignore[arg-type]
    return check_dataset(Dataset("d", "-", "-", SIGNALS, (record,))).records[0].findings


def test_a_good_log_is_left_in_peace() -> None:
    assert found() == ()


@pytest.mark.parametrize(
    ("change", "code", "values"),
    [
        ({"frequency": 5.2}, FindingCode.FREQUENCY, {"value": 5.0, "told": 5.2}),
        ({"frequency": 50.0}, FindingCode.FREQUENCY, {"value": 5.0, "told": 50.0}),
        ({"offset": 26.0}, FindingCode.LEVEL, {"what": "offset", "value": 25.0, "told": 26.0, "unit": "%"}),
        ({"amplitude": 9.5}, FindingCode.LEVEL, {"what": "amplitude", "value": 10.0, "told": 9.5}),
        ({"cmd": np.clip(sine(), 16, 34)}, FindingCode.IMPURE, {"signal": "cmd"}),
        ({"cmd": np.sign(sine() - 25)}, FindingCode.IMPURE, {"signal": "cmd"}),
        ({"cmd": np.full(TIME.size, 25.0)}, FindingCode.STILL, {"signal": "cmd", "value": 25.0}),
        (
            {"y": np.clip(measured(0.9 * sine()), 15, 30)},
            FindingCode.CLIPPED,
            {"signal": "y", "low": 15.0, "high": 30.0},
        ),
        (
            {"frequency": 60.0, "cmd": sine(60.0)},
            FindingCode.ALIASED,
            {"harmonic": 3, "frequency": 60.0, "rate": 250.0},
        ),
    ],
)
def test_faults_of_a_sine_are_found(change: dict[str, object], code: FindingCode, values: dict[str, object]) -> None:
    (fault,) = [one for one in found(**change) if one.code is code]  # type: ignore[arg-type]
    for key, value in values.items():
        assert fault.values[key] == (pytest.approx(value, rel=1e-4) if isinstance(value, float) else value)


def test_the_level_of_a_chirp_is_read_off_its_extremes() -> None:
    sweep = 25 + 10 * np.sin(2 * np.pi * (0.5 + 5 * (TIME - 2)) * (TIME - 2))
    assert found(sweep, kind="chirp", frequency=None) == ()
    (level,) = found(sweep, kind="chirp", frequency=None, amplitude=8.0)
    assert (level.code, level.values["what"]) == (FindingCode.LEVEL, "amplitude")
    assert level.values["value"] == pytest.approx(9.9999, abs=1e-4)  # the tops fall between the samples


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
    assert [one.values["what"] for one in found(cmd, measured(cmd), time=time, offset=24.0, **told)] == ["offset"]


def test_too_few_periods() -> None:
    (few,) = [one for one in found(time=TIME[:75]) if one.code is FindingCode.FEW_PERIODS]
    assert few.values["periods"] == pytest.approx(1.5)
    assert found(time=TIME[:100]) == ()  # two periods, to the last sample


@pytest.mark.parametrize("kind", ["step", "stochastic", "other"])
def test_a_signal_that_stands_still_is_told_whatever_the_kind(kind: str) -> None:
    told = {"kind": kind, "frequency": None}
    for change, name in (({"cmd": np.full(TIME.size, 25.0)}, "cmd"), ({"y": np.full(TIME.size, 3.0)}, "y")):
        (still,) = found(**change, **told)  # type: ignore[arg-type]
        assert (still.code, still.values["signal"]) == (FindingCode.STILL, name)


def test_gaps_and_uneven_sampling() -> None:
    holes = np.delete(TIME, [*range(100, 120), 300])
    (gap,) = found(time=holes)
    assert gap.code is FindingCode.GAP
    assert dict(gap.values) == {"count": 2, "length": pytest.approx(0.084), "start": pytest.approx(2.396)}
    away = TIME + np.random.default_rng(2).uniform(0, 1e-3, TIME.size)
    (uneven,) = found(time=away)
    assert (uneven.code, uneven.cure) == (FindingCode.UNEVEN, (Resample(250.0),))
    assert uneven.values["jitter"] == pytest.approx(0.1, rel=0.1)


def test_times_in_ms_are_suspected() -> None:
    for time, rate in ((1000 * TIME, 0.25), (np.arange(501.0), 1.0)):  # the second is 1 kHz
        (slow,) = found(time=time, kind="other", frequency=None)
        assert (slow.code, slow.values["rate"]) == (FindingCode.SLOW_CLOCK, pytest.approx(rate))


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


def clipped(values: np.ndarray, low: float, high: float) -> int:
    """How many samples stand on plateaus."""
    return sum(stop - first for first, stop in plateaus(values, low, high))


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
    (folded,) = found(y=fast, kind="stochastic", frequency=None)
    assert (folded.code, folded.values["signal"]) == (FindingCode.FOLDED, "y")
    assert folded.values["share"] == pytest.approx(0.5, abs=0.01)


def test_tables_are_listed() -> None:
    table = FrequencyResponse(np.array([1.0, 2.0]), np.ones(2), np.zeros(2), SineTest(5.0, 1.0, "cmd", "y"), "t")
    record = MeasuredRecord("t.csv", "frequency-response-table", "fit", table, 5.0, 1.0)
    check = check_dataset(Dataset("d", "-", "-", SIGNALS, (record,)))
    assert (check.records[0].rows, check.records[0].clock, check.records[0].signals) == (2, None, ("cmd", "y"))
    assert check.findings == ()


def test_outliers_are_found_and_cured() -> None:
    y = measured(0.9 * sine())
    y[[200, 431]] += [20.0, -9.0]
    (far,) = found(y=y)
    assert (far.code, far.values["count"], far.cure) == (FindingCode.OUTLIERS, 2, (DropOutliers(signals=("y",)),))


def test_empty_cells_of_inputs_are_found_with_the_length_that_fills_them() -> None:
    x = measured(sine())
    x[[100, 101, 300]] = np.nan
    (empty,) = found(x)
    assert (empty.code, empty.values["count"]) == (FindingCode.EMPTY, 3)
    (fill,) = empty.cure
    assert isinstance(fill, FillGaps)
    assert 0.012 < fill.longest < 0.02  # from the sample ahead of two that are missing to the one behind, at 250 Hz


def test_an_output_is_looked_at_where_it_was_measured() -> None:
    """A fifth of its samples, as of a slower logger; there is nothing to cure."""
    y = measured(0.9 * sine())
    y[np.arange(y.size) % 5 > 0] = np.nan
    assert found(y=y) == ()
    y[200] += 200.0
    assert [one.code for one in found(y=y)] == [FindingCode.OUTLIERS]


def logs(*lengths: int) -> Dataset:
    """A log of so many samples each."""
    data = np.column_stack([sine(), measured(0.9 * sine())])
    parts = [Record(TIME[:n], data[:n], ("cmd", "y"), ("%", "%")) for n in lengths]
    records = [MeasuredRecord(f"{k}.txt", "other", "fit", part) for k, part in enumerate(parts)]
    return Dataset("d", "-", "-", SIGNALS, tuple(records))


@pytest.mark.parametrize(("lengths", "left"), [((12,), None), ((12, 15), None), ((501, 12), 1), ((12, 501, 15), 1)])
def test_short_logs_are_left_out_where_another_is_left(lengths: tuple[int, ...], left: int | None) -> None:
    data = logs(*lengths)
    short = check_dataset(data).findings
    assert [one.code for one in short] == [FindingCode.TOO_SHORT] * sum(n < 20 for n in lengths)
    steps = [step for one in short for step in one.cure]
    if left is None:
        assert steps == []
    else:
        assert len(prepared(data, steps).records) == left


def beside(y: np.ndarray, simulated: np.ndarray, unit: str = "%", to: str = "%") -> tuple[Finding, ...]:
    """What a model's answer shows of a log of noise through a lag."""
    signals = (SIGNALS[0], replace(SIGNALS[1], unit=unit))
    log = Record(TIME, np.column_stack([WAVE, y]), ("cmd", "y"), ("%", unit))
    answer = Record(TIME, simulated[:, None], ("y",), (to,))
    record = MeasuredRecord("x.txt", "other", "fit", log)
    return check_dataset(Dataset("d", "-", "-", signals, (record,)), {"x.txt": answer}).beside_model


WAVE = np.convolve(np.random.default_rng(7).normal(size=TIME.size), np.ones(25) / 25, "same")
ANSWER = 5 + np.convolve(WAVE, np.exp(-np.arange(100) / 20) / 20)[: TIME.size]
LOGGED = ANSWER + np.random.default_rng(8).normal(scale=0.02, size=TIME.size)


def test_a_log_that_follows_the_model_shows_nothing() -> None:
    assert beside(LOGGED, ANSWER) == ()
    assert beside(2 * LOGGED - 3, ANSWER) == ()  # a wrong parameter, and a wrong level
    assert beside(np.random.default_rng(9).normal(size=TIME.size), ANSWER) == ()  # follows nothing


def test_a_turned_sign_is_found() -> None:
    (turned,) = beside(-LOGGED, ANSWER)
    assert (turned.code, turned.cure) == (FindingCode.SIGN, (Flip(("y",)),))


@pytest.mark.parametrize("factor", [10.0, 60.0, 1000.0, 0.1, 1 / 60, 1e-3])
def test_a_slip_between_units_is_found_though_the_gain_is_not_right(factor: float) -> None:
    (slip,) = beside(1.4 * factor * LOGGED, ANSWER)
    (cure,) = slip.cure
    assert slip.code is FindingCode.FACTOR
    assert isinstance(cure, Scaled)
    assert cure.factor == pytest.approx(1 / factor)


SHAPE = np.roll(ANSWER, 150)  # as fast as the answer, and it does not follow it


@pytest.mark.parametrize("level", [0.0, 1e7])
@pytest.mark.parametrize("size", [0.3, 1.0, 4.0])
@pytest.mark.parametrize("factor", [1e5, 1e-5])
def test_a_far_slip_is_found_though_the_model_lacks_what_moves_the_signal(
    factor: float, size: float, level: float
) -> None:
    (slip,) = beside(size * factor * SHAPE + level, ANSWER - level, "Pa", "Pa")
    assert slip.code is FindingCode.FACTOR
    assert slip.cure == (Scaled("y", pytest.approx(1 / factor)),)
    assert slip.values["factor"] == pytest.approx(factor)


@pytest.mark.parametrize(
    ("y", "simulated"),
    [
        *((size * SHAPE, ANSWER) for size in (0.05, 0.3, 4.0, 30.0)),  # the effect of what the model lacks
        *((size * SHAPE, ANSWER) for size in (1e7, 1e-7, 1e2)),  # no units are so far apart
        (1e5 * SHAPE, 5 + 1e-9 * (LOGGED - ANSWER)),  # simulated to stand still, but for rounding
        (1e-5 * (LOGGED - ANSWER) + 3, ANSWER),  # stands still, but for noise
        (np.append(SHAPE[:-3], [1e5, -1e5, 1e5]), ANSWER),  # outliers
    ],
)
def test_another_size_is_no_slip(y: np.ndarray, simulated: np.ndarray) -> None:
    assert beside(y, simulated, "Pa", "Pa") == ()


def several(
    measured: list[np.ndarray], simulated: list[np.ndarray], unit: str = "Pa"
) -> tuple[Dataset, dict[str, Record]]:
    """Logs run0, run1, ... beside a model's answers."""
    signals = (SIGNALS[0], replace(SIGNALS[1], unit=unit))
    records, answers = [], {}
    for k, (y, own) in enumerate(zip(measured, simulated, strict=True)):
        log = Record(TIME, np.column_stack([WAVE, y]), ("cmd", "y"), ("%", unit))
        records.append(MeasuredRecord(f"run{k}.txt", "other", "fit", log))
        answers[f"run{k}.txt"] = Record(TIME, own[:, None], ("y",), (unit,))
    return Dataset("d", "-", "-", signals, tuple(records)), answers


STILL = 5 + 1e-3 * (LOGGED - ANSWER)
SLOW = 5 + np.sin(2 * np.pi * 0.7 * TIME)
GAINS = [1.0, 0.6, 1.3, 0.8]


@pytest.mark.parametrize("wrong", [(2,), (0, 3), (0, 1, 2), (0, 1, 2, 3)])
@pytest.mark.parametrize("factor", [-1.0, 1e-5, -1e3])
def test_each_log_is_judged_by_itself(wrong: tuple[int, ...], factor: float) -> None:
    """The first one swings ten times as far as the others; two more tell nothing."""
    own = [10 * ANSWER, ANSWER, SLOW, ANSWER[::-1], ANSWER, STILL]
    noise = LOGGED - ANSWER
    logged = [gain * one + noise for gain, one in zip(GAINS, own, strict=False)] + [STILL, LOGGED]
    for k in wrong:
        logged[k] = factor * logged[k]
    data, answers = several(logged, own)
    found = check_dataset(data, answers).beside_model
    wanted = [FindingCode.SIGN] * (factor < 0) + [FindingCode.FACTOR] * (abs(factor) != 1)
    assert [one.code for one in found] == wanted
    names = tuple(f"run{k}" for k in wrong) if len(wrong) < 4 else ()
    for one in found:
        (cure,) = one.cure
        assert isinstance(cure, Flip | Scaled)
        assert cure.logs == names
        assert one.values.get("logs", "") == ", ".join(names)
        assert one.source == f"run{wrong[0]}.txt"
    mended = prepared(data, [step for one in found for step in one.cure])
    assert check_dataset(mended, answers).beside_model == ()
    for k in range(4):
        assert isinstance(mended.records[k].data, Record)
        np.testing.assert_allclose(mended.records[k].data["y"], logged[k] / (factor if k in wrong else 1), rtol=1e-9)


def test_logs_of_a_model_that_hardly_follows_tell_a_sign_by_as_much_as_each_other() -> None:
    """Correlations of 0.72 and of 0.63: none of the latter is turned along with the former."""
    own = ANSWER - ANSWER.mean()
    rest = np.random.default_rng(4).normal(size=TIME.size)
    rest -= rest.mean() + own * (rest @ own) / (own @ own)
    rest *= np.sqrt((own @ own) / (rest @ rest))
    logged = [r * own + np.sqrt(1 - r**2) * rest for r in (-0.63, 0.63, -0.72, 0.67, 0.1, -0.3)]
    data, answers = several(logged, [ANSWER] * 6)
    (turned,) = check_dataset(data, answers).beside_model
    assert turned.cure == (Flip(("y",), ("run0", "run2")),)


def test_a_resonance_elsewhere_is_no_turned_sign() -> None:
    """Half a period late, or nearly, is what a wrong eigenfrequency makes of a sine; of nothing else it does so."""
    tones = [np.sin(2 * np.pi * hz * TIME) for hz in (2.0, 5.0, 9.0)]
    late = np.sin(2 * np.pi * 5 * TIME - np.radians(145))
    data, answers = several([tones[0], late, tones[2], LOGGED], [*tones, ANSWER])
    assert check_dataset(data, answers).beside_model == ()
    data, answers = several([tones[0], -tones[1], tones[2], LOGGED], [*tones, ANSWER])
    (turned,) = check_dataset(data, answers).beside_model
    assert turned.cure == (Flip(("y",), ("run1",)),)


def test_a_plant_that_rests_in_one_log_is_measured_right_there() -> None:
    """In its dead band it creeps, where the model moves a thousand times as far; not a hundred thousand times."""
    for size, codes in ((1 / 60, []), (1e-5, [FindingCode.FACTOR])):
        data, answers = several([LOGGED, size * SHAPE], [ANSWER, ANSWER])
        assert [one.code for one in check_dataset(data, answers).beside_model] == codes


def test_volts_are_calibrated_by_the_model() -> None:
    (volts,) = beside(0.08 * LOGGED + 0.5, 1e-3 * ANSWER, "V", "m")
    (cure,) = volts.cure
    assert volts.code is FindingCode.QUANTITY
    assert isinstance(cure, Scaled)
    assert (cure.unit, cure.of) == ("m", "V")
    assert cure.factor == pytest.approx(1e-3 / 0.08, rel=0.02)
    assert cure.offset == pytest.approx(-0.5 * 1e-3 / 0.08, rel=0.05)


def test_swapped_columns_are_found() -> None:
    other = np.convolve(WAVE, np.ones(40) / 40)[: TIME.size] * np.sin(TIME)
    signals = (SIGNALS[0], *(replace(SIGNALS[1], name=name, variable=name) for name in ("y", "z")))
    log = Record(TIME, np.column_stack([WAVE, other, ANSWER]), ("cmd", "y", "z"), ("%",) * 3)
    answer = Record(TIME, np.column_stack([ANSWER, other]), ("y", "z"), ("%", "%"))
    data = Dataset("d", "-", "-", signals, (MeasuredRecord("x.txt", "other", "fit", log),))
    (swapped,) = check_dataset(data, {"x.txt": answer}).beside_model
    assert (swapped.code, swapped.cure) == (FindingCode.SWAPPED, (Rename({"y": "z", "z": "y"}),))
