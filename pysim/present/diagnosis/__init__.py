"""A diagnosis, shown: its words, its answer as text and JSON, its page and its pictures."""

from pysim.present.diagnosis.answer import Diagnosed, data, files, placed, relative_files, text, whole
from pysim.present.diagnosis.figures import (
    candidates_figure,
    error_figure,
    figures,
    law_figure,
    map_figure,
    overlay_figure,
    parameters_figure,
    spectrum_figure,
    telling_records,
)
from pysim.present.diagnosis.page import page
from pysim.types import Diagnosis

__all__ = [
    "Diagnosed",
    "Diagnosis",
    "candidates_figure",
    "data",
    "error_figure",
    "figures",
    "files",
    "law_figure",
    "map_figure",
    "overlay_figure",
    "page",
    "parameters_figure",
    "placed",
    "relative_files",
    "spectrum_figure",
    "telling_records",
    "text",
    "whole",
]
