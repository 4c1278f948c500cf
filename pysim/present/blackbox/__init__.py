"""Fitted transfer functions, shown."""

from pysim.present.blackbox.answer import TransferFunctions, data, text
from pysim.present.blackbox.figure import blackbox_figure, figures
from pysim.present.blackbox.page import page

__all__ = ["TransferFunctions", "blackbox_figure", "data", "figures", "page", "text"]
