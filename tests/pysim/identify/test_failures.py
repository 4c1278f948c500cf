"""Regions in which a known residual is large come first."""

import numpy as np
import pytest

from pysim.identify.failures import ALL_LOGS, ALL_SINES, bands, failures
from pysim.types import Record, RecordFit
from tests.pysim.diagnosis_answer import WAVE, dataset, stage

TIME = np.arange(0, 40, 0.01)


def log(residual: np.ndarray, signal: np.ndarray) -> RecordFit:
    """A log whose residual in units of noise is given."""
    columns = [Record(TIME, values[:, None], ("x",), ("m",)) for values in (signal + 0.5 * residual, signal)]
    return RecordFit("toy", "log.txt", "other", "fit", *columns, (0.5,), index=0)


def white() -> np.ndarray:
    return np.random.default_rng(3).standard_normal(TIME.size)


def test_noise_alone_is_one_everywhere() -> None:
    rows = failures([log(white(), np.sin(TIME))])
    assert {row.record for row in rows} == {"log.txt", ALL_LOGS}
    assert all(row.error == pytest.approx(1.0, abs=0.2) for row in rows)


def test_a_ripple_is_told_by_its_band() -> None:
    alone, worst, *_ = failures([log(white() + 3 * np.sin(2 * np.pi * 24 * TIME), np.sin(TIME))])
    assert alone.region == "24 Hz alone"
    low, high = (float(word) for word in worst.region.removesuffix(" Hz").split(" to "))
    assert low <= 24 <= high
    assert worst.error > 2.4  # the root of 1 + 3^2/2 over all frequencies


def test_a_burst_is_told_by_its_window() -> None:
    worst = failures([log(white() + 9.0 * (abs(TIME - 17) < 3), np.sin(40 * TIME))])
    windows = [row for row in worst if row.region.endswith(" s")]
    assert windows[0].region == "13.34 to 20 s"


@pytest.mark.parametrize(
    ("residual", "expected"),
    [(4.0 * (np.sin(TIME) > 0.9), "x 0."), (4.0 * (np.cos(TIME) > 0.9), "rate of x 0.")],
)
def test_a_range_of_a_signal_or_of_its_rate_is_told(residual: np.ndarray, expected: str) -> None:
    rows = [row for row in failures([log(white() + residual, np.sin(TIME))]) if row.record == ALL_LOGS]
    assert rows[0].region.startswith(expected)
    assert rows[0].region.endswith(" to 1 m" if expected[0] == "x" else " to 1 m/s")


def test_large_values_have_no_exponent() -> None:
    rows = failures([log(white(), 12345 * np.sin(TIME))])
    assert not any("e+" in row.region for row in rows)
    assert any(row.region.startswith("x -12300 to ") for row in rows)


def test_sines_count_one_by_one_and_together() -> None:
    rows = {(row.record, row.region): row.error for row in failures(stage("refit").records, dataset())}
    assert rows["sines/1Hz.txt", "1 Hz"] == rows[ALL_SINES, "frequency 1 Hz"] == pytest.approx(np.sqrt(1 + 4.5**2))
    assert not any(region.startswith("offset") for _, region in rows)  # there is one offset only
    assert any(record == "wave.txt" and region.endswith("Hz") for record, region in rows)
    assert WAVE < 8


def test_bands_cover_the_axis_once_with_several_lines_each() -> None:
    for count in (9, 64, 511):
        parts = list(bands(np.arange(1.0, count + 1)))
        assert [part.start for part in parts] == [0, *(part.stop for part in parts[:-1])]
        assert parts[-1].stop == count
        assert all(part.stop - part.start >= 8 for part in parts[:-1])
    assert [part.stop for part in bands(np.arange(1.0, 512.0))] == [11, 22, 41, 78, 146, 273, 511]  # an even logarithm
