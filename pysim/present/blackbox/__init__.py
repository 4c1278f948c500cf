"""Fitted transfer functions, shown."""

from pysim.present.blackbox.answer import TransferFunctions, data, page, text
from pysim.present.blackbox.figure import blackbox_figure, figures

__all__ = ["TransferFunctions", "blackbox_figure", "data", "figures", "page", "text"]
