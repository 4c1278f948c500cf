"""The thesis' pump, the tables that stand for its measurements, and the thesis' own comparison of both."""

from pysim.thesis.explanation import Difference, differences, explain
from pysim.thesis.printed import printed_table, read_csv
from pysim.thesis.published import PublishedDeviations, published_deviations
from pysim.thesis.pump import CLASSES, SOURCES, pump_model
from pysim.thesis.responses import (
    FREQUENCIES_HZ,
    NOTE,
    loaded_responses,
    measured_responses,
    write_dataset,
)

__all__ = [
    "CLASSES",
    "FREQUENCIES_HZ",
    "NOTE",
    "SOURCES",
    "Difference",
    "PublishedDeviations",
    "differences",
    "explain",
    "loaded_responses",
    "measured_responses",
    "printed_table",
    "published_deviations",
    "pump_model",
    "read_csv",
    "write_dataset",
]
