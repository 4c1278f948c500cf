"""Fitted parameters, shown."""

from pysim.present.fit.answer import Fitted, data, files, text
from pysim.present.fit.figures import (
    figures,
    fit_correlation_figure,
    fit_harmonics_figure,
    fit_parameters_figure,
    fit_record_figure,
)
from pysim.present.fit.page import page

__all__ = [
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
]
