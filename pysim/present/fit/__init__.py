"""Fitted parameters, shown."""

from pysim.present.fit.answer import Fitted, data, files, page, text, whole
from pysim.present.fit.figures import figures
from pysim.types import Fit

__all__ = ["Fit", "Fitted", "data", "figures", "files", "page", "text", "whole"]
