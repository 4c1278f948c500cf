"""Every step of the preparation on signals whose answer is a formula."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.io.prepare import (
    STEPS,
    Delay,
    Detrend,
    DropOutliers,
    Exclude,
    FillGaps,
    Flip,
    HoldOut,
    LowPass,
    Rename,
    Resample,
    Scaled,
    Split,
    Trim,
    call,
    is_off,
    prepared,
    step_of,
    step_typed,
    typed,
    values_of,
)
from pysim.io.toml_section import Section
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record
from pysim.types.record_kind import Command

Array = NDArray[np.float64]
SIGNALS = (MeasuredSignal("u", "input", "V", "u", "u"), MeasuredSignal("y", "output", "m", "y", "y", noise=0.1))
TIME = np.arange(2000) / 1000


def dataset(time: Array, *columns: Array, signals: tuple[MeasuredSignal, ...] = SIGNALS, **more: Any) -> Dataset:
    """One log of u and y, or of y alone beside a u of zeros."""
    own = columns if len(columns) == len(signals) else (np.zeros(time.size), *columns)
    log = Record(time, np.column_stack(own), tuple(s.name for s in signals), tuple(s.unit for s in signals))
    return Dataset("d", "", "", signals, (MeasuredRecord("run.csv", "other", "fit", log, **more),))


def y_of(data: Dataset, record: int = 0) -> tuple[Array, Array]:
    log = data.records[record].data
    assert isinstance(log, Record)
    return log.time, log["y"]


def sine(time: Array, hz: float, size: float = 1.0) -> Array:
    return np.asarray(size * np.sin(2 * np.pi * hz * time))


def test_a_delayed_sine_is_the_sine_of_a_later_time() -> None:
    time, y = y_of(Delay("y", 0.0123).apply(dataset(TIME, sine(TIME, 30.0))))
    assert (time[0], time[-1]) == pytest.approx((0.013, TIME[-1]))
    np.testing.assert_allclose(y[4:], sine(time - 0.0123, 30.0)[4:], atol=1e-6)
    time, y = y_of(Delay("y", -0.0123).apply(dataset(TIME, sine(TIME, 30.0))))
    np.testing.assert_allclose(y[:-4], sine(time + 0.0123, 30.0)[:-4], atol=1e-6)


def test_a_held_command_is_delayed_by_whole_steps() -> None:
    signals = (MeasuredSignal("u", "input", "V", "u", "u", hold=Command.STEPS), SIGNALS[1])
    steps = np.floor(TIME * 10)
    data = Delay("u", 0.05).apply(dataset(TIME, steps, np.zeros(TIME.size), signals=signals))
    log = data.records[0].data
    assert isinstance(log, Record)
    np.testing.assert_array_equal(log["u"], np.floor((log.time - 0.05) * 10 + 1e-9))


@pytest.mark.parametrize(("hz", "left"), [(20.0, 1.0), (39.0, 1.0), (60.0, 0.0), (450.0, 0.0)])
def test_resampled_sines_stay_below_the_new_nyquist_frequency_and_vanish_above(hz: float, left: float) -> None:
    long = np.arange(8000) / 1000
    time, y = y_of(Resample(100.0).apply(dataset(long, sine(long, hz))))
    np.testing.assert_allclose(np.diff(time), 0.01, rtol=1e-9)
    inner = slice(100, -100)  # the mirrored ends are no sine
    np.testing.assert_allclose(y[inner], left * sine(time, hz)[inner], atol=2e-3)


def test_a_faster_rate_goes_through_every_sample() -> None:
    time, y = y_of(Resample(4000.0).apply(dataset(TIME, sine(TIME, 50.0))))
    np.testing.assert_allclose(y[::4], sine(TIME, 50.0), atol=1e-12)
    np.testing.assert_allclose(y[100:-100], sine(time, 50.0)[100:-100], atol=1e-6)


def test_an_uneven_clock_becomes_even() -> None:
    rng = np.random.default_rng(1)
    uneven = TIME + 1e-4 * rng.uniform(-1, 1, TIME.size)
    time, y = y_of(Resample(1000.0).apply(dataset(uneven, sine(uneven, 20.0))))
    np.testing.assert_allclose(y[10:-10], sine(time, 20.0)[10:-10], atol=1e-5)


def test_a_low_pass_has_the_gain_it_says_and_no_phase() -> None:
    long = np.arange(8000) / 1000
    for hz in (5.0, 25.0, 40.0):
        time, y = y_of(LowPass(25.0).apply(dataset(long, sine(long, hz))))
        gain = 1 / (1 + (hz / 25.0) ** 8)
        np.testing.assert_allclose(y[1000:-1000], gain * sine(time, hz)[1000:-1000], atol=1e-3)


def test_noise_falls_as_a_filter_says() -> None:
    noise = np.random.default_rng(2).normal(scale=0.1, size=20000)
    data = LowPass(50.0).apply(dataset(np.arange(20000) / 1000, noise))
    assert np.std(y_of(data)[1]) == pytest.approx(data.signal("y").noise, rel=0.05)


def test_noise_stays_where_nothing_is_filtered() -> None:
    noise = np.random.default_rng(2).normal(scale=0.1, size=20000)
    data = dataset(np.arange(20000) / 1000, noise)
    assert [Resample(hz).apply(data).signal("y").noise for hz in (1000.0, 1100.0)] == [0.1, 0.1]
    slower = Resample(500.0).apply(data)
    assert np.std(y_of(slower)[1]) == pytest.approx(slower.signal("y").noise, rel=0.05)


@pytest.mark.parametrize("order", [0, 1, 2])
def test_a_polynomial_is_taken_off_whole(order: int) -> None:
    y = sum(3.0 * TIME**k for k in range(order + 1))
    _, left = y_of(Detrend(("y",), order).apply(dataset(TIME + 70, np.asarray(y))))
    np.testing.assert_allclose(left, 0, atol=1e-11)


def test_scales_and_signs() -> None:
    data = dataset(TIME, np.ones(TIME.size), 2 * np.ones(TIME.size), command="u", offset=3.0, amplitude=0.5)
    flipped = Flip(("u", "y")).apply(data)
    assert (flipped.records[0].offset, flipped.records[0].amplitude) == (-3.0, 0.5)
    assert y_of(flipped)[1][0] == -2.0
    bar = Scaled("y", 50.0, 1.0, "bar", "mm").apply(data)  # of a position in mm: 2000 mm are 100,001 bar
    assert bar.signal("y").unit == "Pa"
    assert y_of(bar)[1][0] == pytest.approx(1e5 * (50.0 * 2000 + 1.0))
    assert bar.signal("y").noise == pytest.approx(0.1 * 1e3 * 50 * 1e5)
    with pytest.raises(BadInput, match="no quantity in bar"):
        Scaled("y", 2.0, of="bar").apply(data)


def test_signs_and_scales_of_some_logs_only() -> None:
    one = dataset(TIME, np.ones(TIME.size), 2 * np.ones(TIME.size), command="u", offset=3.0, amplitude=0.5)
    names = ("run1", "run2", "run3")
    data = replace(one, records=tuple(replace(one.records[0], source=f"{name}.csv") for name in names))

    def seen(step: Flip | Scaled) -> list[tuple[float, float, float | None]]:
        after = step.apply(data)
        assert after.signals == data.signals  # which stand for the other logs too
        logs = [record.data for record in after.records]
        return [
            (log["u"][0], log["y"][0], record.offset)  # type: ignore[index]
            for log, record in zip(logs, after.records, strict=True)
        ]

    assert seen(Flip(("y",), ("run2",))) == [(1, 2, 3), (1, -2, 3), (1, 2, 3)]
    assert seen(Flip(("u", "y"), ("run1", "run3.csv"))) == [(-1, -2, -3), (1, 2, 3), (-1, -2, -3)]
    assert seen(Scaled("y", 10.0, 1.0, logs=("run3",))) == [(1, 2, 3), (1, 2, 3), (1, 21, 3)]
    with pytest.raises(BadInput, match="no log 'run4'"):
        Flip(("y",), ("run4",)).apply(data)
    with pytest.raises(BadInput, match="in the other logs"):
        Scaled("y", 10.0, unit="bar", of="m", logs=("run3",)).apply(data)


def test_two_signals_swap_their_names() -> None:
    data = Rename({"u": "y", "y": "u"}).apply(dataset(TIME, TIME, -TIME, command="u"))
    assert (data.signals[0].name, data.signals[0].variable, data.records[0].command) == ("y", "y", "y")
    np.testing.assert_array_equal(y_of(data)[1], TIME)
    plain = dataset(TIME, TIME)
    shown = {"u": "valve.u", "y": "cylinder.y"}
    named = replace(plain, signals=tuple(replace(one, variable=shown[one.name]) for one in plain.signals))
    swapped = Rename({"u": "y", "y": "u"}).apply(named)
    assert {one.name: one.variable for one in swapped.signals} == shown  # else the swap would change nothing
    with pytest.raises(BadInput, match="two signals would be called 'y'"):
        Rename({"u": "y"}).apply(dataset(TIME, TIME))


def test_outliers_go_and_steps_stay() -> None:
    clean = sine(TIME, 10.0) + (TIME > 1.0)
    noisy = clean + np.random.default_rng(3).normal(scale=0.01, size=TIME.size)
    spoilt = noisy.copy()
    wrong = [3, 500, 501, 1500, 1994]
    spoilt[wrong] += [2.0, -1.5, -1.4, 0.5, -2.0]
    data = dataset(TIME, spoilt, spoilt)
    log = DropOutliers(signals=("u", "y")).apply(data).records[0].data
    assert isinstance(log, Record)
    for name in ("u", "y"):
        assert set(np.flatnonzero(log[name] != spoilt)) == set(wrong)
    assert np.isnan(log["y"][wrong]).all()
    np.testing.assert_allclose(log["u"], clean, atol=0.1)


@pytest.mark.parametrize("hz", [10.0, 40.0, 100.0])
def test_a_clean_sine_has_no_outliers(hz: float) -> None:
    data = dataset(TIME, sine(TIME, hz))
    np.testing.assert_array_equal(y_of(DropOutliers(5.0).apply(data))[1], y_of(data)[1])


def test_a_low_pass_of_one_signal_needs_the_samples_of_that_alone() -> None:
    lacking = np.where(TIME == 0.5, np.nan, sine(TIME, 10.0))
    found = LowPass(50.0, ("u",)).apply(dataset(TIME, sine(TIME, 10.0), lacking)).records[0].data
    assert isinstance(found, Record)
    np.testing.assert_array_equal(found["y"], lacking)
    with pytest.raises(BadInput, match="y lacks 1 sample"):
        LowPass(50.0).apply(dataset(TIME, sine(TIME, 10.0), lacking))


def test_short_gaps_of_inputs_are_filled_and_long_ones_cut() -> None:
    u = 2 * TIME
    u[[100, 101]] = np.nan
    kept = np.r_[0:400, 403:1000, 1100:2000]
    data = FillGaps(0.005).apply(dataset(TIME[kept], u[kept], TIME[kept], begin=50.0))
    assert [record.source for record in data.records] == ["run~1.csv", "run~2.csv"]
    assert [(r.begin, r.initial) for r in data.records] == [(50.0, None), (pytest.approx(51.1), "estimate")]
    for record, first, stop in ((0, 0, 1000), (1, 1100, 2000)):
        log = data.records[record].data
        assert isinstance(log, Record)
        np.testing.assert_allclose(log.time, TIME[first:stop], atol=1e-12)
        np.testing.assert_allclose(log["u"], 2 * TIME[first:stop], atol=1e-12)
        added = [400, 401, 402] if record == 0 else []  # where time itself had a gap, no output was measured
        assert np.flatnonzero(np.isnan(log["y"])).tolist() == added


def test_outputs_are_filled_where_they_are_named_only() -> None:
    """What is made up would be fitted as if it had been measured."""
    y = TIME**2
    y[[100, 101, 300]] = np.nan
    np.testing.assert_array_equal(y_of(FillGaps(0.005).apply(dataset(TIME, y)))[1], y)
    filled = y_of(FillGaps(0.005, ("y",)).apply(dataset(TIME, y)))[1]
    np.testing.assert_allclose(filled, TIME**2, atol=1e-5)
    with pytest.raises(BadInput, match="'z'"):
        FillGaps(0.005, ("z",)).apply(dataset(TIME, y))


def test_cells_of_inputs_that_are_missing_at_the_ends_are_cut_off() -> None:
    u = TIME.copy()
    u[:5] = u[-7:] = np.nan
    data = FillGaps(1.0).apply(dataset(TIME, u, TIME))
    assert data.records[0].source == "run.csv"
    np.testing.assert_array_equal(y_of(data)[0], TIME[5:-7])
    both = FillGaps(1.0, ("y",)).apply(dataset(TIME, TIME, u))
    np.testing.assert_array_equal(y_of(both)[0], TIME[5:-7])


def test_stretches_are_left_out() -> None:
    data = dataset(TIME, TIME, initial="rest", begin=10.0)
    (cut,) = Trim(0.5, 1.5).apply(data).records
    assert (cut.initial, cut.begin, cut.data.values.shape[0]) == (None, 10.5, 1001)
    parts = Exclude("run", 0.5, 1.0).apply(data).records
    assert [(r.source, r.initial, r.data.values.shape[0]) for r in parts] == [
        ("run~1.csv", "rest", 500),
        ("run~2.csv", "estimate", 999),
    ]
    with pytest.raises(BadInput, match="no log is left"):
        Exclude("run").apply(data)


def test_held_out_logs_are_those_of_a_name_and_its_parts() -> None:
    data = prepared(dataset(TIME, TIME), [Exclude("run", 0.5, 1.0), HoldOut(("run",))])
    assert [record.use for record in data.records] == ["test", "test"]
    data = prepared(dataset(TIME, TIME), [Split(0.25)])
    assert [(r.use, r.initial, r.data.values.shape[0]) for r in data.records] == [
        ("fit", None, 500),
        ("test", "estimate", 1500),
    ]
    with pytest.raises(BadInput, match="step 1, hold_out\\(\"walk\"\\): there is no log 'walk'; name one of run"):
        prepared(dataset(TIME, TIME), [HoldOut(("walk",))])


def test_parts_of_logs_of_one_name_are_told_apart_by_their_folders() -> None:
    (record,) = dataset(TIME, TIME).records
    both = replace(dataset(TIME, TIME), records=tuple(replace(record, source=f"{k}/run.csv") for k in "ab"))
    cut = Exclude("a/run.csv", 0.5, 1.0).apply(Exclude("b/run.csv", 0.5, 1.0).apply(both))
    held = HoldOut(("a/run.csv",)).apply(cut)
    assert {record.source[0]: record.use for record in held.records} == {"a": "test", "b": "fit"}
    with pytest.raises(BadInput, match="two logs are called 'run'"):
        HoldOut(("run",)).apply(cut)


def test_filters_ask_for_a_log_without_gaps() -> None:
    y = TIME.copy()
    y[100] = np.nan
    for step in (LowPass(10.0), Resample(100.0)):
        said = r'y lacks 1 sample, the first at 0\.1 s; data = data\.fill_gaps\((0\.00\d+), "y"\)'
        with pytest.raises(BadInput, match=said) as error:
            step.apply(dataset(TIME, y))
        assert 'signals = ["y"] }] below [dataset]' in str(error.value)
        step.apply(FillGaps(0.003, ("y",)).apply(dataset(TIME, y)))
    with pytest.raises(BadInput, match=r"u lacks 1 sample, the first at 0\.1 s; data = data\.fill_gaps\(0\.00\d+\) "):
        Delay("u", 0.1).apply(dataset(TIME, y, TIME))
    kept = np.r_[0:400, 403:2000]
    with pytest.raises(BadInput, match=r'lacks samples after 0\.399 s; data = data\.fill_gaps\(0\.00\d+, "y"\)'):
        Resample(100.0).apply(dataset(TIME[kept], TIME[kept]))


def test_an_output_that_lacks_samples_is_moved_and_its_line_taken_off() -> None:
    whole = np.sin(20 * TIME)
    y = whole.copy()
    y[[100, 300, 301]] = np.nan
    moved = y_of(Delay("y", 0.1).apply(dataset(TIME, y)))[1]
    assert np.flatnonzero(np.isnan(moved)).tolist() == [100, 300, 301]
    moved = y_of(Delay("y", 0.1004).apply(dataset(TIME, y)))[1]  # between two samples
    assert np.count_nonzero(np.isnan(moved)) == 5
    np.testing.assert_allclose(moved, np.where(np.isnan(moved), np.nan, np.sin(20 * (TIME[101:] - 0.1004))), atol=1e-9)
    level = y_of(Detrend().apply(dataset(TIME, y)))[1]
    np.testing.assert_allclose(level, y - np.nanmean(y), atol=1e-12)


ALL = (
    (Trim(0.5, logs=("a", "b")), 'trim(start=0.5, logs=["a", "b"])', "trim:start=0.5,logs=a+b"),
    (Exclude("a", 1.0, 2.5), 'exclude("a", start=1, stop=2.5)', "exclude:a,start=1,stop=2.5"),
    (FillGaps(0.02), "fill_gaps(0.02)", "fill_gaps:0.02"),
    (FillGaps(0.02, ("y",), 5), 'fill_gaps(0.02, "y", shortest=5)', "fill_gaps:0.02,y,shortest=5"),
    (DropOutliers(6.0, ("x", "y")), 'drop_outliers(6, "x", "y")', "drop_outliers:sigmas=6,x,y"),
    (Resample(500.0), "resample(500)", "resample:500"),
    (LowPass(50.0, ("x",)), 'lowpass(50, "x")', "lowpass:50,x"),
    (Detrend(("x",), 1), 'detrend("x", order=1)', "detrend:x,order=1"),
    (Detrend(), "detrend()", "detrend"),
    (Delay("p_A", -0.003), 'delay("p_A", -0.003)', "delay:p_A,-0.003"),
    (Flip(("x", "v")), 'flip("x", "v")', "flip:x,v"),
    (Flip(("x",), ("a", "b")), 'flip("x", logs=["a", "b"])', "flip:x,logs=a+b"),
    (Scaled("x", 1e5, logs=("a",)), 'scale("x", factor=100000, logs=["a"])', "scale:x,factor=100000,logs=a"),
    (
        Scaled("x", 12.5, unit="mm", of="V"),
        'scale("x", factor=12.5, unit="mm", of="V")',
        "scale:x,factor=12.5,unit=mm,of=V",
    ),
    (Rename({"a b": "c", "d": "e"}), 'rename({"a b": "c", "d": "e"})', "rename:a b=c,d=e"),
    (HoldOut(("run3",)), 'hold_out("run3")', "hold_out:run3"),
    (Split(0.7), "split(0.7)", "split:0.7"),
)


@pytest.mark.parametrize(("step", "line", "word"), ALL)
def test_a_step_is_typed_and_written_so_that_it_is_read_again(step: Any, line: str, word: str) -> None:
    assert call(step) == line
    assert typed(step) == word
    assert step_typed(word) == step
    assert step_of(Section("place", values_of(step))) == step


def test_every_step_is_tried() -> None:
    assert {step.word for step, _, _ in ALL} == set(STEPS)


@pytest.mark.parametrize(
    ("word", "message"),
    [
        ("flop:x", "there is no step 'flop'; use one of trim, "),
        ("resample", "resample needs hz; write resample:HZ"),
        ("resample:fast", "hz = 'fast' is no number"),
        ("trim:begin=1", "trim has no 'begin=1'; its fields are start, stop, logs"),
        ("split:0.7,0.3", "split has no '0.3'"),
    ],
)
def test_a_word_that_is_no_step_is_refused(word: str, message: str) -> None:
    with pytest.raises(BadInput, match=message):
        step_typed(word)


def test_a_misspelt_step_is_refused() -> None:
    with pytest.raises(BadInput, match="place: step = 'flop' is not known; use one of trim, "):
        step_of(Section("place", {"step": "flop"}))
    with pytest.raises(BadInput, match="place: the key 'signal' is not known; use step, off, signals"):
        step_of(Section("place", {"step": "flip", "signal": "x"}))
    with pytest.raises(BadInput, match="hz is missing"):
        step_of(Section("place", {"step": "resample"}))


def test_a_step_that_is_off_says_so_with_true_or_false() -> None:
    assert [is_off(Section("place", {"step": "flip", **more})) for more in ({}, {"off": False}, {"off": True})] == [
        False, False, True,
    ]  # fmt: skip
    with pytest.raises(BadInput, match="place: off = 1 is neither true nor false"):
        is_off(Section("place", {"step": "flip", "off": 1}))
