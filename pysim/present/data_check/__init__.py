"""What a data set holds, shown."""

from pysim.identify.data_check import DataCheck
from pysim.present.data_check.answer import data, page, text, warnings_in_words
from pysim.present.data_check.figures import figures
from pysim.present.data_check.words import assumed_between_samples, lines, not_compared, sentence

__all__ = [
    "DataCheck",
    "assumed_between_samples",
    "data",
    "figures",
    "lines",
    "not_compared",
    "page",
    "sentence",
    "text",
    "warnings_in_words",
]
