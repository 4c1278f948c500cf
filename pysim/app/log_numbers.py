"""Which log of the data set each record of a stage is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pysim.identify import ComparedLog
from pysim.identify import log_numbers as numbers
from pysim.types import Dataset


def log_numbers(stage: Mapping[str, Any], dataset: Dataset) -> tuple[int | None, ...]:
    """Per record of a stage its number among the data set's logs; None where nothing tells it from another one.

    Args:
        stage: as a file of stages has it.
        dataset: that it was made of.
    """
    records = [
        ComparedLog(r["source"], r["kind"], r["use"], tuple(r["names"]), r["frequency"]) for r in stage["records"]
    ]
    return numbers(records, dataset)
