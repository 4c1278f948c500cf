"""What a data set holds, shown."""

from pysim.identify.data_check import DataCheck
from pysim.present.data_check.answer import data, page, text, warnings_in_words
from pysim.present.data_check.figures import coverage_figure, figures, sine_logs_figure, time_logs_figure
from pysim.present.data_check.words import lines, sentence

__all__ = [
    "DataCheck",
    "coverage_figure",
    "data",
    "figures",
    "lines",
    "page",
    "sentence",
    "sine_logs_figure",
    "text",
    "time_logs_figure",
    "warnings_in_words",
]
