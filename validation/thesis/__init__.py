"""What the thesis printed, as data, with one folder per table."""

from validation.thesis.explanation import Difference, differences, explain
from validation.thesis.published import PublishedDeviations, published_deviations
from validation.thesis.table_4_1.responses import (
    FREQUENCIES_HZ,
    NOTE,
    loaded_responses,
    measured_responses,
    write_dataset,
)

__all__ = [
    "FREQUENCIES_HZ",
    "NOTE",
    "Difference",
    "PublishedDeviations",
    "differences",
    "explain",
    "loaded_responses",
    "measured_responses",
    "published_deviations",
    "write_dataset",
]
