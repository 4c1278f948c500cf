"""What a gain, an offset and a shift do to residuals, against measurements that were changed so."""

import numpy as np
import pytest

from pysim.diagnose.adapter import over_noise
from pysim.diagnose.nuisance import GAIN, OFFSET, SHIFT, Span, Suspect, columns, suspects
from pysim.identify.greybox.harmonics import interpolation
from pysim.identify.greybox.observation import Run, Simulated
from pysim.identify.greybox.response_table import ResponseTable
from pysim.types import Experiment, FrequencyResponse, SineTest
from tests.pysim.diagnose.logs import sines, wave

SUSPECTS = (Suspect(GAIN, "data", "y"), Suspect(OFFSET, "data", "y"), Suspect(SHIFT, "data", ""))


def swing(time: np.ndarray) -> np.ndarray:
    return 3 + 4 * np.sin(5 * time) + np.cos(11 * time)


def test_suspects_of_signals_and_clocks() -> None:
    assert set(suspects([sines(np.zeros, 0.1), wave(np.zeros(40), 0.1)])) == set(SUSPECTS)


def test_a_log_changes_as_its_columns_say() -> None:
    time = np.arange(500) / 250
    plain, near = wave(swing(time), 0.1), swing(time)[:, None]
    found = columns(plain, [near], SUSPECTS)
    still = Simulated(near, np.zeros((500, 1, 0)))
    for k, changed in enumerate((1.01 * swing(time), swing(time) + 0.01, swing(time + 0.01 / 100))):
        size = 0.01 if k < 2 else 0.01 / 100
        moved = over_noise(wave(changed, 0.1), [still]).values - over_noise(plain, [still]).values
        assert moved / size == pytest.approx(found[:, k], rel=1e-2, abs=1e-2 * np.abs(found[:, k]).max())


def test_stepped_sines_change_as_their_columns_say() -> None:
    def orbit(log, late=0.0):  # type: ignore[no-untyped-def]
        w = 2 * np.pi * log.sine.frequency
        at = np.arange(log.points) / log.points / log.sine.frequency + late
        return (3 + 10 * np.sin(w * at) + np.cos(2 * w * at) - 0.5 * np.sin(3 * w * at))[:, None]

    target = sines(np.zeros, 0.1)
    found = columns(target, [orbit(log) for log in target.logs], SUSPECTS)
    place = 0
    for log in target.logs:
        rows = slice(place, place + 2 * log.count + 1)
        place = rows.stop
        near = log.onto @ orbit(log) / 0.1
        assert found[rows, 0] == pytest.approx(near[:, 0])
        by_offset = log.onto @ (orbit(log) + 1) / 0.1 - near
        assert found[rows, 1] == pytest.approx(by_offset[:, 0], abs=1e-8)
        step = 1e-7
        by_shift = (log.onto @ orbit(log, step) - log.onto @ orbit(log, -step)) / 0.1 / (2 * step)
        assert found[rows, 2] == pytest.approx(by_shift[:, 0], rel=1e-4, abs=1e-4 * np.abs(by_shift).max())
    assert interpolation(log.phase, log.points).shape == (log.phase.size, log.points)


def test_a_table_has_rows_that_no_nuisance_moves() -> None:
    frequency = np.array([0.1, 1.0, 5.0])
    response = FrequencyResponse(frequency, np.ones(3), np.zeros(3), SineTest(0.0, 1.0, "u", "y"), "a table")
    run = Run("table.csv", Experiment(np.linspace(0, 1, 9), ("y",)))
    target = ResponseTable("data", "table.csv", "fit", response, (run,) * 3, None)
    angle = 2 * np.pi * np.arange(9) / 9
    answers = [Simulated(np.sin(angle)[:, None], np.zeros((9, 1, 0)))] * 3
    found = columns(target, [answer.values for answer in answers], SUSPECTS)
    assert found.shape == (over_noise(target, answers).values.size, 3)
    assert not found.any()


def test_what_is_across_has_nothing_along() -> None:
    rng = np.random.default_rng(1)
    given = rng.standard_normal((30, 3))
    span = Span.of(np.column_stack([given, given[:, 0] - 2 * given[:, 1], np.zeros(30)]), np.full(5, np.inf))
    assert span.rank == 3
    rows = rng.standard_normal((30, 2))
    across = span.across(rows)
    assert np.abs(given.T @ across).max() < 1e-12
    assert span.across(across) == pytest.approx(across)
    assert Span.of(np.zeros((4, 0)), np.zeros(0)).across(rows[:4]) is not None


def test_noise_and_nuisances_of_usual_sizes_are_white_across() -> None:
    rng = np.random.default_rng(2)
    columns, widths = rng.standard_normal((6, 2)), np.array([2.0, 0.3])
    span = Span.of(columns, widths)
    covariance = np.eye(6) + columns @ np.diag(widths**2) @ columns.T
    assert span.across(span.across(covariance).T) == pytest.approx(np.eye(6), abs=1e-12)
    assert span.taken(span.along(columns)) + span.across(columns) == pytest.approx(columns)
    assert span.undone(span.across(columns)) == pytest.approx(columns)


def test_a_suspect_far_beyond_its_usual_size_still_counts() -> None:
    column = np.ones((100, 1))
    span = Span.of(column, np.array([1.0]))
    assert float(np.sum(span.across(50 * column) ** 2)) == pytest.approx(50**2, rel=0.02)


def test_usual_sizes_go_with_scale_and_sampling() -> None:
    widths = {s.kind: s.width for s in suspects([wave(np.full(40, 7.0), 0.1)])}
    unit = wave(np.zeros(40), 0.1).measured.units[0]
    assert widths[GAIN] == 0.01
    assert widths[OFFSET] == pytest.approx({"%": 0.5, "1": 0.001}.get(unit, 0.035))
    assert widths[SHIFT] == pytest.approx(0.001)
