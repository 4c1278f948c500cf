"""Whether a model is complete: a log that leaves more than the others, and what chance makes of them."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter

from pysim.diagnosis.settings import Settings
from pysim.diagnosis.verdict import stands_out
from pysim.types import Record, RecordFit
from pysim.types.answer import StandsOut

NOISE = 0.5


def log(residual: np.ndarray, use: str = "fit", source: str = "log.txt") -> RecordFit:
    """A log whose residual has this size over its noise."""
    time = 0.01 * np.arange(residual.size)
    signal = np.sin(time)
    columns = [Record(time, values[:, None], ("x",), ("m",)) for values in (signal + NOISE * residual, signal)]
    return RecordFit("toy", source, "other", use, *columns, (NOISE,), index=0)


@pytest.mark.parametrize("memory", [0.0, 0.9])
def test_of_equal_logs_chance_makes_one_stand_out_as_often_as_was_allowed(memory: float) -> None:
    """Noise above what is stated, with autocorrelations memory^k; one in ten, three standard deviations either way."""
    rng, settings, times = np.random.default_rng(1), replace(Settings(), false_alarm=0.1, held_out=1.0), 400
    seen = 0
    for _ in range(times):
        rests = lfilter([2.0], [1.0, -memory], rng.standard_normal((4, 1200)), axis=1)[:, 200:]
        seen += stands_out([log(np.asarray(rest)) for rest in rests], settings) is not None
    assert seen / times == pytest.approx(0.1, abs=3 * np.sqrt(0.1 * 0.9 / times))


@pytest.mark.parametrize("use", ["fit", "validate"])
def test_one_log_of_many_that_leaves_more_stands_out(use: str) -> None:
    """Half as much again in 300 samples: 8 standard deviations; the two uses together differ by a twentieth only."""
    rng = np.random.default_rng(2)
    logs = [log(rng.standard_normal(1000), which) for which in 4 * ("fit", "validate")]
    assert stands_out(logs, Settings()) is None
    found = stands_out([log(1.5 * rng.standard_normal(300), use, "odd.txt"), *logs], Settings())
    assert found is not None
    assert (found.record, found.signal) == ("odd.txt", "x")
    assert found.over == pytest.approx(1.5, rel=0.15)


def test_a_log_alone_and_what_noise_hides_do_not_stand_out() -> None:
    rng = np.random.default_rng(3)
    large, small = log(4.0 * rng.standard_normal(1000)), log(0.2 * rng.standard_normal(1000))
    assert stands_out([], Settings()) is None
    assert stands_out([large], Settings()) is None
    assert stands_out([small, log(0.9 * rng.standard_normal(1000))], Settings()) is None
    assert stands_out([large, small], Settings()) == StandsOut("log.txt", "x", pytest.approx(4.0, rel=0.1))
