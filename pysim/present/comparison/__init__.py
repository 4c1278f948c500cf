"""Models against measured responses, shown."""

from pysim.present.comparison.answer import Comparisons, comparison_text, data, text, verdict_text, whole
from pysim.present.comparison.bode import bode_figure
from pysim.present.comparison.deviation import deviation_figure
from pysim.present.comparison.figures import comparison_picture, figures, picture_names
from pysim.present.comparison.page import comparison_table, page
from pysim.types import Comparison

__all__ = [
    "Comparison",
    "Comparisons",
    "bode_figure",
    "comparison_picture",
    "comparison_table",
    "comparison_text",
    "data",
    "deviation_figure",
    "figures",
    "page",
    "picture_names",
    "text",
    "verdict_text",
    "whole",
]
