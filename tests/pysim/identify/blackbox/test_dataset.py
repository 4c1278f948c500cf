"""Responses of a data set, from tables and from logs."""

import numpy as np
import pytest

from pysim.identify.blackbox import Structure, fit_dataset
from pysim.types import BadInput, Dataset, MeasuredRecord, MeasuredSignal, Record, SineTest
from tests.pysim.identify.blackbox.systems import from_roots, pairs

SYSTEM = from_roots([], pairs(-9 + 30j), 981.0)
F = (0.1, 0.5, 1.0, 2.0, 4.0, 6.0, 9.0)
SIGNALS = (
    MeasuredSignal("u", "input", "%", "command", "u"),
    MeasuredSignal("y", "output", "%", "answer", "y", noise=0.01),
)


def table(offset: float, amplitude: float) -> MeasuredRecord:
    response = SYSTEM.response(np.array(F), SineTest(offset, amplitude, "u", "y"), origin="a table")
    return MeasuredRecord("t.csv", "frequency-response-table", "fit", response)


def log(f: float, seed: int) -> MeasuredRecord:
    """A stepped sine around 20 percent with 5 percent amplitude, already swinging steadily."""
    t = np.linspace(0.0, max(2.0, 3 / f), 1500)
    g = complex(SYSTEM.at(np.array([f]))[0])
    u, y = (20 + 5 * np.imag(z * np.exp(2j * np.pi * f * t)) for z in (1.0, g))
    noise = 0.01 * np.random.default_rng(seed).standard_normal(t.size)
    data = Record(t, np.column_stack([u, y + noise]), ("u", "y"), ("%", "%"))
    return MeasuredRecord(f"{f}.txt", "frequency-response", "fit", data, 20.0, 5.0, f)


def dataset(*records: MeasuredRecord) -> Dataset:
    return Dataset("bench", "-", "-", SIGNALS, records)


def test_tables_and_their_deviations() -> None:
    seen = []
    fitted = fit_dataset(
        dataset(table(0, 1), table(5, 1)), Structure(2), progress=lambda done, total: seen.append((done, total))
    )
    assert [one.label for one in fitted] == ["O+0 A1", "O+5 A1"]
    assert seen == [(1, 2), (2, 2)]
    np.testing.assert_allclose(fitted[0].fit.function.denominator, SYSTEM.denominator, rtol=1e-8)
    assert fitted[0].reference_hz == 0.1
    assert max(d.value for d in fitted[0].deviations) < 1e-6
    poor = fit_dataset(dataset(table(0, 1)), Structure(1))[0]
    assert poor.deviations[3].value > 5


def test_logs_with_their_noise() -> None:
    (one,) = fit_dataset(dataset(*(log(f, i) for i, f in enumerate(F))), Structure(2))
    assert one.fit.noise_known
    truth = [*SYSTEM.numerator, *SYSTEM.denominator[1:]]
    for estimate, value in zip(one.fit.estimates(0.999), truth, strict=True):
        assert estimate.low < value < estimate.high
        assert estimate.deviation < 0.01 * abs(value)


def test_some_tests_only_and_orders_on_request() -> None:
    data = dataset(table(0, 1), table(5, 1), table(5, 2))
    (one,) = fit_dataset(data, Structure(3), suggest=True, tests=[(5.0, 2.0)])
    assert one.suggestion is not None
    assert one.fit is one.suggestion.suggested.fit
    assert (one.fit.structure.poles, one.fit.structure.zeros) == (2, 0)
    with pytest.raises(BadInput, match="no test 7/1; it has 0/1, 5/1, 5/2"):
        fit_dataset(data, Structure(2), tests=[(7.0, 1.0)])


def test_refuses_a_data_set_without_responses() -> None:
    with pytest.raises(BadInput, match="no frequency response"):
        fit_dataset(dataset(), Structure(2))
