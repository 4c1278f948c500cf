"""What the ledger counts of records, by hand."""

import numpy as np
import pytest

from pysim.diagnose.ledger import after, root_mean_square
from pysim.types import Record, RecordFit


def one(source: str, use: str, values: list[float]) -> RecordFit:
    time = 0.5 + 0.1 * np.arange(len(values))
    measured, simulated = (Record(time, np.array(v)[:, None], ("y",), ("1",)) for v in (values, [0.0] * len(values)))
    return RecordFit("data", source, "stochastic", use, measured, simulated, (0.5,), index=0)


def test_of_the_samples_that_count() -> None:
    records = [one("a", "fit", [9.0, 1.0, 1.0]), one("b", "fit", [0.0]), one("c", "validate", [3.0])]
    assert root_mean_square(records, "fit", {}) == pytest.approx(2 * np.sqrt(83 / 4))
    assert root_mean_square(records, "fit", {"a": 0.05}) == pytest.approx(2 * np.sqrt(2 / 3))
    assert root_mean_square(records, "validate", {"a": 0.05}) == pytest.approx(6.0)
    assert root_mean_square(records[:2], "validate", {}) is None


def test_what_does_not_count_is_cut_off() -> None:
    record = one("a", "fit", [9.0, 1.0, 2.0])
    assert after(record, {"b": 0.05}) is record
    cut = after(record, {"a": 0.05})
    assert cut.measured.time.tolist() == [0.6, 0.7]
    assert cut.residual.values.ravel().tolist() == [2.0, 4.0]
