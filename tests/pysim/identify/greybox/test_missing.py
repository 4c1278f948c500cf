"""Where an output was not measured, nothing is compared: the fit is that of the samples that are there."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.identify.greybox import GaussNewton, NoiseSettings, Problem, Simulation, Treatment, fit, problem
from pysim.identify.greybox.effective_size import independent_pieces, piece_of_sample
from pysim.identify.greybox.noise import seen_noise, white_floor
from pysim.simulate import Esdirk
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Model, NoteCode, Record
from pysim.types.record_kind import Command
from tests.pysim.identify.greybox import measurements as m

Array = NDArray[np.float64]

TIGHT = Simulation(solver=Esdirk(rtol=1e-9, atol=1e-9), mismatch=1e-9)


def without(record: MeasuredRecord, share: float, seed: int = 0) -> tuple[MeasuredRecord, MeasuredRecord]:
    """The log with empty cells of y, and the same without their rows; the first and the last row stay."""
    log = record.data
    assert isinstance(log, Record)
    empty = np.random.default_rng(seed).random(log.time.size) < share
    empty[[0, -1]] = False
    values = log.values.copy()
    values[empty, log.names.index("y")] = np.nan
    kept = Record(log.time[~empty], log.values[~empty], log.names, log.units)
    return replace(record, data=replace(log, values=values)), replace(record, data=kept)


def task(lag: Model, *records: MeasuredRecord, whole: int = 10**6, initial: str = "rest") -> Problem:
    treatment = Treatment(initial=initial, noise=NoiseSettings(whole=whole))
    return problem(lag, [m.dataset([*records])], ["K", "T"], treatment=treatment)


@pytest.mark.parametrize(("whole", "initial"), [(10**6, "rest"), (10**6, "estimate"), (10, "rest")])
def test_estimates_and_intervals_are_those_of_the_samples_that_are_there(lag: Model, whole: int, initial: str) -> None:
    empty, kept = without(m.ramp_log(2.0, 0.7, seed=3), 0.2)
    tasks = [task(lag, own, whole=whole, initial=initial) for own in (empty, kept)]
    one, other = (fit(own, simulation=TIGHT, optimiser=GaussNewton(tolerance=1e-7)) for own in tasks)
    for found, expected in zip((*one.estimates, *one.initial), (*other.estimates, *other.initial), strict=True):
        assert found.value == pytest.approx(expected.value, rel=1e-6, abs=1e-7)
        assert found.interval == pytest.approx(expected.interval, rel=1e-6, abs=1e-7)
    assert (one.cost, one.misfit) == pytest.approx((other.cost, other.misfit), rel=1e-6)
    (record,), (beside,) = one.records, other.records
    assert np.isnan(record.measured["y"]).sum() == record.measured.time.size - beside.measured.time.size > 20
    assert record.rms["y"] == pytest.approx(beside.rms["y"], rel=1e-6)
    assert record.fit_percent["y"] == pytest.approx(beside.fit_percent["y"], rel=1e-6)
    values = [[d.value for d in own.deviations["y"]] for own in (record, beside)]
    assert values[0] == pytest.approx(values[1], rel=1e-6)


def test_noise_is_estimated_from_the_samples_that_are_there(lag: Model) -> None:
    empty, _ = without(m.ramp_log(2.0, 0.7, seed=5), 0.1)
    found = fit(problem(lag, [m.dataset([empty], noise=None)], ["K", "T"]))
    (note,) = (note for note in found.notes if note.code is NoteCode.NOISE_ESTIMATED)
    assert note.values["value"] == pytest.approx(m.NOISE, rel=0.3)
    rng = np.random.default_rng(1)
    values = np.sin(np.arange(4000) / 40) + 0.01 * rng.standard_normal(4000)
    values[rng.random(4000) < 0.2] = np.nan
    assert seen_noise(values) == pytest.approx(0.01, rel=0.1)
    assert white_floor([values], NoiseSettings()) is None  # no stretch is long enough
    values = 0.01 * rng.standard_normal(4000)
    values[::1000] = np.nan
    assert white_floor([values], NoiseSettings()) == pytest.approx(0.01, rel=0.05)


def test_two_signals_lack_different_samples(lag: Model) -> None:
    signals = (*m.dataset([]).signals, MeasuredSignal("z", "output", "1", "answer", "x", noise=m.NOISE))
    rng, t = np.random.default_rng(2), np.arange(0, 3, 0.01)
    y, z = (m.ramp_answer(t, 2.0, 0.7) + m.NOISE * rng.standard_normal(t.size) for _ in range(2))
    y[rng.random(t.size) < 0.3] = z[np.arange(t.size) % 5 > 0] = np.nan  # z has a fifth of the rate

    def own(names: tuple[str, ...], *columns: Array, source: str = "log.txt") -> MeasuredRecord:
        rows = np.isfinite(np.column_stack(columns)).any(axis=1) if len(columns) == 1 else np.full(t.size, True)
        values = np.column_stack([t, *columns])[rows]
        return MeasuredRecord(source, "other", "fit", Record(t[rows], values, ("w", *names), ("1",) * len(values[0])))

    together = Dataset("lag", "", "", signals, (own(("y", "z"), y, z),))
    apart = Dataset("lag", "", "", signals, (own(("y",), y), own(("z",), z, source="b")))
    tasks = [problem(lag, [one], ["K", "T"], treatment=Treatment(initial="rest")) for one in (together, apart)]
    assert [one.residuals(simulation=TIGHT).samples.tolist() for one in tasks] == 2 * [
        [np.isfinite(y).sum(), np.isfinite(z).sum()]
    ]
    found, expected = (fit(one, simulation=TIGHT) for one in tasks)
    for one, other in zip(found.estimates, expected.estimates, strict=True):
        assert one.value == pytest.approx(other.value, rel=1e-5)
        assert one.std == pytest.approx(other.std, rel=0.5)  # the blocks are others


def test_an_edge_that_was_not_measured_leaves_no_residual(lag: Model) -> None:
    """A straight line across an edge would be 30 standard deviations off."""
    t = np.arange(0, 3, 0.02)
    w = (t >= 1.0).astype(float)
    truth = 2 * np.where(t >= 1, 1 - np.exp(-np.maximum(t - 1.0, 0.0) / 0.02), 0.0)
    y = truth + m.NOISE * np.random.default_rng(4).standard_normal(t.size)
    y[50:53] = np.nan
    data = m.dataset([m.log(t, w, y)])
    data = replace(data, signals=(replace(data.signals[0], hold=Command.STEPS), data.signals[1]))
    found = fit(problem(lag, [data], ["K", "T"]), simulation=TIGHT)
    assert found.misfit == pytest.approx(1.0, abs=0.15)
    assert np.nanmax(np.abs(found.records[0].residual["y"])) < 4
    assert found["K"].value == pytest.approx(2.0, abs=4 * found["K"].std)


def test_a_stepped_sine_lacks_rows(lag: Model) -> None:
    pairs = [without(m.sine_log(2.0, 0.7, f, seed=k), 0.2, seed=k) for k, f in enumerate((0.3, 1.0, 3.0))]
    one, other = (fit(task(lag, *own), simulation=TIGHT) for own in zip(*pairs, strict=True))
    for found, expected in zip(one.estimates, other.estimates, strict=True):
        assert found.value == pytest.approx(expected.value, rel=1e-6)
        assert found.interval == pytest.approx(expected.interval, rel=1e-6)
    log = pairs[0][0].data
    assert isinstance(log, Record)
    values = log.values.copy()
    values[1:, 1] = np.nan
    with pytest.raises(BadInput, match="have no samples at the same time"):
        task(lag, replace(pairs[0][0], data=replace(log, values=values)))


def test_a_signal_that_was_never_measured_is_not_compared(lag: Model) -> None:
    whole = m.ramp_log(2.0, 0.7, seed=1)
    log = whole.data
    assert isinstance(log, Record)
    never = replace(log, values=np.column_stack([log["w"], np.full(log.time.size, np.nan)]))
    found = task(lag, whole, replace(whole, source="b", data=never))
    assert [note.values["record"] for note in found.notes if note.code is NoteCode.NOT_COMPARED] == ["b"]
    assert len(found.observations) == 1


def test_stretches_hold_equally_many_samples() -> None:
    there = np.full((100, 2), True)
    there[50:, 1] = False
    assert np.bincount(piece_of_sample(there, 3), there.sum(axis=1)).tolist() == [50, 50, 50]
    np.testing.assert_array_equal(piece_of_sample(there[:, :1], 7), np.arange(100) * 7 // 100)
    rest = np.random.default_rng(0).standard_normal(400)
    assert independent_pieces([rest, rest[:100], rest[:0]], 1.0) == independent_pieces([rest[:100]], 1.0)
