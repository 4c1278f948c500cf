"""Figures of the page, as Plotly takes them. Colours are names such as "@ink" that the page's look fills in."""

from pysim.app.figures.bode import bode_figure
from pysim.app.figures.criteria import CRITERIA, criteria_figure
from pysim.app.figures.error import error_figure
from pysim.app.figures.heat_map import map_figure
from pysim.app.figures.law import law_figure
from pysim.app.figures.look import LOOKS, Figure, plain
from pysim.app.figures.overlay import overlay_figure, signal_trace
from pysim.app.figures.parameters import parameters_figure

__all__ = [
    "CRITERIA",
    "LOOKS",
    "Figure",
    "bode_figure",
    "criteria_figure",
    "error_figure",
    "law_figure",
    "map_figure",
    "overlay_figure",
    "parameters_figure",
    "plain",
    "signal_trace",
]
