"""Data in the units in which a model counts."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from pysim.io import in_model_units
from pysim.types import (
    Abilities,
    Dataset,
    FrequencyResponse,
    MeasuredRecord,
    MeasuredSignal,
    Model,
    Record,
    SineTest,
    Variable,
)

SIGNALS = (
    MeasuredSignal("p", "input", "Pa", "pressure", "pb", noise=1e3, resolution=5e3),
    MeasuredSignal("T", "output", "K", "oil", "T", noise=0.5),
    MeasuredSignal("x", "output", "m", "stroke", "x"),
    MeasuredSignal("F", "output", "N", "force", "no.such"),
)
LOG = Record(
    np.arange(2.0),
    np.array([[2e5, 293.15, 0.1, 7.0], [3e5, 303.15, 0.2, 8.0]]),
    ("p", "T", "x", "F"),
    ("Pa", "K", "m", "N"),
)
RESPONSE = FrequencyResponse(
    np.array([1.0, 2.0]),
    np.array([1e-6, 2e-6]),
    np.array([0.0, -1.0]),
    SineTest(5e5, 1e5, "p", "T"),
    "a table",
    mean=np.array([293.15, 303.15]),
    covariance=np.tile(np.diag([1.0, 2.0, 3.0]), (2, 1, 1)),
)
DATA = Dataset(
    "x",
    "-",
    "-",
    SIGNALS,
    (
        MeasuredRecord("a.txt", "frequency-response", "fit", LOG, 2.5e5, 0.5e5, 1.0, command="p"),
        MeasuredRecord("b.txt", "other", "fit", LOG),
        MeasuredRecord("c.txt", "frequency-response-table", "fit", RESPONSE, 5e5, 1e5, command="p"),
    ),
)


def model(**units: str) -> Model:
    variables = (
        Variable(name, 0, "Real", "input" if name == "pb" else "output", "continuous", 0.0, unit, None, "", *[None] * 4)
        for name, unit in units.items()
    )
    return Model(Path("m.fmu"), "m", "t", tuple(variables), Abilities(2, True, False, False, False, 0, (), ()))


def test_what_counts_otherwise_is_turned() -> None:
    own = model(pb="bar", T="degC", x="m")
    turned = in_model_units(DATA, own)
    assert [(s.unit, s.noise, s.resolution) for s in turned.signals] == [
        ("bar", pytest.approx(0.01), pytest.approx(0.05)),
        ("degC", 0.5, None),
        ("m", None, None),
        ("N", None, None),
    ]
    sine, other, table = turned.records
    assert (sine.offset, sine.amplitude) == (pytest.approx(2.5), pytest.approx(0.5))
    assert (other.offset, other.amplitude) == (None, None)
    assert sine.data.units == ("bar", "degC", "m", "N")
    np.testing.assert_allclose(sine.data.values, [[2.0, 20.0, 0.1, 7.0], [3.0, 30.0, 0.2, 8.0]])
    assert (table.offset, table.amplitude) == (pytest.approx(5.0), pytest.approx(1.0))
    assert (table.data.test.offset, table.data.test.amplitude) == (pytest.approx(5.0), pytest.approx(1.0))
    np.testing.assert_allclose(table.data.gain, [0.1, 0.2])
    np.testing.assert_allclose(table.data.mean, [20.0, 30.0])
    np.testing.assert_array_equal(table.data.phase, RESPONSE.phase)
    for signal in turned.signals[:3]:
        assert own.measured(signal, "data set 'x'").unit == signal.unit


def test_the_spread_of_a_response_goes_along() -> None:
    turned = in_model_units(DATA, model(pb="Pa", T="degF")).responses()[0]
    np.testing.assert_allclose(turned.covariance[0], np.diag([1.8**2, 2.0, 3.0 * 1.8**2]))
    np.testing.assert_allclose(turned.mean, [68.0, 86.0])


@pytest.mark.parametrize("units", [{"pb": "Pa", "T": "K", "x": "m"}, {"pb": "V", "T": "1", "x": "furlong"}, {}])
def test_nothing_moves_where_nothing_differs_or_nothing_is_known(units: dict[str, str]) -> None:
    assert in_model_units(DATA, model(**units)) is DATA


def test_the_only_input_is_the_command() -> None:
    record = replace(DATA.records[0], command="")
    turned = in_model_units(replace(DATA, records=(record,)), model(pb="bar")).records[0]
    assert (turned.offset, turned.amplitude) == (pytest.approx(2.5), pytest.approx(0.5))
