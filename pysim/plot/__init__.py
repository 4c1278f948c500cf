"""Figures from what was measured and simulated; nothing is shown or written here."""

from pysim.plot.time_response import time_response_figure
from pysim.present.render import render

__all__ = [
    "render",
    "time_response_figure",
]
