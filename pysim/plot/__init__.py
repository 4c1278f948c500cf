"""Figures from what was measured and simulated; nothing is shown or written here."""

from pysim.plot.bode import bode_figure
from pysim.plot.deviation import deviation_figure
from pysim.plot.excitation import excitation_figure
from pysim.plot.render import render
from pysim.plot.time_response import time_response_figure

__all__ = ["bode_figure", "deviation_figure", "excitation_figure", "render", "time_response_figure"]
