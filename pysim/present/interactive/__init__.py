"""Figures that can be moved and zoomed, as Plotly takes them: of the page, and of notebooks by `as_plotly`.

Colours are names such as "@ink", which the look of the page fills in.
"""

from pysim.present.criteria import CRITERIA
from pysim.present.interactive.bode import bode_figure
from pysim.present.interactive.criteria import criteria_figure
from pysim.present.interactive.error import error_figure
from pysim.present.interactive.heat_map import correlation_figure, map_figure
from pysim.present.interactive.law import law_figure
from pysim.present.interactive.look import LOOKS, Figure, plain
from pysim.present.interactive.overlay import overlay_figure, signal_trace
from pysim.present.interactive.parameters import parameters_figure
from pysim.present.interactive.plotly import as_plotly
from pysim.present.interactive.records import beside_figure, lines_figure
from pysim.present.interactive.sketches import model_figure, regions_figure, sketch_figure

__all__ = [
    "CRITERIA",
    "LOOKS",
    "Figure",
    "as_plotly",
    "beside_figure",
    "bode_figure",
    "correlation_figure",
    "criteria_figure",
    "error_figure",
    "law_figure",
    "lines_figure",
    "map_figure",
    "model_figure",
    "overlay_figure",
    "parameters_figure",
    "plain",
    "regions_figure",
    "signal_trace",
    "sketch_figure",
]
