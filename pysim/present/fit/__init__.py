"""Fitted parameters, shown."""

from pysim.present.fit.answer import Fitted, data, files, page, text, whole
from pysim.present.fit.figures import (
    figures,
    fit_correlation_figure,
    fit_harmonics_figure,
    fit_parameters_figure,
    fit_record_figure,
)
from pysim.types import Fit

__all__ = [
    "Fit",
    "Fitted",
    "data",
    "figures",
    "files",
    "fit_correlation_figure",
    "fit_harmonics_figure",
    "fit_parameters_figure",
    "fit_record_figure",
    "page",
    "text",
    "whole",
]
