"""Fitted transfer functions, shown."""

from pysim.present.blackbox.answer import TransferFunctions, data, page, text
from pysim.present.blackbox.figure import figures

__all__ = ["TransferFunctions", "data", "figures", "page", "text"]
