"""Whether a model is complete: what chance makes of the error of short and of coloured logs."""

import math

import numpy as np
import pytest
from scipy.signal import lfilter

from pysim.diagnosis.verdict import _scatter
from pysim.types import Record, RecordFit


def log(residual: np.ndarray, use: str = "fit") -> RecordFit:
    time = 0.01 * np.arange(residual.size)
    signal = np.sin(time)
    columns = [Record(time, values[:, None], ("x",), ("m",)) for values in (signal + 0.5 * residual, signal)]
    return RecordFit("toy", "log.txt", "other", use, *columns, (0.5,), index=0)


@pytest.mark.parametrize("memory", [0.0, 0.9])
def test_the_scatter_of_an_error_is_that_of_its_repetitions(memory: float) -> None:
    """White: 1/sqrt(2 n); with autocorrelations memory^k as many times more as the sum of their squares says."""
    rng, n = np.random.default_rng(1), 2000
    rests = [np.asarray(lfilter([1.0], [1.0, -memory], rng.standard_normal(n + 200))[200:]) for _ in range(400)]
    spread = float(np.std([0.5 * math.log(np.mean(rest**2)) for rest in rests]))
    expected = math.sqrt((1 + memory**2) / (1 - memory**2) / (2 * n))
    assert spread == pytest.approx(expected, rel=0.1)
    found = float(np.mean([_scatter([log(rest), log(rest, "validate")], "fit") for rest in rests[:20]]))
    assert found == pytest.approx(expected, rel=0.1)


def test_logs_together_scatter_less_and_no_log_does_not() -> None:
    rng = np.random.default_rng(2)
    logs = [log(rng.standard_normal(1000)) for _ in range(4)]
    assert _scatter(logs, "fit") == pytest.approx(_scatter(logs[:1], "fit") / 2, rel=0.1)
    assert _scatter(logs, "validate") == 0.0
