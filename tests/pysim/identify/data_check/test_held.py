"""Inputs that may have been held are named until the data set says how they ran, and no other input is."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from pysim.identify.data_check import Between, between_samples
from pysim.nouns.data import load
from pysim.types import Dataset, Record
from pysim.types.record_kind import Command
from tests.toy import measured

DRAWN = np.random.default_rng(3).normal(size=600)


def driven(values: NDArray[np.float64], **said: object) -> Dataset:
    """A log with this command, beside one with a smooth wave."""
    data = measured(1)
    first, second = data.records
    assert isinstance(first.data, Record)
    log = replace(first.data, values=np.column_stack([values, first.data["x"]]))
    signals = (replace(data.signals[0], **said), data.signals[1])  # type: ignore[arg-type]
    return replace(data, signals=signals, records=(replace(first, data=log), second))


@pytest.mark.parametrize("samples", [2, 3, 10, 300])
def test_a_command_that_was_held(samples: int) -> None:
    steps = np.repeat(DRAWN, samples)[:600]
    how = Between.SMOOTH if samples == 2 else Between.HELD_AT_JUMPS  # which simulations take for a curve
    assert between_samples(driven(steps)) == [("F", how, ["a.txt"])]
    assert between_samples(driven(steps, hold=Command.LINES)) == []


def test_a_kind_of_log_that_is_held() -> None:
    data = measured(1)
    first, second = data.records
    found = between_samples(replace(data, records=(first, replace(second, kind="step"))))
    assert found == [("F", Between.HELD, ["b.txt"])]


@pytest.mark.parametrize("digit", [1e-1, 1e-2, 1e-9])
def test_a_rounded_wave_is_no_staircase(digit: float) -> None:
    slow = np.sin(np.arange(600) / 40)
    found = between_samples(driven(np.round(slow / digit) * digit))
    assert not any(how is Between.SMOOTH for _, how, _ in found)


def test_the_check_says_it_until_the_data_do() -> None:
    time, force = np.arange(600) / 100, np.repeat(DRAWN, 2)[:600]
    columns = {"t": time, "F [N]": force, "x [m]": np.cumsum(force)}
    assert 'hold={"F": "zero"}' in repr(load(columns, inputs="F", outputs="x", time="t").check())
    said = load(columns, inputs="F", outputs="x", time="t", hold={"F": "zero"})
    assert "hold" not in repr(said.check())
    assert np.isin(said.resample(400)["log"].data["F"], force).all()
