"""What a test swings around and how far, as people read it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pysim.io import shown_unit, shown_value
from pysim.types import Dataset


def working_point(offset: float, amplitude: float, unit: str) -> str:
    """As in "100 ± 20 bar".

    Args:
        offset, amplitude: in an SI unit, "1" or "%".
        unit: that one; "" where nobody stated it.
    """
    return f"{shown_unit(unit)[1] * offset:g} ± {shown_value(amplitude, unit)}"


def command_unit(dataset: Dataset, command: str) -> str:
    """Unit of the input that offset and amplitude of a test speak of; "" where none is stated."""
    return next((signal.unit for signal in dataset.signals if signal.name == command), "")


def response_unit(dataset: Dataset, response: Mapping[str, Any]) -> str:
    """Unit of the command of a frequency response in a file of stages, which names the input for tables alone."""
    point = (response["offset"], response["amplitude"])
    same = (record.command for record in dataset.records if (record.offset, record.amplitude) == point)
    return command_unit(dataset, response["input"]) or command_unit(dataset, next(same, ""))
